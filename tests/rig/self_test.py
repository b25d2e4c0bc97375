#!/usr/bin/python3
"""A rig of emulated devices whose configuration is wrong about it looks through photodiodes at a second board, and finds out:
what is then compiled for it is delivered as asked. Takes minutes: each record comes through a serial line."""

import json
import subprocess

from emulated_rig import BIN, emulated, hold_against, pushed, response, rig_json
from harness import folder, main

HARMONICS = 3
PATIENCE_S = 900


def light_sensor(at):
    """What the emulator's photodiodes look at: tests/rig/emulator/photodiodes.h."""
    def line(power_d, left_px, right_px):
        return {"power_d": power_d, "spread_d": 0.01, "left_px": [left_px, 200, 4, 300], "right_px": [right_px, 200, 4, 300]}
    return {"driver": "uno", "address": str(at / "eyes"), "settings": {"left_input": 0, "right_input": 1},
            "targets": [line(-1, 300, 620), line(1, 340, 660)]}


def wrong_config(at):
    config = rig_json(at)
    config["devices"]["light_sensor"] = light_sensor(at)
    glasses = config["measured"]["glasses"]
    wrong = [{**point, "gain_d_per_a": 0.9 * point["gain_d_per_a"], "phase_deg": 1.3 * point["phase_deg"]}
             for point in glasses["lens_response"]["left"]]
    glasses.update(lens_response={"left": wrong, "right": wrong}, shutter_open_ms=3.6)
    config["measured"]["projector"]["latency_ms"] = 0.3
    return config


def measured(rig):
    """What it finds out about itself; where a busy machine made it dark, once more."""
    said = []
    for _ in range(3):
        rig.until(lambda: rig.rig("go").status == 0, "go")
        ran = subprocess.run([BIN / "focalstage", "rig", "self-test", "--harmonics", str(HARMONICS), "--json", "--to",
                              rig.address], capture_output=True, text=True, timeout=PATIENCE_S)
        if ran.returncode == 0:
            return json.loads(ran.stdout)
        said.append(ran.stderr.splitlines()[-1])
    raise AssertionError(said)


def test_measures_itself():
    with folder() as at, emulated(at, "--light-sensor", at / "eyes", config=wrong_config(at)) as rig:
        found = measured(rig)
        assert abs(found["latency_ms"]["value"] - 0.15) < 0.012, found["latency_ms"]
        for side in ("left", "right"):
            eye = found[side]
            assert abs(eye["shutter_open_ms"]["value"] - 3.0) < 0.08, eye
            assert abs(eye["shutter_close_ms"]["value"] - 0.1) < 0.03, eye
            assert len(eye["lens"]) == HARMONICS + 1, eye
            for point in eye["lens"][1:]:
                true = response(60.0 * point["harmonic"])
                assert abs(point["gain_d_per_a"]["value"] / true["gain_d_per_a"] - 1) < 0.02, (side, point, true)
                assert abs(point["phase_deg"]["value"] - true["phase_deg"]) < 1.5, (side, point, true)
        rig.until(lambda: rig.rig("go").status == 0, "go")
        slots = pushed(rig, at)
        worst_d, worst_s, counts = hold_against(slots, rig.played(1.5))
        assert sum(counts) > 200, counts
        print(f"as it measured itself: power within {worst_d:.4f} D, time within {worst_s * 1e6:.2f} us")


if __name__ == "__main__":
    main([test_measures_itself])
