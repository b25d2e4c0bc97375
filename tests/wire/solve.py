#!/usr/bin/python3
"""Solving from the command line: proposals that check without an error, reasons where there are none."""

import json
import signal
import subprocess
import time

from harness import (DONE, FINDINGS, FOCALSTAGE, INVALID, PROJECTS, USAGE, expect, focalstage, folder, main,
                     small_project, succeed, write_project)


def errors(findings):
    return [f for f in findings if f["severity"] == "error"]


def deep_project(**changes):
    """The small project with a box that wants powers beyond its slices."""
    project = small_project(frames=3, **changes)
    project["objects"][0]["depth"] = {"mode": "offset", "vergence_d": -1.2}
    return project


def test_samples():
    told = []
    for sample in sorted(p for p in PROJECTS.iterdir() if p.is_dir()):
        ran = succeed("solve", sample, "--json")
        report = ran.json()
        assert ran.out.count("\n") == 1 and report["solved"] and not errors(report["findings"]), ran
        rig, error = report["rig"], report["error"]
        assert rig["powers_d"] == sorted(set(rig["powers_d"])), rig
        assert rig["min_power_d"] < rig["powers_d"][0] and rig["powers_d"][-1] < rig["max_power_d"], rig
        assert rig["widest_gap_d"] <= 0.6 + 1e-9 and rig["worst_smear_d"] <= 0.3 and rig["beyond_d"] <= 0.3, rig
        assert error["k_median"]["mean_d"] <= error["uniform"]["mean_d"] + 1e-9, error
        told.append(f"{sample.name} {len(rig['powers_d'])}")
    return ", ".join(told)


def test_written_and_checked():
    with folder() as at:
        project = write_project(at / "deep", deep_project())
        before = project.read_bytes()
        assert errors(focalstage("check", project, "--json").json()["findings"]), "nothing to solve here"
        report = succeed("solve", project, "-o", at / "solved", "--json").json()
        assert project.read_bytes() == before, "-o changed the project itself"
        checked = focalstage("check", at / "solved", "--json")
        assert checked.status == DONE and not errors(checked.json()["findings"]), checked
        assert checked.json()["findings"] == report["findings"], "the proposal and its check disagree"
        written = json.loads((at / "solved/solved.focal").read_text())
        assert written["slices"]["powers_d"] == report["rig"]["powers_d"], written
        # The edits alone make the same project.
        (at / "edits.jsonl").write_text("".join(json.dumps(e) + "\n" for e in report["edits"]))
        succeed("apply", project, at / "edits.jsonl", "-o", at / "applied")
        applied = json.loads((at / "applied/applied.focal").read_text())
        assert applied["slices"] == written["slices"] and applied["sweep"] == written["sweep"], (applied, written)
        text = succeed("solve", project).out
        assert "slices instead of 3" in text and "mean error" in text, text
        assert succeed("solve", at / "solved").out.count("nothing is to be changed") == 1


def test_wishes():
    with folder() as at:
        project = write_project(at / "deep", deep_project())
        for count in (2, 3, 4):
            assert len(succeed("solve", project, "--slices", count, "--json").json()["rig"]["powers_d"]) == count
        near = succeed("solve", project, "--max-error", 0.2, "--json").json()
        assert near["error"]["after"]["worst_d"] <= 0.2 + 1e-9, near
        dense = succeed("solve", project, "--spacing", 0.3, "--json").json()
        assert dense["rig"]["widest_gap_d"] <= 0.3 + 1e-9, dense
        expect(focalstage("solve", project, "--slices", "0"), USAGE, "slices")
        expect(focalstage("solve", project, "--slices", "65"), USAGE, "slices")
        expect(focalstage("solve", project, "--spacing", "-1"), USAGE, "spacing")
        expect(focalstage("solve", project, "--max-error", "nan"), USAGE, "max-error")
        expect(focalstage("solve"), USAGE, "PROJECT")
        expect(focalstage("solve", at / "none"), INVALID, "none")


def refused(at, project, code, *words):
    file = write_project(at, project)
    ran = focalstage("solve", file, "--json", "-o", at.parent / "never")
    assert ran.status == FINDINGS, ran
    report = ran.json()
    assert not report["solved"] and report["edits"] == [] and report["rig"] is None, ran
    assert not (at.parent / "never").exists(), "written without a proposal"
    findings = [f for f in report["findings"] if f["code"] == code]
    assert findings, ran
    for word in words:
        assert any(word in f["message"] for f in findings), (word, ran)
    return report


def test_no_solution():
    with folder() as at:
        weak = refused(at / "weak", deep_project(glasses={"lens_range_d": [-1.0, 1.2]}), "optics.lens-range", "1.2 D")
        assert any("of the picture" in n["words"] for n in weak["nearest"]), weak

        slow = deep_project()
        slow["projectors"][0]["frames_per_second"] = 400
        report = refused(at / "slow", slow, "schedule.smear", "possible")
        for finding in report["findings"]:
            (at / "remedy.jsonl").write_text("".join(json.dumps(e) + "\n" for e in finding["remedy"]))
            succeed("apply", at / "slow", at / "remedy.jsonl", "-o", at / "fast")
            assert not errors(focalstage("check", at / "fast", "--json").json()["findings"]), finding

        refused(at / "shut", deep_project(glasses={"shutter_open_ms": 8.3}), "schedule.hidden-by-shutter", "half period")
        refused(at / "empty", small_project(objects=[]), "solve.nothing")
        refused(at / "bare", small_project(surfaces=[]), "solve.unserved")
        refused(at / "past", small_project(viewer={"position_m": [0, 0, -9]}), "solve.nothing")
        refused(at / "rate", small_project(frames=1) | {"frames": {"count": 1, "rate_hz": 35}}, "frames.rate")


def test_interrupted():
    """Ctrl-C ends it at once, with nothing written."""
    with folder() as at:
        project = json.loads((PROJECTS / "moving-plane/moving-plane.focal").read_text())
        project["frames"] = {"count": 3000, "rate_hz": 15}
        write_project(at / "long", project)
        process = subprocess.Popen([FOCALSTAGE, "solve", str(at / "long"), "-o", str(at / "out")],
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        time.sleep(1.0)
        process.send_signal(signal.SIGINT)
        asked = time.monotonic()
        process.wait(10)
        waited = time.monotonic() - asked
        assert process.returncode == -signal.SIGINT, process.returncode
        assert waited < 1.0, waited  # 0.2 s on a machine of its own
        assert not (at / "out").exists()
    return f"{waited * 1000:.0f} ms"


if __name__ == "__main__":
    main([test_samples, test_written_and_checked, test_wishes, test_no_solution, test_interrupted])
