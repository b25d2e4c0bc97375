#!/usr/bin/python3
"""The whole rig on emulated devices: the runtime with its real drivers, the firmware on a simulated chip, a waveform
generator on an emulated bus, a projector at the end of a plugin. What light left the projector, through which lens power and
which shutters, is told by the devices' own emulators in their own time; what was asked stands in the show."""

import contextlib
import json
import math
import os
import pathlib
import subprocess
import sys
import time
import zlib

import h5py

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "wire"))
from harness import BIN, focalstage, folder, free_port, main, small_project, succeed, write_project  # noqa: E402

PERIOD_S = 1 / 60
POWER_D = 0.02
TIME_S = 20e-6
LENS = {"gain_d_per_a": 38.0, "lag_s": 0.0006, "delay_s": 0.0001}
# devices/roles/detection.h, and one sweep
DARK_WITHIN_S = {"lens": 0.025 + PERIOD_S, "board": 0.5 + PERIOD_S, "projector": 1.0 + PERIOD_S}
TRACKER_DARK_WITHIN_S = 0.1 + PERIOD_S
# What the fault says first: without the lens drive it is the board that misses its edges.
NAMED = {"lens": ("sync edge", "lens drive"), "board": ("trigger board",), "projector": ("projector",)}


def response(frequency_hz):
    """A gain, a first-order lag and a delay: what somebody would measure of the emulated lenses."""
    turn = 2 * math.pi * frequency_hz
    return {"frequency_hz": frequency_hz, "gain_d_per_a": LENS["gain_d_per_a"] / math.hypot(1, turn * LENS["lag_s"]),
            "phase_deg": math.degrees(-math.atan(turn * LENS["lag_s"]) - turn * LENS["delay_s"])}


def rig_json(at):
    points = [response(60.0 * n) for n in range(9)]
    plugin = pathlib.Path(os.environ["FOCALSTAGE_PLUGINS"]) / "focalstage-wire.so"
    return {
        "focalstage_rig": 1,
        "rig": {"name": "emulated", "kind": "devices"},
        "devices": {
            "projector": {"driver": "plugin", "settings": {"library": str(plugin), "eye_safe": True,
                                                           "socket": str(at / "optics")}},
            "lens_drive": {"driver": "mcc1208", "settings": {"amperes_per_volt": 0.12, "enable_bit": 0}},
            "trigger_board": {"driver": "uno", "address": str(at / "board")},
        },
        "measured": {
            "projector": {"model": "dynaflash", "width_px": 1024, "height_px": 768, "frames_per_second": 2840,
                          "latency_ms": 0.15},
            "glasses": {"lens_to_pupil_mm": 15, "lens_min_d": -10, "lens_max_d": 10, "lens_aperture_mm": 16,
                        "shutter_close_ms": 0.1, "shutter_open_ms": 3,
                        "lens_response": {"left": points, "right": points}},
        },
        "network": {"listen": "127.0.0.1:0"},
        "store": str(at / "store"),
    }


class EmulatedRig:
    """rig-emulator with a runtime beside it."""

    def __init__(self, at, *options, config=None):
        (at / "rig.json").write_text(json.dumps(config or rig_json(at)))
        self.report_path = at / "report.jsonl"
        self.log = open(at / "log", "w")
        self.process = subprocess.Popen(
            [BIN / "rig-emulator", "--socket", at / "optics", "--board", at / "board", "--report", self.report_path,
             *options, "--", BIN / "focalstage-runtime", "--config", at / "rig.json"],
            stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=self.log, text=True)
        line = self.process.stdout.readline()
        assert line.startswith("listening on "), (line, (at / "log").read_text())
        self.address = line.split()[-1]

    def tell(self, words):
        self.process.stdin.write(words + "\n")
        self.process.stdin.flush()
        answer = self.process.stdout.readline().split(" ", 1)
        assert answer[0] == "done", answer
        return json.loads(answer[1])

    def rig(self, *words):
        return focalstage("rig", *words, "--to", self.address)

    def state(self):
        return json.loads(succeed("rig", "state", "--json", "--to", self.address).out)

    def light(self):
        """All exposures so far in which a picture was lit."""
        lines = self.report_path.read_text().splitlines()
        return [light for light in map(json.loads, filter(lambda line: line.endswith("}"), lines)) if not light["dark"]]

    def until(self, true, what, seconds=20.0):
        end = time.monotonic() + seconds
        while not true():
            assert time.monotonic() < end, f"{what}: not after {seconds} s; {self.rig('state').out}"
            time.sleep(0.05)

    def play(self):
        """Go and play, as soon as the rig is ready for it, until there is light. On a busy machine a rig may go dark before
        its first light: then again, as a person would."""
        self.play_until(lambda: self.rig("go").status == 0 and self.rig("play").status == 0, len(self.light()) + 1)

    def play_until(self, play, exposures):
        """`play` says go and play, and whether that was done; until there were so many exposures in all."""
        self.until(play, "play")
        self.until(lambda: len(self.light()) >= exposures or (self.state()["state"] == "dark" and play() and False),
                   "light", 40.0)

    def end(self):
        with contextlib.suppress(BrokenPipeError):
            self.process.stdin.close()
        self.process.wait(20)
        self.log.close()


@contextlib.contextmanager
def emulated(at, *options, config=None):
    rig = EmulatedRig(at, *options, config=config)
    try:
        yield rig
    except BaseException:
        print((at / "log").read_text()[-3000:])
        raise
    finally:
        rig.end()


def pushed(rig, at):
    """three-rabbits, compiled for what this rig measured of itself, and active on it."""
    succeed("new", at / "room", "--from", "three-rabbits")
    succeed("adopt-rig", at / "room", "--to", rig.address)
    succeed("compile", at / "room", "-o", at / "room.h5")
    succeed("push", at / "room.h5", "--to", rig.address, "--activate")
    return asked(at / "room.h5")


def asked(path):
    """The slots of a show: when, how long, through which power, which picture, which eye."""
    with h5py.File(path) as show:
        group = show["projector/0"]
        crcs = [zlib.crc32(image.tobytes()) for image in group["images"][0]]
        lit = [bool(image.any()) for image in group["images"][0]]
        slots = []
        for image, start_s, exposure_s, power_d in zip(group["slot/image"], group["slot/start_s"], group["slot/exposure_s"],
                                                       group["slot/power_d"]):
            slots.append({"start_s": start_s, "exposure_s": exposure_s, "power_d": power_d, "crc": crcs[image],
                          "lit": lit[image], "eye": "left" if start_s < PERIOD_S / 2 else "right"})
        return slots


def slot_of(light, slots):
    """The slot that comes nearest, and how far off the light was."""
    def off_s(slot):
        turns = (light["start_s"] - light["edge_s"] - slot["start_s"]) / PERIOD_S
        return (turns - round(turns)) * PERIOD_S
    nearest = min(range(len(slots)), key=lambda i: abs(off_s(slots[i])))
    return nearest, off_s(slots[nearest])


def hold_against(slots, lights):
    """Every exposure is the one that was asked for there. The worst error of power and of time."""
    worst_d = worst_s = 0.0
    counts = [0] * len(slots)
    for light in lights:
        i, off_s = slot_of(light, slots)
        slot = slots[i]
        counts[i] += 1
        other = "right" if slot["eye"] == "left" else "left"
        assert light["crc"] == slot["crc"], ("another picture", i, light)
        assert min(light[slot["eye"]]) >= 0.999, ("own shutter", i, light)
        assert max(light[other]) <= 0.001, ("other shutter", i, light)
        assert abs(light["exposure_s"] - slot["exposure_s"]) <= TIME_S, (i, light)
        worst_d = max(worst_d, abs(light["power_d"] - slot["power_d"]))
        worst_s = max(worst_s, abs(off_s))
    assert worst_d <= POWER_D and worst_s <= TIME_S, (worst_d, worst_s)
    return worst_d, worst_s, counts


def test_plays_ten_seconds():
    with folder() as at, emulated(at) as rig:
        slots = pushed(rig, at)
        rig.play()
        from_s = rig.tell("time")["time_s"]
        rig.until(lambda: rig.tell("time")["time_s"] > from_s + 10.0, "ten seconds", 60.0)
        state = rig.state()
        assert state["state"] == "playing" and state["missed_exposures"] == 0, state
        assert all(not slot["measured"] and slot["delivered"] is None for slot in state["slots"]), state["slots"]
        lights = [light for light in rig.light() if light["start_s"] > from_s + 0.5]
        worst_d, worst_s, counts = hold_against(slots, lights)
        lit = [count for count, slot in zip(counts, slots) if slot["lit"]]
        assert min(lit) >= 560 and max(lit) - min(lit) <= 1, counts
        print(f"{sum(counts)} exposures of {len(lit)} slots: power within {worst_d:.4f} D, time within "
              f"{worst_s * 1e6:.2f} us")
        assert rig.rig("blackout").status == 0
        dark = rig.tell("time")["time_s"]
        rig.until(lambda: rig.tell("time")["time_s"] > dark + 0.5, "half a second")
        assert max(light["start_s"] for light in rig.light()) < dark + PERIOD_S
        seen = rig.tell("time")
        assert abs(seen["power_d"]) < 1e-3 and seen["closed"] == [True, True], seen


def test_board_clock_half_a_percent_off():
    for ppm in (-5000, 5000):
        with folder() as at, emulated(at, "--clock-ppm", str(ppm)) as rig:
            slots = pushed(rig, at)
            rig.play()
            from_s = rig.tell("time")["time_s"]
            rig.until(lambda: rig.tell("time")["time_s"] > from_s + 1.5, "a second and a half", 30.0)
            lights = [light for light in rig.light() if light["start_s"] > from_s + 0.5]
            worst_d, worst_s, counts = hold_against(slots, lights)
            assert sum(counts) > 200, counts
            print(f"{ppm} ppm: power within {worst_d:.4f} D, time within {worst_s * 1e6:.2f} us")


def test_a_lens_that_is_not_as_measured():
    """The report can fail: a lens slower than what the rig says of itself is off by more than is allowed."""
    with folder() as at, emulated(at, "--lens-lag-s", "0.0012") as rig:
        slots = pushed(rig, at)
        rig.play()
        from_s = rig.tell("time")["time_s"]
        rig.until(lambda: rig.tell("time")["time_s"] > from_s + 1.0, "a second", 30.0)
        lights = [light for light in rig.light() if light["start_s"] > from_s + 0.5]
        worst_d = max(abs(light["power_d"] - slots[slot_of(light, slots)[0]]["power_d"]) for light in lights)
        assert worst_d > 5 * POWER_D, worst_d


def test_unplugged_and_plugged_in():
    with folder() as at, emulated(at) as rig:
        slots = pushed(rig, at)
        for device, within_s in DARK_WITHIN_S.items():
            rig.play()
            out_s = rig.tell(f"unplug {device}")["time_s"]
            rig.until(lambda: rig.state()["state"] == "dark", f"dark without {device}")
            fault = rig.state()["fault"]
            assert any(name in fault for name in NAMED[device]), (device, fault)
            rig.until(lambda: rig.tell("time")["time_s"] > out_s + 1.2, "a second")
            last = max(light["start_s"] + light["exposure_s"] for light in rig.light())
            assert last - out_s <= within_s, (device, last - out_s)
            seen = rig.tell("time")
            assert abs(seen["power_d"]) < 1e-3, (device, seen)
            if device != "board":  # its own outputs have no power now
                assert seen["closed"] == [True, True], (device, seen)
            refused = rig.rig("go")
            assert refused.status != 0 and NAMED[device][-1] in refused.err, (device, refused)
            print(f"{device}: no light after {max(0.0, last - out_s) * 1e3:.1f} ms; {fault}")
            rig.tell(f"plug {device}")
        rig.play()
        from_s = rig.tell("time")["time_s"]
        rig.until(lambda: rig.tell("time")["time_s"] > from_s + 1.0, "a second")
        hold_against(slots, [light for light in rig.light() if light["start_s"] > from_s + 0.5])


def test_a_trigger_that_comes_to_nothing():
    """Every later picture would come one trigger late: the rig is dark before many did."""
    with folder() as at, emulated(at) as rig:
        slots = pushed(rig, at)
        rig.play()
        lost_s = rig.tell("lose-trigger")["time_s"]
        rig.until(lambda: rig.state()["state"] == "dark", "dark")
        assert "trigger" in rig.state()["fault"], rig.state()
        wrong = [light for light in rig.light()
                 if light["start_s"] > lost_s and light["crc"] != slots[slot_of(light, slots)[0]]["crc"]]
        last_s = max(light["start_s"] for light in rig.light())
        assert last_s - lost_s < 5 * PERIOD_S, (last_s - lost_s, len(wrong))
        print(f"dark {1e3 * (last_s - lost_s):.0f} ms after it, {len(wrong)} exposures with another's picture")


def test_busy_machine():
    """As many programs as the machine has cores, each of which would have one for itself: what light there is is right, and
    where there is none the rig says why, and plays again on go."""
    seconds = float(os.environ.get("FOCALSTAGE_BUSY_SECONDS", "10"))
    with folder() as at, emulated(at) as rig, busy_cores():
        slots = pushed(rig, at)
        faults = []
        rig.play()
        from_s = rig.tell("time")["time_s"]
        while (now_s := rig.tell("time")["time_s"]) < from_s + seconds:
            state = rig.state()
            assert state["state"] == "playing" or state["fault"], state
            if state["state"] != "playing":
                faults.append(state["fault"])
                rig.play()
            time.sleep(0.1)
        lights = [light for light in rig.light() if light["start_s"] > from_s + 0.5]
        worst_d, worst_s, counts = hold_against(slots, lights)
        asked_for = round((now_s - from_s - 0.5) / PERIOD_S) * sum(slot["lit"] for slot in slots)
        assert sum(counts) > asked_for // 10, (counts, faults)
        print(f"{sum(counts)} of {asked_for} exposures, {len(faults)} times dark: power within {worst_d:.4f} D, time within "
              f"{worst_s * 1e6:.2f} us; {sorted(set(faults))}")


@contextlib.contextmanager
def busy_cores():
    programs = [subprocess.Popen([sys.executable, "-c", "while True: pass"]) for _ in range(os.cpu_count())]
    try:
        yield
    finally:
        for program in programs:
            program.kill()
            program.wait()


class Tracker:
    """A NatNet server with a body "Box" at rest at (0, 0.5, -1); unplugged, it is killed."""

    def __init__(self):
        self.port = free_port()
        self.process = None
        self.plug()

    def plug(self):
        self.process = subprocess.Popen([BIN / "natnet-server", "--port", str(self.port), "--rate", "120"],
                                        stdout=subprocess.DEVNULL)

    def unplug(self):
        self.process.kill()
        self.process.wait()

    def config(self):
        """It stands so that the box is where the project's own stands, before the screen."""
        return {"driver": "natnet", "address": "127.0.0.1",
                "settings": {"cast": "unicast", "command_port": self.port, "data_port": 0},
                "world_from_tracker": {"position_m": [0, -0.5, 0.6]},
                "bodies": [{"name": "Box", "body_from_thing": {"position_m": [0, 0, -0.115]}}]}


class Hand:
    """An editor's hand on the rig: holds it live with a project."""

    def __init__(self, rig, file):
        self.process = subprocess.Popen([BIN / "live-hand", rig.address, file], stdin=subprocess.PIPE,
                                        stdout=subprocess.PIPE, text=True)

    def says(self, word):
        self.process.stdin.write(word + "\n")
        self.process.stdin.flush()
        return self.process.stdout.readline().strip()

    def end(self):
        self.process.stdin.close()
        self.process.wait(20)


def test_tracker_unplugged_and_plugged_in():
    """What plays live at a body goes dark when its tracker falls silent, and plays again once that is back."""
    with folder() as at:
        tracker = Tracker()
        config = rig_json(at)
        config["devices"]["tracker"] = tracker.config()
        config["measured"]["projector"].update(width_px=96, height_px=64)
        hand = None
        try:
            with emulated(at, "--width", "96", "--height", "64", config=config) as rig:
                project = small_project(frames=1)
                del project["objects"][0]["keys"]
                project["objects"][0]["track"] = "Box"
                file = write_project(at / "small", project)
                succeed("adopt-rig", at / "small", "--to", rig.address)
                rig.until(lambda: rig.state()["parts"][-1]["phase"] == "running", "a tracker that is heard")
                hand = Hand(rig, file)
                for _ in range(2):
                    lit = len(rig.light())
                    rig.play_until(lambda: hand.says("go") == "done" and hand.says("play") == "done", lit + 61)
                    assert rig.state()["state"] == "playing", rig.state()
                    out_s = rig.tell("time")["time_s"]
                    tracker.unplug()
                    rig.until(lambda: rig.state()["state"] == "dark", "dark without the tracker")
                    state = rig.state()
                    assert "rig.tracker" in state["fault"] and "Box" in state["fault"], state["fault"]
                    assert state["parts"][-1]["driver"] == "natnet" and state["parts"][-1]["phase"] == "lost", state["parts"]
                    rig.until(lambda: rig.tell("time")["time_s"] > out_s + 0.5, "half a second")
                    last = max(light["start_s"] + light["exposure_s"] for light in rig.light())
                    assert last - out_s <= TRACKER_DARK_WITHIN_S, last - out_s
                    print(f"tracker: no light after {1e3 * (last - out_s):.1f} ms; {state['fault']}")
                    tracker.plug()
                    rig.until(lambda: rig.state()["parts"][-1]["phase"] == "running", "a tracker that is heard again")
        finally:
            if hand:
                hand.end()
            tracker.unplug()


if __name__ == "__main__":
    main([test_plays_ten_seconds, test_board_clock_half_a_percent_off, test_a_lens_that_is_not_as_measured,
          test_unplugged_and_plugged_in, test_tracker_unplugged_and_plugged_in, test_a_trigger_that_comes_to_nothing,
          test_busy_machine])
