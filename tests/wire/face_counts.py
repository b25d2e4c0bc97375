#!/usr/bin/python3
"""Every face of every format arrives: what `focalstage import` counts is what readers count that share nothing with it."""

import pathlib
import random
import re
import subprocess

import mesh_writers
from harness import DONE, FINDINGS, focalstage, folder, main
from mesh_readers import count_triangles

FIXTURES = pathlib.Path(__file__).resolve().parents[1] / "io/assets/fixture"
ENDIANNESSES = ("ascii", "binary_little_endian", "binary_big_endian")


def imported(file):
    ran = focalstage("import", file, "--json")
    assert ran.status in (DONE, FINDINGS), ran
    return ran.json()["triangles"]


def assimp(*arguments):
    return subprocess.run(["assimp", *map(str, arguments)], capture_output=True, text=True, check=True, timeout=60).stdout


def assimp_faces(file):
    return int(re.search(r"^Faces:\s+(\d+)", assimp("info", file, "-r"), re.MULTILINE).group(1))


def expect_count(file, truth):
    read, found = count_triangles(file), imported(file)
    assert read == truth, f"{file.name}: {truth} were written, a reader counts {read}"
    assert found == truth, f"{file.name}: {truth} were written, focalstage counts {found}"


def meshes():
    dice = random.Random(20261123)
    return {"one": ([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [[0, 1, 2]]), "torus": mesh_writers.torus(8, 6),
            "polygons": mesh_writers.polygons(50), "soup": mesh_writers.soup(dice, 200, 900),
            "large": mesh_writers.torus(300, 200)}


def test_formats_of_polygons():
    """OBJ, OFF and PLY in every byte order and with every type of list."""
    files = 0
    with folder() as at:
        for name, mesh in meshes().items():
            truth = sum(len(face) - 2 for face in mesh[1])
            written = [(at / f"{name}.obj", mesh_writers.write_obj, ()), (at / f"{name}.off", mesh_writers.write_off, ())]
            for form in ENDIANNESSES:
                for types in (("float", "uchar", "int"), ("double", "ushort", "uint"), ("float", "int", "uint")):
                    written.append((at / f"{name}-{form}-{'-'.join(types)}.ply", mesh_writers.write_ply, (form, *types)))
            for file, write, options in written:
                write(file, mesh, *options)
                expect_count(file, truth)
                files += 1
    return f"{files} files"


def test_formats_of_triangles():
    """STL in text and in bytes, GLB with every index."""
    files = 0
    with folder() as at:
        for name, mesh in meshes().items():
            places, faces = mesh_writers.triangulated(mesh)
            for form, write, option in (("ascii.stl", mesh_writers.write_stl, False), ("binary.stl", mesh_writers.write_stl, True),
                                        *((f"{size}.glb", mesh_writers.write_glb, size) for size in (0, 1, 2, 4))):
                if form.endswith(".glb") and option and len(places) > 2 ** (8 * option) - 1:
                    continue
                file = at / f"{name}-{form}"
                write(file, (places, faces), option)
                expect_count(file, len(faces))
                files += 1
    return f"{files} files"


def test_against_assimp():
    """What assimp reads, raw, has as many faces; what assimp writes of them has, too."""
    files = 0
    with folder() as at:
        for name, polygons in meshes().items():
            mesh = mesh_writers.triangulated(polygons)
            truth = len(mesh[1])
            written = []
            for suffix, write, options in (("obj", mesh_writers.write_obj, ()), ("off", mesh_writers.write_off, ()),
                                           ("stl", mesh_writers.write_stl, (True,)), ("glb", mesh_writers.write_glb, (4,)),
                                           *(("ply", mesh_writers.write_ply, (form,)) for form in ENDIANNESSES)):
                file = at / f"{name}-{len(written)}.{suffix}"
                write(file, mesh, *options)
                written.append(file)
            for form, suffix in (("ply", "ply"), ("plyb", "ply"), ("stl", "stl"), ("stlb", "stl"), ("obj", "obj"), ("glb2", "glb"),
                                 ("gltf2", "gltf")):
                file = at / f"{name}-by-assimp-{form}.{suffix}"
                assimp("export", written[0], file, f"-f{form}")
                written.append(file)
            for file in written:
                faces = assimp_faces(file)
                assert faces == imported(file) == count_triangles(file), f"{file.name}: assimp {faces}, here {imported(file)}"
                assert "assimp" in file.name or faces == truth, f"{file.name}: {truth} were written, assimp has {faces}"
            files += len(written)
    return f"{files} files"


def test_fixtures():
    """Files that other programs wrote: a torus of 8 by 6 quads."""
    files = [file for file in sorted(FIXTURES.iterdir()) if file.suffix in (".obj", ".ply", ".stl", ".off", ".gltf", ".glb")]
    assert len(files) >= 7
    for file in files:
        expect_count(file, 96)
    return f"{len(files)} files"


if __name__ == "__main__":
    main([test_formats_of_polygons, test_formats_of_triangles, test_against_assimp, test_fixtures])
