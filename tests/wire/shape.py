#!/usr/bin/python3
"""`focalstage shape`: samples on the simulated rig, what it saves, and what it refuses."""

import json
import math
import shutil

from harness import (DONE, FINDINGS, INVALID, PROJECTS, USAGE, expect, focalstage, folder, main, rig, succeed)


def copy_of(at, name):
    shutil.copytree(PROJECTS / name, at / name)
    return at / name


def edited(project, change):
    file = next(project.glob("*.focal"))
    data = json.loads(file.read_text())
    change(data)
    file.write_text(json.dumps(data))


def test_a_sample_is_shaped_for_the_rig_that_is_there():
    """adopt-rig, shape, compile, push, play: the rig delivers at most half the sine's smear."""
    with folder() as at, rig(at) as address:
        project = copy_of(at, "three-rabbits")
        succeed("adopt-rig", project, "--to", address)
        before = (project / "three-rabbits.focal").read_bytes()
        outcome = succeed("shape", project, "-o", at / "shaped", "--json").json()
        assert (project / "three-rabbits.focal").read_bytes() == before
        assert outcome["better"] and outcome["highest_harmonic"] == 24, outcome
        sine_d = outcome["worst_smear_d"]["sine"]
        assert 2 * outcome["worst_smear_d"]["shaped"] <= sine_d, outcome
        assert len(outcome["slots"]) == 6 and all(slot["sine"] and slot["shaped"] for slot in outcome["slots"]), outcome
        ran = focalstage("compile", at / "shaped", "-o", at / "shaped.h5")
        assert ran.status == DONE, ran
        succeed("push", at / "shaped.h5", "--to", address, "--activate")
        succeed("rig", "play", "--to", address)
        for _ in range(100):
            state = succeed("rig", "state", "--to", address, "--json").json()
            if state["slots"] and all(slot["exposures"] > 5 for slot in state["slots"]):
                break
        for slot in state["slots"]:
            assert slot["delivered"], slot
            assert 2 * slot["delivered_smear_d"] <= sine_d, slot
        again = succeed("shape", project, "-o", at / "again", "--json").json()
        assert (at / "again" / "again.focal").read_bytes() == (at / "shaped" / "shaped.focal").read_bytes()
        assert again["worst_smear_d"] == outcome["worst_smear_d"]


def test_limits_are_named_and_kept():
    with folder() as at:
        project = copy_of(at, "first-light")
        words = succeed("shape", project, "-o", at / "two").out
        assert "worst smear" in words and "measured up to harmonic 2 of 24" in words, words
        edited(project, lambda data: data["glasses"].update(lens_limits={"max_current_a": 0.01}))
        before = next(project.glob("*.focal")).read_bytes()
        ran = focalstage("shape", project, "--json")
        assert ran.status == FINDINGS, ran
        outcome = ran.json()
        assert not outcome["better"] and outcome["project"] is None, outcome
        current = [bound for bound in outcome["bounds"] if bound["limit"] == "current"]
        assert current and current[0]["needed"] > current[0]["allowed"] == 0.01, outcome
        assert next(project.glob("*.focal")).read_bytes() == before
        ran = focalstage("check", project, "--json")
        assert "optics.lens-current" in [finding["code"] for finding in ran.json()["findings"]], ran


def test_a_power_of_ones_own():
    with folder() as at:
        project = copy_of(at, "three-rabbits")
        wave = at / "wave.txt"
        wave.write_text("# dioptres\n" + "\n".join(f"{1.4 * math.sin(2 * math.pi * i / 200):.9f}" for i in range(200)))
        succeed("shape", project, "--power", wave, "-o", at / "own")
        stored = json.loads((at / "own" / "own.focal").read_text())["sweep"]["waveform"]
        assert min(stored["left"]["power_d"]) == stored["left"]["power_d"][0], stored["left"]["power_d"][:3]
        # 1.4 D / 37.063664 D/A, as the project says of the left lens at 60 Hz.
        assert abs(max(stored["left"]["drive_a"]) - 1.4 / 37.063664) < 1e-5, max(stored["left"]["drive_a"])
        for text, word in (("", "0 samples"), ("1\n", "1 samples"), ("1\n2\nx\n", "line 3"), ("1,2\n3\n", "line 2"),
                           ("nan\n" * 20, "not a finite"), ("0\n" * 20, "strictly monotonic"),
                           ("\n".join(str(i / 100) for i in range(100)), "not measured")):
            wave.write_text(text)
            expect(focalstage("shape", project, "--power", wave, "-o", at / "no"), INVALID, "wave.txt", word)
            assert not (at / "no").exists()


def test_wrong_words():
    with folder() as at:
        project = copy_of(at, "first-light")
        expect(focalstage("shape"), USAGE)
        expect(focalstage("shape", project, "--max-harmonic", "0"), USAGE)
        expect(focalstage("shape", project, "--max-harmonic", "4", "--power", "x"), USAGE)
        expect(focalstage("shape", at / "nothing"), INVALID)
        edited(project, lambda data: data["slices"].update(powers_d=[0.5, 0.5]))
        expect(focalstage("shape", project), INVALID, "0.5 D")
        edited(project, lambda data: data["slices"].update(powers_d=[k / 10 for k in range(-10, 11)]))
        expect(focalstage("shape", project), INVALID, "ms of each half")


if __name__ == "__main__":
    main([test_a_sample_is_shaped_for_the_rig_that_is_there, test_limits_are_named_and_kept, test_a_power_of_ones_own,
          test_wrong_words])
