#!/usr/bin/python3
"""What the editor's window costs: start, frames while hands move, undo, idling. Runs on a display of its own.

    scripts/bench-editor [EDITOR]

Prints medians and 95th percentiles in milliseconds beside the window's own frame (nothing but panels), in one run.
"""

import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
TIMES = re.compile(r"(\d+): (\d+) frames: median ([\d.]+) ms, 95th percentile ([\d.]+) ms, longest ([\d.]+) ms")

STEPS = [
    ("orbit, first-light", "timed drag pane/room 0.6 0.8 -> pane/room 0.8 0.6 steps 90 right"),
    ("drag a number, slices follow", 'timed drag "properties/position x" -> "properties/position x" 2.5 0.5 steps 60'),
    ("focus slider", "timed drag pane/eye/focus 0.3 0.5 -> pane/eye/focus 0.8 0.5 steps 60"),
    ("undo", "timed run edit.undo", 'edit {"edit":"set","list":"objects","name":"rabbit","key":"scale","value":0.2}'),
    ("window alone", "timed drag bar/project -> bar/compile steps 40 right"),
]


def environment_in(folder):
    return {**os.environ, "XDG_STATE_HOME": str(folder / "state"), "XDG_CONFIG_HOME": str(folder / "config")}


def play(editor, lines, folder):
    script = folder / "bench.script"
    script.write_text("\n".join(lines) + "\n")
    done = subprocess.run(
        [editor, "--script", str(script)],
        stdout=subprocess.PIPE, text=True, cwd=folder, env=environment_in(folder), timeout=300,
    )
    if done.returncode != 0:
        sys.exit(f"bench-editor: the editor ended with {done.returncode}")
    return done.stdout


def opened(project):
    return ["size 1600 900", 'run file.open {"path": "%s"}' % project, "wait tasks", "wait compile within 120"]


def many_objects(folder, count):
    """first-light with so many boxes in rows."""
    import json

    project = json.loads((folder / "projects/first-light/first-light.focal").read_text())
    for k in range(count):
        project["objects"].append(
            {
                "name": f"box {k}",
                "mesh": {"primitive": "box", "size_m": [0.01, 0.01, 0.01]},
                "position_m": [0.015 * (k % 25) - 0.18, 0.015 * (k // 25) - 0.15, -0.5],
                "rotation_xyzw": [0, 0, 0, 1],
            }
        )
    (folder / "many").mkdir()
    (folder / "many/many.focal").write_text(json.dumps(project))


def million_triangles(folder):
    """first-light on a gently waved screen of a million triangles."""
    import json
    import math
    import struct

    side = 708
    vertices, faces = bytearray(), bytearray()
    for row in range(side):
        for column in range(side):
            x, y = 0.6 * column / (side - 1) - 0.3, 0.44 * row / (side - 1) - 0.22
            vertices += struct.pack("<fff", x, y, 0.005 * math.sin(30 * x) * math.sin(30 * y))
    for row in range(side - 1):
        for column in range(side - 1):
            a = row * side + column
            faces += struct.pack("<BiiiBiii", 3, a, a + 1, a + side + 1, 3, a, a + side + 1, a + side)
    count = 2 * (side - 1) ** 2
    header = (
        f"ply\nformat binary_little_endian 1.0\nelement vertex {side * side}\nproperty float x\nproperty float y\n"
        f"property float z\nelement face {count}\nproperty list uchar int vertex_indices\nend_header\n"
    )
    (folder / "million/assets").mkdir(parents=True)
    (folder / "million/assets/wave.ply").write_bytes(header.encode() + vertices + faces)
    project = json.loads((folder / "projects/first-light/first-light.focal").read_text())
    project["surfaces"][0]["mesh"] = {"file": "assets/wave.ply"}
    (folder / "million/million.focal").write_text(json.dumps(project))


def idle_share(editor, folder):
    """Of one core, over four seconds in which nothing happens."""
    process = subprocess.Popen([editor, "projects/first-light"], cwd=folder, env=environment_in(folder))
    time.sleep(5)
    ticks = lambda: sum(map(int, pathlib.Path(f"/proc/{process.pid}/stat").read_text().rsplit(")", 1)[1].split()[11:13]))
    before = ticks()
    time.sleep(4)
    after = ticks()
    process.kill()
    process.wait()
    return (after - before) / os.sysconf("SC_CLK_TCK") / 4


def report(name, said):
    for _, frames, median, high, longest in TIMES.findall(said):
        print(f"{name:34} {frames:>5} frames  {median:>7} {high:>7} {longest:>7}")


def main():
    editor = sys.argv[1] if len(sys.argv) > 1 else str(ROOT / "build/release/bin/focalstage-editor")
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        shutil.copytree(ROOT / "projects", folder / "projects")
        print(f"{'':34} {'':>12}  {'median':>7} {'95 %':>7} {'longest':>7}   ms")
        for cold in (True, False):
            begun = time.monotonic()
            play(editor, ["frames 1"], folder)
            first = time.monotonic()
            play(editor, opened("projects/first-light") + ["frames 1"], folder)
            shown = time.monotonic()
            print(f"start to {'end' if cold else 'end again'}: window {1e3 * (first - begun):.0f} ms, "
                  f"first-light compiled and shown {1e3 * (shown - first):.0f} ms")
        for name, step, *before in STEPS:
            lines = opened("projects/first-light") + ["select objects rabbit", *before, "wait compile", step]
            report(name, play(editor, lines, folder))
        many_objects(folder, 500)
        report("orbit, 500 objects more", play(editor, opened("many") + [STEPS[0][1]], folder))
        million_triangles(folder)
        said = play(editor, opened("million") + ["select objects rabbit", STEPS[0][1], STEPS[1][1]], folder).splitlines()
        report("orbit, a million triangles", said[-2])
        report("drag a number, a million triangles", said[-1])
        print(f"idle: {100 * idle_share(editor, folder):.1f} % of one core")


if __name__ == "__main__":
    main()
