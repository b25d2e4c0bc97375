#!/usr/bin/python3
"""What the whole rig on emulated devices must do: tests/rig/emulated_rig.py."""

import contextlib
import os
import subprocess
import sys
import time

from emulated_rig import PERIOD_S, POWER_D, emulated, hold_against, pushed, rig_json, slot_of
from harness import BIN, folder, free_port, main, small_project, succeed, write_project

# devices/roles/detection.h, and one sweep
DARK_WITHIN_S = {"lens": 0.025 + PERIOD_S, "board": 0.5 + PERIOD_S, "projector": 1.0 + PERIOD_S}
TRACKER_DARK_WITHIN_S = 0.1 + PERIOD_S
# What the fault says first: without the lens drive it is the board that misses its edges.
NAMED = {"lens": ("sync edge", "lens drive"), "board": ("trigger board",), "projector": ("projector",)}



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
            worst_d, worst_s, counts = hold_against(slots, rig.played(1.5))
            assert sum(counts) > 200, counts
            print(f"{ppm} ppm: power within {worst_d:.4f} D, time within {worst_s * 1e6:.2f} us")


def test_a_lens_that_is_not_as_measured():
    """The report can fail: a lens slower than what the rig says of itself is off by more than is allowed."""
    with folder() as at, emulated(at, "--lens-lag-s", "0.0012") as rig:
        slots = pushed(rig, at)
        worst_d = max(abs(light["power_d"] - slots[slot_of(light, slots)[0]]["power_d"]) for light in rig.played(1.0))
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
