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
from harness import BIN, focalstage, succeed  # noqa: E402

PERIOD_S = 1 / 60
POWER_D = 0.02
TIME_S = 20e-6
LENS = {"gain_d_per_a": 38.0, "lag_s": 0.0006, "delay_s": 0.0001}


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

    def played(self, seconds):
        """Plays, and tells the light since half a second later."""
        self.play()
        from_s = self.tell("time")["time_s"]
        self.until(lambda: self.tell("time")["time_s"] > from_s + seconds, f"{seconds} s of play", 30.0)
        return [light for light in self.light() if light["start_s"] > from_s + 0.5]

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
