#!/usr/bin/python3
"""A rig with a tracker: recorded again from a recording, and the trackers that there are not."""

import json
import subprocess
import time

from harness import INVALID, RUNTIME, USAGE, folder, main, rig, succeed

HEAD = """# focalstage tracking 1
frame,time_s,latency_s,arrival_s,id,name,tracked,x_m,y_m,z_m,qx,qy,qz,qw,mean_error_m
"""


def walk(path):
    """A second of a body that goes to and fro, a hundred frames."""
    rows = [f"{k},{0.01 * k!r},0.004,{5 + 0.01 * k!r},7,Card,1,{0.001 * abs(k - 50)!r},0,-1,0,0,0,1,0.0005" for k in range(100)]
    path.write_text(HEAD + "\n".join(rows) + "\n")
    return path


def body(line):
    """What a row says of its body."""
    cells = line.split(",")[4:]
    return tuple(cell if n == 1 else float(cell) for n, cell in enumerate(cells))


def test_a_recording_is_a_tracker_and_is_recorded_again():
    with folder() as at:
        file, again = walk(at / "walk.csv"), at / "again.csv"
        with rig(at, "--tracker", f"recording:{file}", "--record-tracker", str(again), "--tracker-pose", "0", "0", "0",
                 "0", "0", "0", "1") as address:
            assert succeed("rig", "state", "--to", address, "--json").json()["pose_to_light_ms"] == 0
            time.sleep(0.5)
        lines = again.read_text().splitlines()
        assert lines[:2] == HEAD.splitlines() and len(lines) > 20, lines[:3]
        asked = {body(line) for line in file.read_text().splitlines()[2:]}
        assert all(body(line) in asked for line in lines[2:]), lines[2]


def rig_json(at, tracker):
    (at / "rig.json").write_text(json.dumps({"focalstage_rig": 1, "devices": {"tracker": tracker}}))
    return str(at / "rig.json")


def test_a_file_names_the_tracker():
    """The same tracker from rig.json, a path of which is relative to it; said once more on the command line it is no other."""
    with folder() as at:
        walk(at / "walk.csv")
        config, again = rig_json(at, {"driver": "recording", "file": "walk.csv", "bodies": [{"name": "Card"}]}), at / "again.csv"
        with rig(at, "--config", config, "--record-tracker", str(again)) as address:
            time.sleep(0.5)
            parts = succeed("rig", "state", "--to", address, "--json").json()["parts"]
            assert [(part["driver"], part["phase"], part["address"]) for part in parts] == [
                ("sim", "running", "in this program"), ("recording", "running", str(at / "walk.csv")),
                ("sim", "ready", "in this program")], parts
        assert len(again.read_text().splitlines()) > 20
        config = rig_json(at, {"driver": "recording", "file": "walk.csv"})
        with rig(at, "--config", config, "--tracker", f"recording:{at}/walk.csv"):
            pass
        err = refused("--store", at, "--config", config, "--tracker", "natnet:127.0.0.1")
        assert f"{config}: /devices/tracker" in err and "--tracker natnet:127.0.0.1" in err, err
        err = refused("--store", at, "--config", rig_json(at, {"driver": "natnet", "settings": {"cast": 1}}), status=INVALID)
        assert "/devices/tracker/settings/cast" in err, err
        err = refused("--store", at, "--config", rig_json(at, {"driver": "recording", "file": "none.csv"}), status=INVALID)
        assert "recording.unreadable" in err and f"{at}/none.csv" in err, err


def refused(*options, status=USAGE):
    done = subprocess.run([RUNTIME, "--listen", "127.0.0.1:0", *map(str, options)], capture_output=True, text=True, timeout=60)
    assert done.returncode == status and done.stdout == "", done
    return done.stderr


def test_trackers_that_there_are_not():
    with folder() as at:
        assert "tracker.unknown" in refused("--store", at, "--tracker", "vicon:host")
        assert "recording.unreadable" in refused("--store", at, "--tracker", f"recording:{at}/none.csv")
        (at / "bad.csv").write_text(HEAD + "1,2,3\n")
        assert "bad.csv: line 3" in refused("--store", at, "--tracker", f"recording:{at}/bad.csv")
        assert "--tracker" in refused("--store", at, "--record-tracker", at / "out.csv")


if __name__ == "__main__":
    main([test_a_recording_is_a_tracker_and_is_recorded_again, test_a_file_names_the_tracker, test_trackers_that_there_are_not])
