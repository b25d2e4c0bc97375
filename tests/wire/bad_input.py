#!/usr/bin/python3
"""What anyone may feed the command line: a clear line, the right status, never a crash or a hang."""

import json
import os
import pathlib
import random

from harness import (DONE, ENVIRONMENT, FINDINGS, INVALID, USAGE, expect, focalstage, folder, main, small_project, succeed,
                     write_project)


def test_usage():
    expect(focalstage("comple"), USAGE, "comple")
    expect(focalstage("compile"), USAGE, "compile --help")
    expect(focalstage("compile", "x"), USAGE, "--output")
    expect(focalstage("compile", "x", "-o", "y", "--threads", "0"), USAGE, "threads")
    expect(focalstage("compile", "x", "-o", "y", "--frames", "five"), USAGE, "five", "A:B")
    expect(focalstage("check", "x", "--jsn"), USAGE, "--jsn")
    expect(focalstage("retina", "x", "--eye", "third", "--focus-m", "1", "-o", "y"), USAGE, "third")
    expect(focalstage("retina", "x", "--eye", "left", "--focus-m", "0", "-o", "y"), USAGE, "focus-m")
    expect(focalstage("retina", "x", "--eye", "left", "--focus-m", "1", "-o", "y", "--size", "9"), USAGE, "9", "WxH")
    expect(focalstage("retina", "x", "--eye", "left", "--focus-m", "nan", "-o", "y"), USAGE, "focus-m")
    look = ("retina", "x", "--eye", "left")
    expect(focalstage(*look, "-o", "y"), USAGE, "--focus-m", "--sweep")
    expect(focalstage(*look, "-o", "y", "--focus-m", "1", "--sweep", "1:2:3"), USAGE, "--sweep")
    for text, word in (("1:2", "range"), ("1:2:3:4", "range"), ("1:2:three", "range"), ("", "FROM:TO:COUNT"), ("2:1:3", "below"),
                       ("1:1:3", "below"), ("1:2:1", "2 to 1000"), ("1:2:1001", "2 to 1000"), ("nan:2:3", "focuses"),
                       ("1:nan:3", "focuses"), ("-1:2:3", "focuses"), ("1:inf:3", "focuses"), ("1:2:99999999999", "range")):
        expect(focalstage(*look, "-o", "y", "--sweep=" + text), USAGE, word)
    expect(focalstage(*look, "-o", "y", "--sweep", "1:2:3", "--rays", "4"), USAGE, "--rays")
    expect(focalstage(*look, "-o", __file__, "--sweep", "1:2:3"), USAGE, "bad_input.py", "folder")
    expect(focalstage("rig", "dance"), USAGE, "dance")
    expect(focalstage("rig", "cue"), USAGE, "NAME")
    expect(focalstage("new", "/tmp/never-made", "--from", "nothing"), USAGE, "nothing", "three-rabbits")


def test_missing_files():
    with folder() as at:
        expect(focalstage("check", at / "none"), INVALID, "none")
        expect(focalstage("compile", at / "none.focal", "-o", at / "x.h5"), INVALID, "none.focal")
        expect(focalstage("check", at / "none.h5"), INVALID, "none.h5")
        expect(focalstage("export", at / "none.h5", "-o", at / "x"), INVALID, "none.h5")
        expect(focalstage("retina", at / "none.h5", "--eye", "left", "--focus-m", "1", "-o", at / "x.png"), INVALID, "none.h5")
        expect(focalstage("retina", at / "none.h5", "--eye", "left", "--sweep", "1:2:3", "-o", at / "x"), INVALID, "none.h5")
        assert not (at / "x").exists()
        expect(focalstage("import", at / "none.glb"), INVALID, "none.glb")
        expect(focalstage("apply", at / "none", at / "e.jsonl"), INVALID, "none")
        expect(focalstage("edit"), ENVIRONMENT, "focalstage-editor")
        write_project(at / "small", small_project())
        expect(focalstage("apply", at / "small", at / "e.jsonl"), INVALID, "e.jsonl")
        (at / "empty").mkdir()
        expect(focalstage("check", at / "empty"), INVALID, "empty")
        expect(focalstage("push", at / "none.h5", "--to", "127.0.0.1:1"), ENVIRONMENT, "127.0.0.1:1")
        expect(focalstage("rig", "state", "--to", "nonsense"), ENVIRONMENT, "nonsense")


def test_json_that_is_none():
    good = json.dumps(small_project())
    cases = {
        "empty": ("", ""),
        "truncated": (good[: len(good) // 2], ""),
        "binary": (bytes(range(256)) * 8, ""),
        "deep": ("[" * 10000 + "]" * 10000, ""),
        "deep-object": ('{"a":' * 10000 + "1" + "}" * 10000, ""),
        "nan": (good.replace('"name": "Small"', '"name": NaN'), "line"),
        "infinity": (good.replace("0.515", "1e999"), "line"),
        "array": ("[1, 2]", ""),
        "twice": ('{"focalstage": 1, "focalstage": 1}', "focalstage"),
        "newer": (good.replace('"focalstage": 1', '"focalstage": 99'), "99"),
        "no-text": (good.replace('"Small"', '"\ud800"'.encode("utf-8", "surrogatepass").decode("latin-1")), ""),
    }
    with folder() as at:
        for name, (text, word) in cases.items():
            (at / name).mkdir()
            file = at / name / f"{name}.focal"
            file.write_bytes(text if isinstance(text, bytes) else text.encode("latin-1"))
            if name == "no-text":
                continue
            expect(focalstage("check", file), INVALID, f"{name}.focal", word)
    return f"{len(cases)} files"


def test_one_gibibyte_of_json():
    with folder() as at:
        (at / "huge").mkdir()
        file = at / "huge/huge.focal"
        with open(file, "wb") as out:
            out.write(b'{"focalstage": 1, "name": "')
            out.truncate(1 << 30)  # a sparse gibibyte of zeros
        expect(focalstage("check", file), INVALID, "huge.focal")


def test_values_out_of_range():
    """Each one is named by its JSON pointer."""
    def change(pointer, value):
        project = small_project()
        *path, last = pointer.strip("/").split("/")
        at = project
        for key in path:
            at = at[int(key)] if isinstance(at, list) else at[key]
        at[last] = value
        return project

    cases = [
        ("/projectors/0/width_px", 0), ("/projectors/0/height_px", -4), ("/projectors/0/frames_per_second", 0),
        ("/projectors/0/bits", 64), ("/projectors/0/fx_px", 0), ("/projectors/0/gamma", -1),
        ("/slices/powers_d", []), ("/slices/powers_d", "none"), ("/frames/count", 0), ("/frames/rate_hz", -60),
        ("/surfaces/0/mesh", {"primitive": "plane", "size_m": [0, 1]}),
        ("/surfaces/0/mesh", {"primitive": "plane", "size_m": [-1, 1]}), ("/surfaces/0/mesh", {"primitive": "cube"}),
        ("/surfaces/0/illumination", 2), ("/objects/0/position_m", [0, 0]), ("/objects/0/rotation_xyzw", [0, 0, 0, 0]),
        ("/objects/0/scale", 0), ("/objects/0/depth", {"mode": "deep"}),
    ]
    with folder() as at:
        for k, (pointer, value) in enumerate(cases):
            file = write_project(at / f"case{k}", change(pointer, value))
            ran = focalstage("check", file)
            assert ran.status == INVALID, f"{pointer} = {value}: {ran}"
            expect(ran, INVALID, f"case{k}.focal", pointer)
    return f"{len(cases)} values"


def test_assets():
    with folder() as at:
        def with_mesh(name, path):
            project = small_project(frames=1)
            project["objects"][0]["mesh"] = {"file": path}
            return write_project(at / name, project)

        expect(focalstage("check", with_mesh("missing", "assets/none.obj")), INVALID, "none.obj")
        (at / "outside.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
        expect(focalstage("check", with_mesh("leaving", "../outside.obj")), INVALID, "outside.obj")
        expect(focalstage("check", with_mesh("absolute", "/etc/passwd")), INVALID, "/etc/passwd")
        with_mesh("linked", "assets/link.obj")
        (at / "linked/assets").mkdir()
        os.symlink(at / "outside.obj", at / "linked/assets/link.obj")
        expect(focalstage("check", at / "linked"), INVALID, "link.obj")
        with_mesh("garbage", "mesh.obj")
        (at / "garbage/mesh.obj").write_bytes(random.Random(1).randbytes(4096))
        expect(focalstage("check", at / "garbage"), INVALID, "mesh.obj")


def test_mesh_files():
    with folder() as at:
        (at / "triangle.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
        found = succeed("import", at / "triangle.obj", "--json").json()
        assert (found["vertices"], found["triangles"]) == (3, 1), found
        assert set(found) >= {"vertices", "triangles", "nodes", "animations", "findings"}, found
        random_bytes = random.Random(2)
        for ending in ("obj", "ply", "stl", "off", "gltf", "glb"):
            for size in (0, 1, 83, 84, 5000):
                file = at / f"random-{size}.{ending}"
                file.write_bytes(random_bytes.randbytes(size))
                expect(focalstage("import", file), INVALID, file.name)
        # One node that is its own child's child.
        cycle = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
                 "nodes": [{"children": [1]}, {"children": [0]}]}
        (at / "cycle.gltf").write_text(json.dumps(cycle))
        expect(focalstage("import", at / "cycle.gltf"), INVALID, "cycle.gltf")


def test_edits():
    with folder() as at:
        project = write_project(at / "small", small_project(frames=1))
        before = project.read_bytes()
        edits = at / "edits.jsonl"

        edits.write_text('{"edit":"set","list":"objects","name":"box","key":"scale","value":2}\n\n')
        succeed("apply", project, edits, "-o", at / "other")
        assert project.read_bytes() == before, "-o changed the project itself"
        assert json.loads((at / "other/other.focal").read_text())["objects"][0]["scale"] == 2

        edits.write_text('{"edit":"set","list":"objects","name":"box","key":"scale","value":2}\nnonsense\n')
        expect(focalstage("apply", project, edits), INVALID, "edits.jsonl", "line 2")
        edits.write_text('{"edit":"set","list":"objects","name":"nobody","key":"scale","value":2}\n')
        expect(focalstage("apply", project, edits), INVALID, "nobody")
        edits.write_text('{"edit":"dance","list":"objects","name":"box"}\n')
        expect(focalstage("apply", project, edits), INVALID, "line 1")
        assert project.read_bytes() == before, "a refused edit changed the project"


def test_findings_are_no_failure_to_write():
    """Findings of severity error: the show is there, the status is 1."""
    with folder() as at:
        write_project(at / "wide", small_project(frames=1, slices={"powers_d": [-0.5, 0, 5]}))
        ran = focalstage("compile", at / "wide", "-o", at / "wide.h5", "--json")
        assert ran.status == FINDINGS, ran
        codes = [f["code"] for f in ran.json()["findings"] if f["severity"] == "error"]
        assert "slices.outside-sweep" in codes and "slices.spacing" in codes, codes
        assert (at / "wide.h5").exists()
        checked = focalstage("check", at / "wide.h5", "--json")
        assert checked.status == FINDINGS and checked.json()["findings"] == ran.json()["findings"], checked


def test_optimal_and_its_reference():
    """What optimal gains is reported, also of frames that were taken over; the reference has none and says so."""
    with folder() as at:
        succeed("new", at / "card", "--from", "occlusion")
        report = succeed("compile", at / "card", "-o", at / "card.h5", "--json").json()
        assert report["slowest_frame_ms"] > 0
        for eye in ("left", "right"):
            measure = report["optimal"][eye]
            assert measure["tiles"] >= measure["accepted_tiles"] > 50 and measure["left_tiles"] == 0, measure
            assert measure["gain_db"] > 8 and 20 < measure["linear_psnr_db"] < 35, measure
        refused = focalstage("compile", at / "card", "-o", at / "naive.h5", "--reference")
        expect(refused, INVALID, "/slices/assignment", "optimal", "--reference")
        assert sorted(p.name for p in at.iterdir()) in (["card", "card.h5"], ["card", "card.h5", "naive.h5.part"])
        write_project(at / "plain", small_project(frames=1))
        assert "optimal" not in succeed("compile", at / "plain", "-o", at / "plain.h5", "--json").json()


def test_new_does_not_overwrite():
    with folder() as at:
        succeed("new", at / "a")
        text = (at / "a/a.focal").read_bytes()
        expect(focalstage("new", at / "a"), INVALID, "a")
        assert (at / "a/a.focal").read_bytes() == text
        (at / "file").write_text("")
        expect(focalstage("new", at / "file"), INVALID, "file")
        expect(focalstage("new", at / "file/below"), ENVIRONMENT, "below")


def test_frames_outside():
    with folder() as at:
        write_project(at / "small", small_project(frames=4))
        for frames in ("0:5", "2:2", "3:1", "-1:2"):
            expect(focalstage("compile", at / "small", "-o", at / "x.h5", f"--frames={frames}"), USAGE, frames)
        assert succeed("compile", at / "small", "-o", at / "x.h5", "--frames", "1:3", "--json").json()["frames"] == 2
        assert sorted(p.name for p in at.iterdir()) == ["small", "x.h5"]


def test_shows_cut_and_flipped():
    """A show cut anywhere or with a flipped bit is refused, or read as what it is: never a crash."""
    dice = random.Random(3)
    with folder() as at:
        write_project(at / "small", small_project(frames=2))
        succeed("compile", at / "small", "-o", at / "good.h5")
        good = (at / "good.h5").read_bytes()
        bad = at / "bad.h5"
        for _ in range(20):
            bad.write_bytes(good[: dice.randrange(len(good))])
            expect(focalstage("check", bad), INVALID, "bad.h5")
        for _ in range(40):
            flipped = bytearray(good)
            flipped[dice.randrange(len(good))] ^= 1 << dice.randrange(8)
            bad.write_bytes(flipped)
            expect(focalstage("check", bad), INVALID, "bad.h5")
        assert focalstage("check", at / "good.h5").status == DONE
    return f"{len(good)} bytes, 20 cuts, 40 flips"


def test_closed_output():
    with folder() as at:
        write_project(at / "small", small_project(frames=1))
        if pathlib.Path("/dev/full").exists():
            import subprocess
            from harness import FOCALSTAGE
            with open("/dev/full", "w") as full:
                ran = subprocess.run([FOCALSTAGE, "check", str(at / "small")], stdout=full, stderr=subprocess.PIPE, text=True)
            assert ran.returncode == ENVIRONMENT and "output" in ran.stderr, ran


if __name__ == "__main__":
    main([test_usage, test_missing_files, test_json_that_is_none, test_one_gibibyte_of_json, test_values_out_of_range,
          test_assets, test_mesh_files, test_edits, test_findings_are_no_failure_to_write, test_new_does_not_overwrite,
          test_frames_outside, test_shows_cut_and_flipped, test_closed_output])
