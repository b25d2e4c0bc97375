#!/usr/bin/python3
"""focalstage calibrate viewer: simulated eyes are found, most through a simulated rig, and what is wrong is said."""

import json
import math
import random
import signal
import subprocess
import time

from harness import DONE, ENVIRONMENT, FINDINGS, FOCALSTAGE, INVALID, USAGE, expect, focalstage, folder, free_port, main, \
    rig, succeed, write_project


def room(**changes):
    project = {
        "focalstage": 1,
        "name": "Room",
        "glasses": {"lens_to_pupil_mm": 15},
        "projectors": [{"name": "main", "width_px": 1024, "height_px": 768, "frames_per_second": 2000, "bits": 8,
                        "latency_ms": 0.15, "fx_px": 1500, "fy_px": 1500, "cx_px": 512, "cy_px": 384,
                        "position_m": [0, 0, 0.4], "rotation_xyzw": [0, 0, 0, 1]}],
        "slices": {"powers_d": [-1, 0, 1]},
        "surfaces": [{"name": "wall", "mesh": {"primitive": "plane", "size_m": [1, 1]}, "position_m": [0, 0, -0.515]}],
        "objects": [{"name": "card", "mesh": {"primitive": "plane", "size_m": [0.1, 0.1]}, "position_m": [0, 0, -0.515]}],
    }
    project.update(changes)
    return project


def ask(action, *arguments, **more):
    return focalstage("calibrate", "viewer", action, *arguments, **more)


def adopted(at, address):
    file = write_project(at / "room", room())
    succeed("adopt-rig", at / "room", "--to", address)
    return file


def expect_dark(address):
    state = succeed("rig", "state", "--to", address, "--json").json()
    assert state["state"] == "ready", state  # dark, not latched


def test_a_distance_from_lens_to_pupil_is_found():
    with folder() as at, rig(at, "--virtual-time") as address:
        adopted(at, address)
        for true_mm, eye in ((11.5, "left"), (21.0, "right")):
            ran = ask("lens-to-pupil", at / "room", "--to", address, "--eye", eye, "--scripted", true_mm, "--json", "-o",
                      at / eye)
            assert ran.status == DONE, ran
            found = ran.json()
            assert found["answers"] == 40 and found["observer"] == "scripted" and found["applied"], found
            assert abs(found["lens_to_pupil_mm"] - true_mm) < 2.5 * found["uncertainty_mm"] + 0.2, found
            assert found["uncertainty_mm"] < 1, found
            project = json.loads((at / eye / f"{eye}.focal").read_text())
            assert abs(project["glasses"]["lens_to_pupil_mm"] - found["lens_to_pupil_mm"]) < 0.006, project["glasses"]
            assert [o["name"] for o in project["objects"]] == ["card"], "the pattern stays out of the project"
        expect_dark(address)


def test_keys_say_what_a_simulated_eye_says():
    """The keys of what a simulated eye answered lead a person to the same value."""
    with folder() as at, rig(at, "--virtual-time") as address:
        adopted(at, address)
        for action, more, above, below, suffixes in (("lens-to-pupil", ("--scripted", 17), "d", "u", [""]),
                                                     ("interpupillary", ("--scripted", 61), "l", "r", [".left", ".right"])):
            always = (at / "room", "--to", address, "--dry-run", "--json", "--questions", 20,
                      "--despite-uncertainty")
            always += ("--thread-m", 0.25) if action == "interpupillary" else ()
            ran = ask(action, *always, *more, "--answers", at / action)
            assert ran.status == DONE, ran
            rows = [line for end in suffixes for line in (at / (action + end)).read_text().splitlines()[1:]]
            assert len(rows) == 20 * len(suffixes), rows
            keys = "".join(above if row.endswith(",above") else below for row in rows)
            person = ask(action, *always, stdin=keys)
            assert person.status == DONE, person
            wanted = {**ran.json(), "observer": "human"}
            assert person.json() == wanted, (person.json(), wanted)


def test_an_interpupillary_distance_is_found():
    with folder() as at, rig(at, "--virtual-time") as address:
        file = adopted(at, address)
        ran = ask("interpupillary", at / "room", "--to", address, "--thread-m", 0.25, "--scripted", 58.3, "--json")
        assert ran.status == DONE, ran
        found = ran.json()
        assert abs(found["interpupillary_mm"] - 58.3) < 2.5 * found["answers_uncertainty_mm"] + 0.1, found
        assert 0.5 < found["thread_uncertainty_mm"] < 0.8 and found["uncertainty_mm"] < 1, found
        assert abs(json.loads(file.read_text())["viewer"]["interpupillary_mm"] - found["interpupillary_mm"]) < 0.006
        vague = ("--to", address, "--thread-m", "0.25", "--thread-uncertainty-mm", "5", "--scripted", "58", "--questions", "12")
        expect(ask("interpupillary", at / "room", *vague), INVALID, "viewer.uncertain")
        expect(ask("interpupillary", at / "room", "--to", address, "--thread-m", "0.6", "--scripted", "58"), INVALID,
               "viewer.thread")
        expect(ask("interpupillary", at / "room", "--to", address), USAGE, "--thread-m")
        expect_dark(address)


def test_a_lens_that_is_off_is_found():
    with folder() as at, rig(at, "--virtual-time") as address:
        file = adopted(at, address)
        before = file.read_text()
        for error_d, status in ((0.2, FINDINGS), (0.0, DONE)):
            ran = ask("lens-power", at / "room", "--to", address, "--focus-m", 0.45, "--focus-uncertainty-d", 0.02,
                      "--scripted", error_d, "--json")
            assert ran.status == status, ran
            found = ran.json()
            assert abs(found["power_d"] - (2 - 1 / 0.45)) < 1e-3, found
            assert abs(found["error_d"] - error_d) < 2.5 * found["uncertainty_d"], found
            assert found["differs"] == (status == FINDINGS) and found["uncertainty_d"] < 0.08, found
        expect(ask("lens-power", at / "room", "--to", address, "--focus-m", "1", "--scripted", "0"), INVALID,
               "viewer.unreachable", "1.00 D")
        assert file.read_text() == before, "a check changes nothing"
        expect_dark(address)


def test_killed_and_gone_on():
    """Killed at a random moment, a test goes on with the answers there are and ends as one that was not."""
    seed = random.SystemRandom().randrange(1 << 32)
    dice = random.Random(seed)
    with folder() as at:
        with rig(at, "--virtual-time") as address:
            adopted(at, address)
            arguments = ("--scripted", "17", "--dry-run", "--json")
            whole = ask("lens-to-pupil", at / "room", "--to", address, *arguments).json()
        answers = at / "answers"
        for attempt in range(2):
            store = at / str(attempt)
            store.mkdir()
            with rig(store, "--virtual-time") as address:  # a rig of its own: no lease of the one before to wait for
                process = subprocess.Popen([FOCALSTAGE, "calibrate", "viewer", "lens-to-pupil", str(at / "room"), "--to",
                                            address, "--answers", str(answers), *arguments], stdout=subprocess.DEVNULL)
                rows = answers.read_text().count("\n") if answers.exists() else 1
                wanted = rows + dice.randrange(1, 12)
                while process.poll() is None and (not answers.exists() or answers.read_text().count("\n") < wanted):
                    time.sleep(0.002)
                process.send_signal(signal.SIGKILL)
                process.wait()
        kept = answers.read_text()
        assert 3 <= kept.count("\n") < 41, f"seed {seed}: {kept}"
        with rig(at, "--virtual-time") as address:
            ran = ask("lens-to-pupil", at / "room", "--to", address, "--answers", answers, *arguments)
            assert ran.status == DONE and ran.json() == whole, f"seed {seed}: {ran}, wanted {whole}"
            assert answers.read_text().startswith(kept[: kept.rindex("\n") + 1]), f"seed {seed}: answers were lost"
            expect(ask("lens-to-pupil", at / "room", "--to", address, "--eye", "right", "--answers", answers, *arguments),
                   INVALID, "viewer.answers")


def turned(q, v):
    """v turned by the quaternion x y z w."""
    x, y, z, w = q
    a, b, c = (y * v[2] - z * v[1], z * v[0] - x * v[2], x * v[1] - y * v[0])
    return [v[0] + 2 * (w * a + y * c - z * b), v[1] + 2 * (w * b + z * a - x * c), v[2] + 2 * (w * c + x * b - y * a)]


def sightings(path, wrong_mm=0.0, turn_rad=0.3, eyes=("left", "right")):
    """A head that turns about its neck; the spot is where the way from eye to mark meets the wall z = -0.7."""
    lines = ["name,eye,body_x_m,body_y_m,body_z_m,body_qx,body_qy,body_qz,body_qw,mark_x_m,mark_y_m,mark_z_m,"
             "spot_x_m,spot_y_m,spot_z_m"]
    mark = [0.01, 0.02, -0.3]
    for i in range(12):
        eye = eyes[i % len(eyes)]
        axis = (math.cos(2.4 * i), math.sin(2.4 * i))
        q = [axis[0] * math.sin(turn_rad / 2), axis[1] * math.sin(turn_rad / 2), 0, math.cos(turn_rad / 2)]
        body = [0.01 * math.sin(i), 0.01 * math.cos(3 * i), 0.05]
        centre = [a + b for a, b in zip(body, turned(q, [-0.0315 if eye == "left" else 0.0315, -0.04, 0.03]))]
        t = (-0.7 - centre[2]) / (mark[2] - centre[2])
        spot = [c + t * (m - c) for c, m in zip(centre, mark)]
        spot[0] += wrong_mm * 1e-3 if i == 7 else 0
        lines.append(",".join(["head " + str(i + 1), eye, *(f"{n:.9f}" for n in [*body, *q, *mark, *spot])]))
    path.write_text("\n".join(lines) + "\n")
    return path


def test_eyes_are_found_on_the_tracked_glasses():
    with folder() as at:
        command = ("calibrate", "viewer", "tracker-offset")
        found = succeed(*command, sightings(at / "good.csv"), "--json").json()
        # The pupils' midpoint stands 10.5 mm before the centres' one.
        for got, wanted in zip(found["body_from_thing"]["position_m"], (0, -0.04, 0.0195)):
            assert abs(got - wanted) < 1e-6, found
        assert abs(found["interpupillary_mm"] - 63) < 1e-3 and found["rms_mm"] < 1e-3, found
        words = succeed(*command, at / "good.csv").out
        assert "body_from_thing" in words and "uncertain by" in words, words
        expect(focalstage(*command, sightings(at / "wrong.csv", 40)), INVALID, "sightings.limit", "8 (head 8)", "mm")
        assert focalstage(*command, at / "wrong.csv", "--despite-residual").status == DONE
        expect(focalstage(*command, sightings(at / "still.csv", 0, 0.01)), INVALID, "sightings.parallel")
        expect(focalstage(*command, sightings(at / "left.csv", eyes=("left",))), INVALID, "sightings.few", "right")
        expect(focalstage(*command, at / "good.csv", "--body-rotation", 0, 0, 0, 0), INVALID, "--body-rotation")
        expect(focalstage(*command, at / "none.csv"), INVALID, "none.csv")
        (at / "torn.csv").write_text((at / "good.csv").read_text()[:-30] + "\n")
        expect(focalstage(*command, at / "torn.csv"), INVALID, "sightings.file", "line 13")


def test_what_is_not_good_enough_changes_nothing():
    with folder() as at, rig(at, "--virtual-time") as address:
        file = adopted(at, address)
        before = file.read_text()
        short = ("--to", address, "--questions", "6")
        expect(ask("lens-to-pupil", at / "room", *short, "--scripted", "18"), INVALID, "viewer.", "mm")
        expect(ask("lens-to-pupil", at / "room", *short, stdin="q"), INVALID, "viewer.given-up")
        expect(ask("lens-to-pupil", at / "room", *short, stdin="udu"), ENVIRONMENT, "trials.input-ended", "--answers")
        expect(ask("lens-to-pupil", at / "room", *short, stdin="u" * 6), INVALID, "viewer.outside")
        expect(ask("interpupillary", at / "room", *short, "--thread-m", "0.25", stdin="l" * 12), INVALID, "viewer.outside")
        expect(ask("lens-to-pupil", at / "room", "--to", f"127.0.0.1:{free_port()}", "--scripted", "18"), ENVIRONMENT, "rig.")
        expect(ask("lens-to-pupil", at / "room", "--eye", "third"), USAGE, "eye")
        assert file.read_text() == before
        write_project(at / "narrow", room(slices={"powers_d": [-0.2, 0, 0.2]}))
        expect(ask("lens-to-pupil", at / "narrow", "--to", address, "--scripted", "18"), INVALID, "viewer.slices")
        write_project(at / "void", room(surfaces=[]))
        for action in (("lens-to-pupil",), ("lens-power", "--focus-m", "0.5"), ("interpupillary", "--thread-m", "0.25")):
            expect(ask(*action, at / "void", "--to", address), INVALID, "viewer.surface")


if __name__ == "__main__":
    main([test_a_distance_from_lens_to_pupil_is_found, test_keys_say_what_a_simulated_eye_says,
          test_an_interpupillary_distance_is_found,
          test_a_lens_that_is_off_is_found, test_killed_and_gone_on,
          test_eyes_are_found_on_the_tracked_glasses, test_what_is_not_good_enough_changes_nothing])
