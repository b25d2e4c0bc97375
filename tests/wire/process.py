#!/usr/bin/python3
"""What is done to meshes after they were read: told in millimetres, and a picture's place made by the remedy."""

import json
import math
import zlib

from harness import DONE, FINDINGS, INVALID, USAGE, expect, focalstage, folder, main, small_project, succeed, write_project
from hostile_files import png
from mesh_readers import count_triangles


def write_wave(file, n):
    """A wave of n by n squares over a square metre, without texture coordinates."""
    lines = [f"v {x / n - 0.5:.9g} {y / n - 0.5:.9g} {0.02 * math.sin(6 * x / n) * math.cos(5 * y / n):.9g}"
             for y in range(n + 1) for x in range(n + 1)]
    for y in range(n):
        for x in range(n):
            a = y * (n + 1) + x + 1
            lines.append(f"f {a} {a + 1} {a + n + 2} {a + n + 1}")
    file.write_text("\n".join(lines) + "\n")


def wave_project(at, **surface):
    project = small_project(frames=1)
    project["surfaces"][0].update(mesh={"file": "wave.obj", "process": surface.pop("process", [])}, **surface)
    file = write_project(at, project)
    write_wave(at / "wave.obj", 40)
    return file


def test_deviation():
    with folder() as at:
        file = wave_project(at / "wave", process=[{"step": "decimate", "error_mm": 0.5}], scale=0.5)
        thing, = succeed("process", file, "--json").json()["things"]
        assert (thing["list"], thing["name"], thing["triangles_before"]) == ("surfaces", "screen", 3200), thing
        assert 0 < thing["triangles_after"] < 1600, thing
        # What is left stands on what was there; what went is no further off than asked, in the room's millimetres.
        assert thing["worst_mm"] < 1e-6 and 0.05 < thing["worst_lost_mm"] < 0.55, thing
        smoothed = wave_project(at / "smooth", process=[{"step": "smooth", "rounds": 50}])
        thing, = succeed("process", smoothed, "-o", at / "colours", "--json").json()["things"]
        assert thing["worst_mm"] > thing["mean_mm"] > 0, thing
        ply = at / "colours/1-screen.ply"
        assert count_triangles(ply) == 3200
        colours = [tuple(map(int, line.split()[3:])) for line in ply.read_text().split("end_header\n")[1].splitlines()[: 41 * 41]]
        assert max(colours)[0] == 255 and (255, 0, 0) in colours, "the worst vertex is red"
        assert colours[0] == (0, 51, 255), "a corner of the border stays: blue"
        # A coarser scale makes all of it blue.
        succeed("process", smoothed, "-o", at / "coarse", "--full-scale-mm", "100000")
        rows = (at / "coarse/1-screen.ply").read_text().split("end_header\n")[1].splitlines()[: 41 * 41]
        assert {row.split()[5] for row in rows} <= {"255", "254"}
        # The table says the same words.
        assert "screen" in succeed("process", smoothed).out
        expect(focalstage("process", smoothed, "--full-scale-mm", "0"), USAGE, "full-scale-mm")
        expect(focalstage("process", at / "none"), INVALID, "none")


def test_picture_finds_its_place():
    with folder() as at:
        file = wave_project(at / "wave", albedo={"file": "paint.png"})
        (at / "wave/paint.png").write_bytes(png(2, 2, zlib.compress(bytes(14))))
        findings = expect(focalstage("check", file, "--json"), DONE).json()["findings"]
        assert [one["where"] for one in findings if one["code"] == "mesh.no-uv"] == ["/surfaces/0/albedo"], findings
        project = json.loads(file.read_text())
        project["surfaces"][0]["albedo"] = [1, 1, 1]
        project["objects"][0].update(mesh={"file": "wave.obj"}, scale=0.1,
                                     appearance={"checker": {"squares": [2, 2], "a": [1, 1, 1], "b": [0, 0, 0]}})
        file.write_text(json.dumps(project))
        ran = focalstage("check", file, "--json")
        assert ran.status in (DONE, FINDINGS), ran
        finding, = [one for one in ran.json()["findings"] if one["code"] == "mesh.no-uv"]
        assert finding["where"] == "/objects/0/appearance" and "box" in finding["message"], finding
        edits = at / "edits.jsonl"
        edits.write_text("".join(json.dumps(edit) + "\n" for edit in finding["remedy"]))
        succeed("apply", file, edits)
        assert json.loads(file.read_text())["objects"][0]["mesh"]["process"][0]["step"] == "uv-plane"
        after = focalstage("check", file, "--json").json()["findings"]
        assert not [one for one in after if one["code"] == "mesh.no-uv"], after
        # By the projector: what stands behind it is refused by its step.
        project = json.loads(file.read_text())
        project["objects"][0]["mesh"]["process"] = [{"step": "uv-projector", "position_m": [0, 0, 1]}]
        file.write_text(json.dumps(project))
        assert focalstage("check", file, "--json").status in (DONE, FINDINGS)
        project["objects"][0]["mesh"]["process"][0]["position_m"] = [0, 0, -1]
        file.write_text(json.dumps(project))
        expect(focalstage("check", file), INVALID, "/objects/0/mesh/process/0/position_m", "behind the projector")


if __name__ == "__main__":
    main([test_deviation, test_picture_finds_its_place])
