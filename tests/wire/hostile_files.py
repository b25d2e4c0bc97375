#!/usr/bin/python3
"""Broken and hostile meshes and pictures: each is refused, or read as what it is, in under a second of work and 2 GiB."""

import os
import random
import struct
import subprocess
import zlib

import mesh_writers
from harness import DONE, FINDINGS, FOCALSTAGE, INVALID, folder, main, small_project, write_project

MIB = 1 << 20
MOST_S, MOST_MIB = 1.0, 2048
worst = {"s": 0.0, "MiB": 0.0}


def judged(*arguments):
    """The status and what was said; work and memory are those of the process alone, whatever runs beside it."""
    for attempt in range(3):
        process = subprocess.Popen([FOCALSTAGE, *map(str, arguments)], stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        out, err = process.stdout.read(), process.stderr.read()
        _, status, used = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        process.stdout.close()
        process.stderr.close()
        work_s = used.ru_utime + used.ru_stime
        if work_s < MOST_S:
            break
    name = " ".join(map(str, arguments))
    assert process.returncode >= 0, f"{name}: killed by signal {-process.returncode}: {err[:200]}"
    assert work_s < MOST_S, f"{name}: {work_s:.2f} s of work"
    assert used.ru_maxrss < MOST_MIB * 1024, f"{name}: {used.ru_maxrss / 1024:.0f} MiB"
    worst["s"], worst["MiB"] = max(worst["s"], work_s), max(worst["MiB"], used.ru_maxrss / 1024)
    return process.returncode, (out + err).decode(errors="replace")


def refused(file, *words):
    status, said = judged("import", file)
    assert status == INVALID and len(said) < 1000, f"{file.name}: exit {status}: {said[:300]}"
    for word in (file.name, *words):
        assert word in said, f"{file.name}: wanted {word!r}: {said}"


def told(files):
    note = f"{files} files, at most {worst['s']:.2f} s and {worst['MiB']:.0f} MiB"
    worst.update({"s": 0.0, "MiB": 0.0})
    return note


def samples(at):
    mesh = mesh_writers.triangulated(mesh_writers.torus(6, 5))
    for name, write, options in (("a.obj", mesh_writers.write_obj, ()), ("a.off", mesh_writers.write_off, ()),
                                 ("ascii.ply", mesh_writers.write_ply, ("ascii",)),
                                 ("little.ply", mesh_writers.write_ply, ("binary_little_endian",)),
                                 ("big.ply", mesh_writers.write_ply, ("binary_big_endian",)),
                                 ("ascii.stl", mesh_writers.write_stl, (False,)), ("binary.stl", mesh_writers.write_stl, (True,)),
                                 ("a.glb", mesh_writers.write_glb, (2,))):
        file = at / name
        write(file, mesh, *options)
        yield file, file.read_bytes()


def test_cut_and_flipped():
    dice, files = random.Random(7), 0
    with folder() as at:
        for file, good in samples(at):
            cuts = [round(len(good) * k / 12) for k in range(12)] + [len(good) - 1]
            flips = []
            for _ in range(20):
                flipped = bytearray(good)
                flipped[dice.randrange(len(good))] ^= 1 << dice.randrange(8)
                flips.append(bytes(flipped))
            for bad in [good[:cut] for cut in cuts] + flips:
                file.write_bytes(bad)
                status, said = judged("import", file)
                assert status in (DONE, FINDINGS, INVALID) and (status != INVALID or file.name in said), said
                files += 1
    return told(files)


def test_no_numbers():
    """NaN and infinity in a vertex of each format."""
    with folder() as at:
        count = 0
        for file, good in samples(at):
            for text, number in (("nan", float("nan")), ("inf", float("inf")), ("1e999", float("-inf"))):
                real = struct.pack(">f" if file.name == "big.ply" else "<f", number)
                bad = bytearray(good)
                if file.name in ("a.obj", "a.off", "ascii.ply", "ascii.stl"):
                    bad = good.replace(b"1.4 ", text.encode() + b" ", 1)
                elif file.name == "binary.stl":
                    bad[84 + 12 : 84 + 16] = real
                else:
                    start = good.index(b"end_header\n") + 11 if file.suffix == ".ply" else good.index(b"BIN\0") + 4
                    bad[start : start + 4] = real
                assert bytes(bad) != good, file
                file.write_bytes(bad)
                refused(file)
                count += 1
    return told(count)


def ply_head(form, vertices, faces, more=""):
    return (f"ply\nformat {form} 1.0\nelement vertex {vertices}\nproperty float x\nproperty float y\nproperty float z\n{more}"
            f"element face {faces}\nproperty list uint int vertex_indices\nend_header\n").encode()


def gltf(body):
    return b'{"asset":{"version":"2.0"},' + body + b"}"


def test_huge_counts_in_few_bytes():
    accessor = b'"accessors":[{"componentType":5126,"count":%d,"type":"VEC3"%s}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}]'
    box = b',"min":[0,0,0],"max":[0,0,0]'
    cases = {
        "billion.stl": b" " * 80 + struct.pack("<I", 10**9), "most.stl": b"solid".ljust(80) + b"\xff" * 4,
        "ascii.ply": ply_head("ascii", 10**9, 10**9), "binary.ply": ply_head("binary_big_endian", 2**32, 2**32),
        "list.ply": ply_head("binary_little_endian", 3, 1) + bytes(36) + b"\xff" * 4,
        "far.ply": ply_head("ascii", 2**63, 1), "negative.ply": ply_head("ascii", -1, 1),
        "counts.off": b"OFF\n4000000000 4000000000 0\n0 0 0\n", "most.off": b"OFF\n16777216 16777216 0\n0 0 0\n",
        "corners.off": b"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n900000000 0 1 2\n",
        "index.obj": b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 99999999999999999999\n",
        "count.gltf": gltf(accessor % (2**31, box)), "most.gltf": gltf(accessor % (2**53, box)),
        "view.gltf": gltf(b'"bufferViews":[{"buffer":0,"byteLength":9007199254740991}],"buffers":[{"byteLength":9007199254740991}]'),
        "inline.gltf": gltf(b'"buffers":[{"byteLength":4000000000,"uri":"data:application/octet-stream;base64,AAAA"}]'),
        "length.glb": struct.pack("<4sII", b"glTF", 2, 2**32 - 1), "chunk.glb": struct.pack("<4sIII4s", b"glTF", 2, 20, 2**32 - 1, b"JSON"),
        "nest.gltf": b"[" * MIB, "nest-objects.gltf": b'{"a":' * MIB, "values.gltf": b"[" + b"0," * (3 * MIB) + b"0]",
    }
    with folder() as at:
        for name, content in cases.items():
            (at / name).write_bytes(content)
            refused(at / name)
    return told(len(cases))


def filled(file, head, unit, size, tail=b""):
    """As many `unit` as fit between head and tail."""
    with open(file, "wb") as out:
        out.write(head)
        left = (size - len(head) - len(tail)) // len(unit) * len(unit)
        block = unit * (MIB // len(unit))
        while left > 0:
            left -= out.write(block[:left])
        out.write(tail)
    return file


def test_half_a_gibibyte():
    """As large as a file may be."""
    size = 512 * MIB
    cases = [("zeros.obj", b"", None), ("zeros.ply", b"", None), ("zeros.stl", b"", None), ("zeros.off", b"", None),
             ("zeros.gltf", b"", None), ("zeros.glb", struct.pack("<4sIII4s", b"glTF", 2, size, size - 20, b"JSON"), None),
             ("vertices.ply", ply_head("ascii", 10**7, 10**7), None), ("line.obj", b"v ", b"1"),
             ("face.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf", b" 1 2 3"), ("continued.obj", b"f 1 ", b"\\\n"), ("lines.obj", b"", b"\n"),
             ("comments.ply", b"ply\nformat ascii 1.0\n", b"comment x\n"), ("elements.ply", b"ply\nformat ascii 1.0\n", b"element a 1\n"),
             ("facets.stl", b"solid a\n", b"facet normal 0 0 0\nouter loop\n"), ("name.stl", b"solid ", b"a"),
             ("face.off", b"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n90000000", b" 1"), ("text.gltf", b'{"asset":{"version":"', b"y"),
             ("list.gltf", b"[", b"1,"), ("nest.gltf", b"", b"["), ("nodes.gltf", b'{"nodes":[{}', b",{}")]
    with folder() as at:
        for name, head, unit in cases:
            file = at / name
            if unit is None:
                file.write_bytes(head)
                os.truncate(file, size)
            else:
                filled(file, head, unit, size)
            refused(file)
            file.unlink()
        with open(at / "over.obj", "wb") as out:
            out.truncate(size + 1)
        refused(at / "over.obj", "536870912")
    return told(len(cases) + 1)


def png(width, height, data, *chunks):
    def chunk(name, content):
        return struct.pack(">I", len(content)) + name + content + struct.pack(">I", zlib.crc32(name + content))

    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0))
            + b"".join(chunk(*one) for one in chunks) + chunk(b"IDAT", data) + chunk(b"IEND", b""))


def test_pictures():
    """Deflate makes a thousand bytes of one: what a picture announces, and what it hides."""
    def zeros(size):
        deflate = zlib.compressobj(9)
        return b"".join(deflate.compress(bytes(MIB)) for _ in range(size // MIB)) + deflate.flush()

    bomb = zeros(1024 * MIB)
    cases = {"wide.png": png(2**31 - 1, 1, b""), "huge.png": png(16384, 16384, bomb), "short.png": png(8192, 8192, zeros(MIB)),
             "much.png": png(2, 2, bomb), "text.png": png(2, 2, b"", (b"zTXt", b"a\0\0" + bomb), (b"zTXt", b"b\0\0" + bomb)),
             "profile.png": png(2, 2, b"", (b"iCCP", b"a\0\0" + bomb)), "empty.png": b"", "cut.png": png(64, 64, zeros(MIB))[:60],
             "size.jpg": b"\xff\xd8\xff\xc0\0\x11\x08\xff\xff\xff\xff\x03\x01\x11\0\x02\x11\0\x03\x11\0\xff\xd9", "noise.jpg": b"\xff\xd8" * 999}
    with folder() as at:
        for name, content in cases.items():
            project = small_project(frames=1)
            project["objects"][0]["appearance"] = {"image": {"file": name}}
            write_project(at / "a", project)
            (at / "a" / name).write_bytes(content)
            status, said = judged("check", at / "a")
            assert status == INVALID and name in said, f"{name}: exit {status}: {said[:300]}"
    return told(len(cases))


if __name__ == "__main__":
    main([test_cut_and_flipped, test_no_numbers, test_huge_counts_in_few_bytes, test_half_a_gibibyte, test_pictures])
