#!/usr/bin/python3
"""`focalstage retina --sweep` end to end: the stack, its table and plot, and what a show without contrast gives."""

import csv
import signal
import subprocess
import time

from first_light import png16
from harness import ENVIRONMENT, FOCALSTAGE, PROJECTS, expect, focalstage, folder, main, small_project, succeed, write_project

LOOK = ("--eye", "left", "--size", "640x480", "--fov-deg", "40")


def test_a_stack_says_where_each_thing_is_sharpest():
    with folder() as at:
        succeed("compile", PROJECTS / "three-rabbits", "-o", at / "show.h5")
        told = succeed("retina", at / "show.h5", *LOOK, "--pupil-mm", "6", "--sweep", "0.5:3.5:13", "-o", at / "stack",
                       "--json").json()
        assert told["focus_d"][0] == 0.5 and told["focus_d"][-1] == 3.5 and len(told["focus_d"]) == 13
        assert sorted(p.name for p in (at / "stack").iterdir()) == ["contrast.csv", "contrast.png", *told["pictures"]]
        assert told["pictures"][3] == "focus-003-1.2500D.png"
        peaks = {thing["name"]: thing["peak_focus_d"] for thing in told["things"]}
        for name, wanted_d in (("near", 3), ("middle", 2), ("far", 1), ("near-block", 3), ("middle-block", 2), ("far-block", 1)):
            assert abs(peaks[name] - wanted_d) < 0.25, (name, peaks)  # the spacing of the foci
        rows = list(csv.DictReader((at / "stack" / "contrast.csv").open()))
        assert [float(row["focus_d"]) for row in rows] == told["focus_d"]
        assert abs(float(rows[6]["focus_m"]) - 0.5) < 1e-9
        near = next(thing for thing in told["things"] if thing["name"] == "near")
        assert [float(row["near.sharpness"]) for row in rows] == near["sharpness"]
        far_off, own = (float(rows[i]["near.blur_radius_arcmin"]) for i in (0, 10))
        assert own < 2 < far_off < 27, (own, far_off)  # 2.5 D by 3 mm: 25.8 arc minutes

        # A picture of the stack is the picture of a single look.
        succeed("retina", at / "show.h5", *LOOK, "--pupil-mm", "6", "--focus-m", "0.5", "-o", at / "one.png")
        one, of_stack = png16(at / "one.png"), png16(at / "stack" / told["pictures"][6])
        assert one == of_stack
        text = succeed("retina", at / "show.h5", *LOOK, "--sweep", "1.5:2.5:3", "-o", at / "short").out
        assert "at the end of the sweep" in text and "middle-block" in text, text


def test_infinity_and_nothing_to_see():
    with folder() as at:
        project = small_project()
        project["objects"] = []
        project["surfaces"][0]["illumination"] = 0
        write_project(at / "dark", project)
        succeed("compile", at / "dark", "-o", at / "dark.h5")
        told = succeed("retina", at / "dark.h5", *LOOK, "--sweep", "0:1:2", "-o", at / "stack", "--json").json()
        assert all(thing["peak_focus_d"] is None and not thing["peak_inside"] for thing in told["things"]), told
        rows = list(csv.DictReader((at / "stack" / "contrast.csv").open()))
        assert rows[0]["focus_m"] == "" and rows[1]["focus_m"] == "1", rows
        text = succeed("retina", at / "dark.h5", *LOOK, "--sweep", "0:1:2", "-o", at / "stack").out
        assert "has contrast" in text, text
        assert (at / "stack" / "contrast.png").read_bytes().startswith(b"\x89PNG")


def test_a_sweep_stops_at_once():
    with folder() as at:
        write_project(at / "small", small_project())
        succeed("compile", at / "small", "-o", at / "small.h5")
        process = subprocess.Popen([FOCALSTAGE, "retina", str(at / "small.h5"), "--eye", "left", "--size", "1000x750",
                                    "--sweep", "0.5:3.5:1000", "-o", str(at / "stack")],
                                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        deadline = time.monotonic() + 60
        while not any((at / "stack").glob("focus-*.png")) and time.monotonic() < deadline:
            time.sleep(0.02)
        process.send_signal(signal.SIGINT)
        assert process.wait(10) == -signal.SIGINT
        assert not (at / "stack" / "contrast.csv").exists()
        for picture in (at / "stack").glob("focus-*.png"):
            assert picture.read_bytes().endswith(b"IEND\xaeB`\x82"), picture


def test_a_folder_that_cannot_be_made():
    with folder() as at:
        write_project(at / "small", small_project())
        succeed("compile", at / "small", "-o", at / "small.h5")
        expect(focalstage("retina", at / "small.h5", *LOOK, "--sweep", "1:2:3", "-o", at / "small.h5" / "x"), ENVIRONMENT, "folder")


if __name__ == "__main__":
    main([test_a_stack_says_where_each_thing_is_sharpest, test_infinity_and_nothing_to_see, test_a_sweep_stops_at_once,
          test_a_folder_that_cannot_be_made])
