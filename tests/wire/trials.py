#!/usr/bin/python3
"""focalstage trials as a lab meets it: a whole study against a simulated rig, kills, rigs that fail, bad files, and the
report's figures against NumPy's."""

import csv
import json
import math
import os
import pathlib
import pty
import random
import select
import signal
import subprocess
import termios
import time
import xml.etree.ElementTree

import numpy

from harness import (DONE, ENVIRONMENT, FOCALSTAGE, INVALID, RUNTIME, USAGE, expect, focalstage, folder, free_port, main,
                     rig, succeed)

KILLS = 12
IDS = [f"P{k:02}" for k in range(1, 11)]


def new_study(at, **changes):
    succeed("trials", "new", at / "study")
    file = at / "study" / "study.json"
    study = json.loads(file.read_text())
    study.update(changes)
    file.write_text(json.dumps(study))
    return at / "study"


def run(study, participant, address, *options, **more):
    return focalstage("trials", "run", study, "--participant", participant, "--to", address, *options, **more)


def rows(study, participant, out="answers"):
    with open(study / out / f"{participant}.csv", newline="") as file:
        return list(csv.DictReader(file))


def answers(study, participant, out="answers"):
    """What whole rows say that count: a kill may cut the last one off, and a trial that a rig in trouble spoils (one
    that a busy machine kept waiting too long is) comes again."""
    text = (study / out / f"{participant}.csv").read_text()
    whole = text[: text.rfind("\n") + 1]
    return [said(row) for row in csv.DictReader(whole.splitlines()) if not row["spoiled"]]


def first_difference(found, wanted):
    return next((f"row {k}: {a} in place of {b}" for k, (a, b) in enumerate(zip(found, wanted)) if a != b),
                f"{len(found)} rows of {len(wanted)}")


def said(row):
    """What a row says whenever it was written."""
    return {key: value for key, value in row.items() if key not in ("sitting", "started_s", "duration_s")}


def plan(study, participant):
    blocks = succeed("trials", "plan", study, "--participant", participant, "--json").json()["blocks"]
    return [(block["condition"], trial["target"], trial["training"]) for block in blocks for trial in block["trials"]]


# Statistics, derived once more ----------------------------------------------------------------------------------------

def upper_tail(f, df1, df2, steps=200_000):
    """The tail of F by Simpson's rule over the beta density: B(df2/2, df1/2) below x = df2 / (df2 + df1 f). With
    x = s**2 the density stays finite where df2 is 1."""
    a, b = df2 / 2, df1 / 2
    x = df2 / (df2 + df1 * f)
    log_beta = math.lgamma(a) + math.lgamma(b) - math.lgamma(a + b)
    s = numpy.linspace(0, math.sqrt(x), steps + 1)
    with numpy.errstate(divide="ignore"):
        density = 2 * numpy.exp((2 * a - 1) * numpy.log(s) + (b - 1) * numpy.log1p(-s * s) - log_beta)
    weights = numpy.ones(steps + 1)
    weights[1:-1:2], weights[2:-1:2] = 4, 2
    return float((density * weights).sum() * math.sqrt(x) / steps / 3)


def residual(columns, y):
    x = numpy.column_stack(columns)
    fitted = x @ numpy.linalg.lstsq(x, y, rcond=None)[0]
    return float(((y - fitted) ** 2).sum()), len(y) - numpy.linalg.matrix_rank(x)


def f_test(reduced, full, error):
    df1 = reduced[1] - full[1]
    f = (reduced[0] - full[0]) / df1 / (error[0] / error[1])
    return {"f": f, "df1": df1, "df2": error[1], "p": upper_tail(f, df1, error[1])}


def means_of(study, ids):
    """(condition, target, actual, mean response) of every participant, condition and target with an answer."""
    conditions = [c["name"] for c in study["conditions"]]
    targets = [t["name"] for t in study["targets"]]
    return conditions, targets, [
        (c, t, study["targets"][t]["actual_m"], numpy.mean(answers))
        for participant in ids for c in range(len(conditions)) for t in range(len(targets))
        if (answers := [float(r["response_m"]) for r in participant
                        if r["condition"] == conditions[c] and r["target"] == targets[t] and r["training"] == "0"
                        and not r["spoiled"] and r["gave_up"] == "0"])]


def derived(means, conditions, targets):
    """The paper's tests from the means, by NumPy."""
    c = numpy.array([m[0] for m in means])
    t = numpy.array([m[1] for m in means])
    x = numpy.array([m[2] for m in means])
    y = numpy.array([m[3] for m in means])
    one = numpy.ones(len(means))
    is_c = [(c == k).astype(float) for k in range(conditions)]
    is_t = [(t == k).astype(float) for k in range(targets)]
    apart = residual(is_c + [i * x for i in is_c], y)
    parallel = residual(is_c + [x], y)
    together = residual([one, x], y)
    error = y - x
    cells = residual([i * j for i in is_c for j in is_t], error)
    both = residual([one] + is_c[1:] + is_t[1:], error)
    return {"slopes": f_test(parallel, apart, apart), "intercepts": f_test(together, parallel, parallel),
            "condition": f_test(residual(is_t, error), both, cells),
            "distance": f_test(residual(is_c, error), both, cells), "interaction": f_test(both, cells, cells)}


def agree(found, wanted, name):
    for key in ("f", "df1", "df2", "p"):
        # Simpson's rule is good to about 1e-7 of the largest p.
        limit = 1e-6 * abs(wanted[key]) + (1e-7 if key == "p" else 0)
        assert abs(found[key] - wanted[key]) <= limit, f"{name}: {key} is {found[key]}, derived {wanted[key]}"


def check_report(study, report, participants):
    definition = json.loads((study / "study.json").read_text())
    conditions, targets, means = means_of(definition, participants)
    wanted = derived(means, len(conditions), len(targets))
    agree(report["regression"]["slopes_differ"], wanted["slopes"], "slopes")
    agree(report["regression"]["intercepts_differ"], wanted["intercepts"], "intercepts")
    for source in ("condition", "distance", "interaction"):
        agree(report["anova"][source], wanted[source], source)
    for k, condition in enumerate(conditions):
        slope, intercept = numpy.polyfit([m[2] for m in means if m[0] == k], [m[3] for m in means if m[0] == k], 1)
        line = report["regression"]["lines"][k]
        assert line["condition"] == condition
        assert abs(line["slope"] - slope) < 1e-9 and abs(line["intercept_m"] - intercept) < 1e-9, line
    return wanted


# Whole studies --------------------------------------------------------------------------------------------------------

def test_ten_scripted_participants():
    """The paper's whole study, 420 trials over the wire: its degrees of freedom, and figures that NumPy derives too."""
    with folder() as at, rig(at, "--virtual-time") as address:
        study = new_study(at)
        for participant in IDS:
            ran = run(study, participant, address, "--scripted", "biased")
            assert ran.status == DONE and "42 of 42" in ran.out, ran
        all_rows = [rows(study, participant) for participant in IDS]
        for participant, found in zip(IDS, all_rows):
            assert len(found) == 42, len(found)
            assert [(r["condition"], r["target"], r["training"] == "1") for r in found] == plan(study, participant)
            assert {r["kind"] for r in found} == {"scripted:biased"} and {r["rig"] for r in found} == {"sim"}
        report = succeed("trials", "report", study, "-o", at / "report.md", "--json").json()
        wanted = check_report(study, report, all_rows)
        dfs = {name: (test["df1"], test["df2"]) for name, test in wanted.items()}
        assert dfs == {"slopes": (1, 96), "intercepts": (1, 97), "condition": (1, 90), "distance": (4, 90),
                       "interaction": (4, 90)}, dfs
        pair = report["anova"]["pairs"][0]
        assert pair["method"] == "tukey" and abs(pair["t"] ** 2 - wanted["condition"]["f"]) < 1e-6 * wanted["condition"]["f"]
        assert report["human"] is False and "no human result" in report["warning"]
        assert len(report["questions"]) == 10 and not any(q["yes"] for q in report["questions"])
        text = (at / "report.md").read_text()
        assert text.index("no human result") < text.index("## Participants") and "](report.svg)" in text, text
        svg = xml.etree.ElementTree.fromstring((at / "report.svg").read_text())
        name = "{http://www.w3.org/2000/svg}"
        dots = [c for c in svg.iter(name + "circle") if c.get("fill-opacity")]
        fits = [l for l in svg.iter(name + "line") if l.get("class") == "fit"]
        assert len(dots) == 400 and len(fits) == 2, (len(dots), len(fits))
        assert any("no human result" in (t.text or "") for t in svg.iter(name + "text"))
        assert succeed("rig", "state", "--to", address, "--json").json()["state"] == "ready"  # dark, not latched
    return f"F(1,97) = {wanted['intercepts']['f']:.1f} of the intercepts"


def test_given_up():
    """Who gives up lacks answers, in one cell all of them: the report names it, and NumPy agrees on what is left."""
    with folder() as at, rig(at, "--virtual-time") as address:
        study = new_study(at, repetitions=1, training_trials=0, participants=IDS[:6])
        for participant, name in zip(IDS[:6], ["gives-up", "noisy"] * 3):
            assert run(study, participant, address, "--scripted", name).status == DONE
        # One trial per cell: "every seventh" never comes in blocks of five; one is taken back by hand, as q would.
        file = study / "answers" / "P02.csv"
        lines = file.read_text().splitlines()
        cells = lines[3].split(",")
        cells[11], cells[12] = "", "1"
        lines[3] = ",".join(cells)
        file.write_text("\n".join(lines) + "\n")
        report = succeed("trials", "report", study, "--json").json()
        empty = report["left_out"]["empty_means"]
        assert [(e["participant"], e["condition"], e["target"]) for e in empty] == [("P02", cells[4], cells[7])], empty
        check_report(study, report, [rows(study, participant) for participant in IDS[:6]])
        text = succeed("trials", "report", study).out
        assert "All repetitions were given up by P02" in text and "type II" in text and "answered-repetitions" in text


def test_killed_and_resumed():
    """Killed at random moments again and again, a participant's answers are those of one who never was."""
    seed = random.SystemRandom().randrange(1 << 32)
    dice = random.Random(seed)
    kills = 0
    with folder() as at:
        study = new_study(at, repetitions=20)
        file = study / "answers" / "P01.csv"
        with rig(at, "--virtual-time") as address:
            assert run(study, "P01", address, "--scripted", "noisy", "--out", study / "whole").status == DONE
        whole = answers(study, "P01", "whole")
        known = []
        for attempt in range(KILLS):
            store = at / str(attempt)
            store.mkdir()
            with rig(store, "--virtual-time") as address:  # a rig of its own: no lease of the one before to wait for
                process = subprocess.Popen([FOCALSTAGE, "trials", "run", str(study), "--participant", "P01", "--to",
                                            address, "--scripted", "noisy", "--resume"], stdout=subprocess.DEVNULL)
                before = file.stat().st_size if file.exists() else 0
                while process.poll() is None and (not file.exists() or file.stat().st_size <= before):
                    time.sleep(0.001)
                try:
                    process.wait(dice.uniform(0.0, 0.05))
                except subprocess.TimeoutExpired:
                    process.send_signal(signal.SIGKILL)
                    process.wait()
                    kills += 1
            found = answers(study, "P01")
            assert found == whole[: len(found)], (
                f"seed {seed}: other answers after kill {kills}: {first_difference(found, whole)}")
            assert len(found) >= len(known), f"seed {seed}: answers were lost"
            known = found
        with rig(at, "--virtual-time") as address:
            ran = run(study, "P01", address, "--scripted", "noisy", "--resume")
        assert ran.status == DONE, f"seed {seed}: {ran}"
        found = answers(study, "P01")
        assert found == whole, f"seed {seed}: {first_difference(found, whole)}"
        assert len(rows_of_answers(study, "P01")) == 1, f"seed {seed}"
        sittings = [int(row["sitting"]) for row in rows(study, "P01")]
        assert sittings == sorted(sittings) and (kills == 0 or max(sittings) > 1), f"seed {seed}: {sittings}"
    return f"seed {seed}, {kills} kills in {max(sittings)} sittings, {len(known)} of {len(whole)} trials before the last"


def rows_of_answers(study, participant):
    with open(study / "answers" / f"{participant}.answers.csv", newline="") as file:
        return list(csv.DictReader(file))


def test_torn_row():
    """A row cut off by a power cut is no answer: its trial comes again, and the report says so."""
    with folder() as at, rig(at, "--virtual-time") as address:
        study = new_study(at)
        assert run(study, "P01", address, "--scripted", "noisy").status == DONE
        file = study / "answers" / "P01.csv"
        whole = [said(row) for row in rows(study, "P01")]
        text = file.read_text()
        file.write_text(text[: text.rindex("\n", 0, -1) + 40])
        assert "its last line was cut off" in succeed("trials", "report", study).out
        ran = run(study, "P01", address, "--scripted", "noisy", "--resume")
        assert ran.status == DONE and "a row was being written" in ran.err, ran
        assert [said(row) for row in rows(study, "P01")] == whole


# People ---------------------------------------------------------------------------------------------------------------

class Person:
    """Somebody who answers line by line."""

    def __init__(self, study, participant, address, *options):
        self.process = subprocess.Popen(
            [FOCALSTAGE, "trials", "run", str(study), "--participant", participant, "--to", address, *options],
            stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.heard = ""

    def hears(self, words, limit_s=30):
        """The next line, which must hold `words`."""
        deadline = time.monotonic() + limit_s
        while "\n" not in self.heard:
            ready, _, _ = select.select([self.process.stdout], [], [], max(0.0, deadline - time.monotonic()))
            piece = os.read(self.process.stdout.fileno(), 4096).decode() if ready else ""
            assert piece, f"wanted '{words}', heard {self.heard!r} and no more, {self.process.poll()}"
            self.heard += piece
        line, self.heard = self.heard.split("\n", 1)
        assert words in line, f"wanted '{words}', heard {line!r}, {self.process.poll()}"
        return line

    def says(self, words):
        self.process.stdin.write(words + "\n")
        self.process.stdin.flush()

    def end(self):
        out, err = self.process.communicate(timeout=60)
        return self.process.returncode, out, err


def small_study(at, **changes):
    return new_study(at, **{"repetitions": 1, "training_trials": 0, **changes})


def state(address):
    return succeed("rig", "state", "--to", address, "--json").json()


def test_light_of_a_trial():
    """In real time: what a person sees is the planned target, every exposure delivered, and dark before and after."""
    with folder() as at, rig(at) as address:
        study = small_study(at)
        shown = plan(study, "P01")
        frames = {"333 mm": 0, "364 mm": 1, "400 mm": 2, "444 mm": 3, "500 mm": 4}
        person = Person(study, "P01", address, "--interpupillary-mm", "61.5")
        person.hears("Block 1 of 2")
        for condition, target, _ in shown[:2]:
            person.hears("Trial")
            time.sleep(0.5)
            now = state(address)
            assert now["state"] == "holding" and now["frame"] == frames[target], now
            assert now["slots"] and all(slot["delivered"] for slot in now["slots"]), now
            person.says("410")
        person.hears("Trial")
        person.says("q")
        status, out, err = person.end()
        assert status == DONE and "2 of 10 trials" in out and "--resume" in out, (out, err)
        assert state(address)["state"] == "ready", state(address)
        found = rows(study, "P01")
        assert [r["spoiled"] for r in found] == ["", "", "paused"], found
        assert float(found[0]["response_m"]) == 0.41 and found[0]["kind"] == "human"
        assert float(found[0]["duration_s"]) > 0.5 and float(found[1]["started_s"]) > float(found[0]["duration_s"])
        assert {r["interpupillary_mm"] for r in found} == {"61.5"}
        expect(run(study, "P01", address, "--resume", "--interpupillary-mm", "63"), INVALID, "61.5 mm")
        lines = "\n".join(["300", "g", "abc", "99999", "450"] + ["400"] * 5 + ["n"]) + "\n"
        ran = run(study, "P01", address, "--resume", stdin=lines)
        assert ran.status == DONE and "10 of 10" in ran.out, ran
        assert "is no distance" in ran.out and "from 200 to 800 mm only" in ran.out, ran
        for _, target, _ in shown:
            assert target not in ran.out and "multifocal" not in ran.out and "conventional" not in ran.out, ran
        found = [r for r in rows(study, "P01") if not r["spoiled"]]
        assert [r["gave_up"] for r in found] == ["0", "0", "0", "1"] + ["0"] * 6, found
        assert found[3]["response_m"] == "" and {r["interpupillary_mm"] for r in found} == {"61.5"}
        report = succeed("trials", "report", study, "--json").json()
        assert report["human"] is True and "warning" not in report


def test_blackout_in_a_trial():
    """Whoever presses blackout has darkness that nothing but a person's word ends; the trial is repeated."""
    with folder() as at, rig(at, "--virtual-time") as address:
        study = small_study(at)
        person = Person(study, "P01", address)
        person.hears("Block 1 of 2")
        person.hears("Trial 1 of 5")
        succeed("rig", "blackout", "--to", address)
        person.hears("blacked out")
        time.sleep(0.6)
        assert state(address)["state"] == "dark"
        person.says("")
        person.hears("Trial 1 of 5")
        assert state(address)["state"] == "holding"
        person.says("410")
        person.hears("Trial 2 of 5")
        person.says("q")
        status, out, err = person.end()
        assert status == DONE, (out, err)
        found = rows(study, "P01")
        assert [(r["trial"], r["spoiled"]) for r in found] == [("1", "rig.dark"), ("1", ""), ("2", "paused")], found
        assert said(found[0])["target"] == said(found[1])["target"] and found[0]["response_m"] == ""


def test_scripts_lift_no_darkness():
    """A dark rig stays dark for a scripted participant, who gives up in the end; what is answered stays."""
    with folder() as at, rig(at, "--virtual-time") as address:
        study = small_study(at)
        succeed("rig", "blackout", "--to", address)
        expect(run(study, "P01", address, "--scripted", "exact"), ENVIRONMENT, "blacked out")
        assert state(address)["state"] == "dark"
        succeed("rig", "go", "--to", address)
        ran = run(study, "P01", address, "--scripted", "exact", "--resume")
        assert ran.status == DONE and "10 of 10" in ran.out, ran
        report = succeed("trials", "report", study, "--json").json()
        assert report["anova"] is None and report["regression"]["slopes_differ"] is None, report["regression"]
        assert abs(report["regression"]["lines"][0]["slope"] - 1) < 1e-12


def test_lost_rig():
    """The rig dies in the middle of a trial and comes back: said in plain words, and the trial is repeated."""
    with folder() as at:
        study = small_study(at)
        address = f"127.0.0.1:{free_port()}"
        command = [RUNTIME, "--rig", "sim", "--virtual-time", "--listen", address, "--store", str(at / "rig")]
        first = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
        first.stdout.readline()
        person = Person(study, "P01", address)
        person.hears("Block 1 of 2")
        person.hears("Trial 1 of 5")
        first.kill()
        first.wait()
        person.hears("will be repeated")
        person.says("")
        person.hears("rig.unreachable")
        second = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
        try:
            second.stdout.readline()
            person.says("")
            person.hears("Trial 1 of 5")
            person.says("500")
            person.hears("Trial 2 of 5")
            person.says("q")
            assert person.end()[0] == DONE
        finally:
            second.kill()
            second.wait()
        assert [r["spoiled"] for r in rows(study, "P01")] == ["rig.unreachable", "", "paused"]


def test_keys_on_a_terminal():
    """Arrows, page keys, digits, g and q, as a hand presses them; the terminal is left as it was."""
    with folder() as at, rig(at, "--virtual-time") as address:
        study = small_study(at, pointer={"from_m": 0.3, "to_m": 0.301, "step_m": 0.001}, targets=[
            {"name": "a", "cue": "333 mm", "actual_m": 0.3}, {"name": "b", "cue": "500 mm", "actual_m": 0.301}])
        leader, follower = pty.openpty()
        modes = termios.tcgetattr(follower)
        process = subprocess.Popen([FOCALSTAGE, "trials", "run", str(study), "--participant", "P01", "--to", address],
                                   stdin=follower, stdout=follower, stderr=follower)
        heard = b""

        def hears(words):
            nonlocal heard
            deadline = time.monotonic() + 30
            while words not in heard:
                assert time.monotonic() < deadline, f"wanted {words!r}, heard {heard!r}"
                if select.select([leader], [], [], 0.2)[0]:
                    heard += os.read(leader, 4096)
            heard = heard[heard.index(words) + len(words):]

        hears(b"Enter when it stands there")
        os.write(leader, b"\n")
        hears(b"Trial 1 of 2: ")
        os.write(leader, b"\n")
        hears(b"The pointer stands where it was put")
        os.write(leader, b"\x1b[B\x1b[6~\x1b[A\x1b[B\n")  # to the nearer end, wherever it began
        hears(b"Trial 2 of 2")
        os.write(leader, b"\n")
        hears(b"Trial 2 of 2: ")
        os.write(leader, b"9\x7f300.5\n")
        hears(b"Block 2 of 2")
        hears(b"Enter when it stands there")
        os.write(leader, b"\n")
        hears(b"Trial 1 of 2: ")
        os.write(leader, b"g")
        hears(b"Trial 2 of 2")
        os.write(leader, b"q")
        hears(b"3 of 4 trials")
        assert process.wait(30) == DONE
        assert termios.tcgetattr(follower) == modes
        os.close(follower)
        os.close(leader)
        found = rows(study, "P01")
        assert [(r["response_m"], r["gave_up"]) for r in found] == [("0.3", "0"), ("0.3005", "0"), ("", "1")], found


# Bad input ------------------------------------------------------------------------------------------------------------

def test_bad_studies():
    with folder() as at:
        study = new_study(at)
        file = study / "study.json"
        good = json.loads(file.read_text())
        nobody = "127.0.0.1:1"

        def refused(words, **changes):
            bad = {**good, **changes}
            file.write_text(json.dumps({key: value for key, value in bad.items() if value is not None}))
            expect(run(study, "P01", nobody, "--scripted", "exact"), INVALID, "study.json", *words)

        refused(["repetitions"], repetitions=None)
        refused(["/repetitions"], repetitions=0)
        refused(["/repetitions"], repetitions=2.5)
        refused(["repetition"], repetition=4)
        refused(["/conditions"], conditions=good["conditions"][:1])
        refused(["/conditions/1"], conditions=[good["conditions"][0]] * 2)
        refused(["/conditions/0"], conditions=[{"name": "x"}, good["conditions"][1]])
        refused(["/conditions/0/variant"], conditions=[{**good["conditions"][0], "variant": "bifocal"}, good["conditions"][1]])
        refused(["/targets/0/actual_m", "metres"], targets=[{**good["targets"][0], "actual_m": 333}] + good["targets"][1:])
        refused(["/targets/0"], targets=[{"name": "x", "actual_m": 0.3}] + good["targets"][1:])
        refused(["/participants/0"], participants=["../../P01"])
        refused(["/participants"], participants=[])
        refused(["/pointer"], pointer={"from_m": 0.8, "to_m": 0.2})
        refused(["/seed"], seed=-1)
        refused(["focalstage_study"], focalstage_study=2)
        refused(["/missing"], missing="ignore")
        file.write_text(json.dumps(good).replace("0.364", "NaN"))
        expect(run(study, "P01", nobody), INVALID, "study.json", "line 1")
        file.write_text("")
        expect(run(study, "P01", nobody), INVALID, "is empty")
        file.unlink()
        expect(run(study, "P01", nobody), INVALID, "study.json")
        file.write_text(json.dumps(good))
        expect(run(study, "P99", nobody), INVALID, "P99", "P01")
        expect(run(study, "P01", nobody, "--scripted", "lazy"), USAGE, "biased")
        expect(run(study, "P01", nobody, "--scripted", "exact"), ENVIRONMENT, nobody)
        expect(focalstage("trials"), USAGE, "trials")
        expect(focalstage("trials", "dance"), USAGE, "trials")
        expect(focalstage("trials", "run", study), USAGE, "--participant")
        expect(focalstage("trials", "new", study), INVALID, "not empty")
        expect(focalstage("trials", "report", at), INVALID, "study.json")
        for changes, words in [
                ({"conditions": [{**good["conditions"][0], "project": "none"}, good["conditions"][1]]}, ["none"]),
                ({"targets": [{**good["targets"][0], "cue": "1 mm"}] + good["targets"][1:]}, ["/targets/0", "1 mm"]),
                ({"targets": [{"name": "x", "frame": 99, "actual_m": 0.3}] + good["targets"][1:]}, ["/targets/0", "99"])]:
            file.write_text(json.dumps({**good, **changes}))
            expect(run(study, "P01", nobody, "--out", at / "else" / words[-1]), INVALID, *words)


def test_bad_answers():
    with folder() as at, rig(at, "--virtual-time") as address:
        study = small_study(at)
        assert run(study, "P01", address, "--scripted", "noisy").status == DONE
        file = study / "answers" / "P01.csv"
        good = file.read_text()
        lines = good.splitlines()

        def refused(text, *words):
            file.write_text(text)
            expect(focalstage("trials", "report", study), INVALID, "P01.csv", *words)
            expect(run(study, "P01", address, "--scripted", "noisy", "--resume"), INVALID, "P01.csv", *words)

        def with_cell(line, column, text):
            cells = lines[line].split(",")
            cells[column] = text
            return "\n".join(lines[:line] + [",".join(cells)] + lines[line + 1:]) + "\n"

        refused("a,b\n" + "\n".join(lines[1:]) + "\n", "line 1")
        refused("\n".join(lines[:3] + lines[4:]) + "\n", "line 4", "is next")
        refused("\n".join(lines[:3] + [lines[2]] + lines[3:]) + "\n", "line 4")
        refused(good + lines[-1] + "\n", "line 12", "after the last")
        refused(with_cell(4, 11, "nan"), "line 5", "response_m")
        refused(with_cell(4, 11, "12"), "line 5", "response_m")
        refused(with_cell(4, 11, ""), "line 5")
        refused(with_cell(4, 7, "7 mm"), "line 5", "target")
        refused(with_cell(4, 9, "0.39"), "line 5", "distance")
        refused(with_cell(4, 17, "beef"), "line 5", "show_sha256")
        refused(with_cell(4, 0, "0123456789abcdef"), "line 5", "another study")
        refused(with_cell(4, 1, "P02"), "line 5", "P02")
        refused(lines[0] + "\n\x00\x01\x02\n", "line 2")
        file.write_text(good)

        expect(run(study, "P01", address, "--scripted", "noisy"), INVALID, "--resume")
        expect(run(study, "P01", address, "--scripted", "exact", "--resume"), INVALID, "scripted:noisy")
        expect(run(study, "P02", address, stdin="q\n"), INVALID, "people and scripts are kept apart")
        again = run(study, "P01", address, "--scripted", "noisy", "--resume")
        assert again.status == DONE and "10 of 10" in again.out and file.read_text() == good, again

        changed = json.loads((study / "study.json").read_text())
        before = json.dumps(changed)
        changed["repetitions"] = 2
        (study / "study.json").write_text(json.dumps(changed))
        expect(run(study, "P03", address, "--scripted", "noisy"), INVALID, "another study", "--out")
        changed = json.loads(before)
        changed["participants"].append("late")
        (study / "study.json").write_text(json.dumps(changed))
        assert run(study, "late", address, "--scripted", "noisy").status == DONE
        changed["participants"].reverse()
        (study / "study.json").write_text(json.dumps(changed))
        expect(run(study, "P03", address, "--scripted", "noisy"), INVALID, "participants")
        (study / "study.json").write_text(before.replace("]", ', "late"]', 1))

        project = study / "depth-matching" / "depth-matching.focal"
        project.write_text(project.read_text().replace('"scale": 1', '"scale": 1.1'))
        expect(run(study, "P04", address, "--scripted", "noisy"), INVALID, "has changed")


def test_interrupted():
    """Ctrl-C and an input that ends: dark, one line, and everything answered is kept."""
    with folder() as at, rig(at, "--virtual-time") as address:
        study = small_study(at)
        ran = run(study, "P01", address, stdin="400\n410\n")
        assert ran.status == ENVIRONMENT and "ended before the last trial" in ran.err, ran
        assert len(rows(study, "P01")) == 2 and state(address)["state"] == "ready"
        person = Person(study, "P01", address, "--resume")
        person.hears("Block 1 of 2")
        person.hears("Trial 3 of 5")
        expect(run(study, "P01", address, "--resume"), ENVIRONMENT, "another focalstage")
        asked = time.monotonic()
        person.process.send_signal(signal.SIGINT)
        person.process.wait(10)
        took_s = time.monotonic() - asked
        status, out, err = person.end()
        assert status == -signal.SIGINT and "--resume" in err, (status, out, err)
        assert took_s < 0.2 + float(os.environ.get("FOCALSTAGE_SLACK_S", "0.3")), took_s
        assert len(rows(study, "P01")) == 2
        assert state(address)["state"] == "ready", state(address)


def test_waits_for_its_own_lease():
    """Killed in a trial, the same rig holds the light and the lease; --resume waits for it and ends the light."""
    with folder() as at, rig(at, "--virtual-time") as address:
        study = small_study(at)
        person = Person(study, "P01", address)
        person.hears("Block 1 of 2")
        person.hears("Trial 1 of 5")
        person.process.kill()
        person.process.wait()
        assert state(address)["state"] == "holding"
        ran = run(study, "P01", address, "--resume", stdin="q\n")
        assert ran.status == DONE and "Waiting for it" in ran.out, ran
        assert state(address)["state"] == "ready", state(address)


if __name__ == "__main__":
    main([test_ten_scripted_participants, test_given_up, test_killed_and_resumed, test_torn_row, test_light_of_a_trial,
          test_blackout_in_a_trial, test_scripts_lift_no_darkness, test_lost_rig, test_keys_on_a_terminal,
          test_bad_studies, test_bad_answers, test_interrupted, test_waits_for_its_own_lease])
