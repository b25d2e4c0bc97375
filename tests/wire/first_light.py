#!/usr/bin/python3
"""From a sample to light on the simulated rig, through the command line alone."""

import csv
import pathlib
import struct
import time
import zlib

from harness import (DONE, ENVIRONMENT, FOCALSTAGE, PROJECTS, USAGE, expect, focalstage, folder, main, rig,
                     small_project, succeed, write_project)


def test_new_to_report():
    with folder() as at:
        succeed("new", at / "room", "--from", "three-rabbits")
        assert (at / "room/room.focal").exists()
        checked = focalstage("check", at / "room", "--json")
        assert checked.status == DONE, checked
        show = at / "room.h5"
        compiled = succeed("compile", at / "room", "-o", show, "--json").json()
        assert compiled["findings"] == checked.json()["findings"], "check and compile disagree"
        assert compiled["frames"] == 1 and compiled["images"] == 6 and compiled["slots"] == 6, compiled
        assert not (at / "room.h5.part").exists(), "the part is left behind"
        assert focalstage("check", show, "--json").json() == checked.json(), "the show and its project disagree"

        succeed("export", show, "-o", at / "export")
        names = sorted(p.name for p in (at / "export").iterdir())
        assert sum(n.endswith(".png") for n in names) == 6, names
        for name in ("schedule.csv", "timing.vcd", "waveform.csv"):
            assert name in names, names
        with open(at / "export/schedule.csv") as file:
            assert len(list(csv.DictReader(file))) == 6

        with rig(at) as address:
            succeed("push", show, "--to", address, "--activate")
            succeed("rig", "play", "--to", address)
            time.sleep(1.0)
            state = succeed("rig", "state", "--to", address, "--json").json()
            assert state["state"] == "playing", state
            assert len(state["slots"]) == 6, state
            for slot in state["slots"]:
                assert abs(slot["asked_power_d"] - slot["delivered_power_d"]) <= 0.02, slot
                assert abs(slot["asked_s"] - slot["delivered_s"]) <= 20e-6, slot
                assert slot["right_image"] and slot["own_shutter_open"] and slot["other_shutter_closed"], slot
                assert slot["delivered"], slot
            assert succeed("rig", "hold", "--to", address, "--json").json()["state"] == "holding"
            assert succeed("rig", "blackout", "--to", address, "--json").json()["state"] == "dark"
            text = succeed("rig", "state", "--to", address).out
            assert text.startswith("dark"), text


def png16(path):
    """Rows of a 16-bit gray PNG without filters but the one that ours has."""
    data, at, packed = path.read_bytes(), 8, b""
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at:at + 8])
        body = data[at + 8:at + 8 + length]
        if kind == b"IHDR":
            width, height, bits, colour = struct.unpack(">IIBB", body[:10])
            assert (bits, colour) == (16, 0), (bits, colour)
        if kind == b"IDAT":
            packed += body
        at += 12 + length
    raw, rows = zlib.decompress(packed), []
    for y in range(height):
        line = bytearray(raw[y * (2 * width + 1):(y + 1) * (2 * width + 1)])
        assert line[0] == 1, "the sub filter"
        for i in range(3, len(line)):
            line[i] = (line[i] + line[i - 2]) & 255
        rows.append(struct.unpack(f">{width}H", bytes(line[1:])))
    return rows


def contrast(rows, left, right, top, bottom):
    """Squares of the differences between neighbours: what a blur takes away."""
    return sum((rows[y][x + 1] - rows[y][x]) ** 2 for y in range(top, bottom) for x in range(left, right))


def test_what_an_eye_sees():
    """Each of the three rabbits is sharpest where it is meant to be, and the light stays."""
    with folder() as at:
        succeed("compile", PROJECTS / "three-rabbits", "-o", at / "rabbits.h5")
        seen, light, told_sharp = {}, [], {}
        for focus in ("0.333", "0.5", "1"):
            told = succeed("retina", at / "rabbits.h5", "--eye", "left", "--focus-m", focus, "--pupil-mm", "6", "--size",
                           "320x240", "-o", at / "eye.png", "--json").json()
            assert told["size_px"] == [320, 240] and told["exposures"] == 3, told
            assert abs(told["focus_d"] - 1 / float(focus)) < 1e-9, told
            light.append(told["mean_light"])
            seen[focus] = png16(at / "eye.png")
            told_sharp[focus] = {thing["name"]: thing["sharpness"] for thing in told["things"]}
            assert told["leaked"] == 0, told
        assert max(light) < min(light) * 1.002, light
        for name, focus in (("near", "0.333"), ("middle", "0.5"), ("far", "1"), ("near-block", "0.333"), ("far-block", "1")):
            assert max(told_sharp, key=lambda at_focus: told_sharp[at_focus][name]) == focus, (name, told_sharp)
        slow = succeed("retina", at / "rabbits.h5", "--eye", "left", "--focus-m", "0.5", "--shutter-close-ms", "6", "--conflict",
                       at / "conflict.png", "--rays", "2", "--size", "160x120", "-o", at / "slow.png", "--json").json()
        assert 0.01 < slow["leaked"] < 0.5, slow
        near = next(thing for thing in slow["things"] if thing["name"] == "near")
        assert near["kind"] == "object" and abs(near["conflict_mean_d"]) < 0.3, near
        # The rabbits stand below each other: the one at 0.333 m lowest, the one at 1 m highest.
        for focus, rows in (("1", (30, 86)), ("0.5", (89, 151)), ("0.333", (154, 220))):
            sharp = {other: contrast(picture, 165, 240, *rows) for other, picture in seen.items()}
            assert max(sharp, key=sharp.get) == focus, (focus, sharp)
        text = succeed("retina", at / "rabbits.h5", "--eye", "right", "--focus-m", "0.5", "-o", at / "right.png").out
        assert "right eye" in text and "3 exposures" in text, text
        expect(focalstage("retina", at / "rabbits.h5", "--eye", "left", "--focus-m", "1", "--frame", "1", "-o", at / "x.png"),
               USAGE, "frame")
        expect(focalstage("retina", at / "rabbits.h5", "--eye", "left", "--focus-m", "1", "-o", at / "no/such/x.png"),
               ENVIRONMENT, "x.png")


def test_every_sample_is_taken_by_the_rig():
    """No sample is refused with rig.differs but the one for more projectors than the rig has; what plays is all delivered."""
    with folder() as at, rig(at) as address:
        names = sorted(p.name for p in (pathlib.Path(__file__).parents[2] / "projects").iterdir() if p.is_dir())
        assert len(names) == 11, names
        taken = 0
        for name in names:
            succeed("new", at / name, "--from", name)
            succeed("compile", at / name, "-o", at / f"{name}.h5", "--frames", "0:1")
            if name == "two-projectors":
                refused = focalstage("push", at / f"{name}.h5", "--to", address, "--activate")
                assert refused.status == 4 and "rig.differs" in refused.err and '"right" would stay dark' in refused.err, refused
                continue
            taken += 1
            succeed("push", at / f"{name}.h5", "--to", address, "--activate")
            succeed("rig", "play", "--to", address)
            time.sleep(0.5)
            state = succeed("rig", "state", "--to", address, "--json").json()
            late = [s for s in state["slots"] if not s["delivered"]]
            assert state["slots"] and not late, f"{name}: {late or state}"
        assert taken == 10, taken
        return f"{taken} samples taken, one of two projectors refused"


def test_adopted_rig_is_taken():
    with folder() as at, rig(at) as address:
        write_project(at / "small", small_project(frames=2))
        succeed("compile", at / "small", "-o", at / "before.h5")
        refused = focalstage("push", at / "before.h5", "--to", address, "--activate")
        assert refused.status == 4 and "rig.differs" in refused.err, refused
        succeed("adopt-rig", at / "small", "--to", address)
        succeed("compile", at / "small", "-o", at / "after.h5")
        succeed("push", at / "after.h5", "--to", address, "--activate")
        again = succeed("adopt-rig", at / "small", "--to", address, "--dry-run")
        assert again.out == "", f"adopting twice changes something: {again}"


def test_help_of_every_command():
    text = succeed("--help").out
    commands = [line.split()[0] for line in text.split("Commands:\n")[1].split("\n\n")[0].splitlines()]
    assert len(commands) == 21, commands
    for name in commands:
        if name not in ("runtime", "edit", "bench"):
            assert "Usage: focalstage " + name in succeed(name, "--help").out
    expect(focalstage(), USAGE, "Commands:", line=False)
    assert pathlib.Path(FOCALSTAGE).exists()


if __name__ == "__main__":
    main([test_new_to_report, test_what_an_eye_sees, test_every_sample_is_taken_by_the_rig, test_adopted_rig_is_taken,
          test_help_of_every_command])
