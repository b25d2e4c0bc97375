#!/usr/bin/python3
"""Kills the editor at random moments of a scripted session and holds what it recovers against what it had been told.

    kill_editor.py EDITOR KILLS

Every edit that was made a second or more before the kill must come back, in order, and Undo must reach behind it. The
seed is printed; FOCALSTAGE_SEED repeats a run.
"""

import os
import pathlib
import random
import re
import signal
import subprocess
import sys
import tempfile
import time

EDITS = 4000


def script_of_edits(path):
    lines = ['run file.new {"from":"first-light"}', "print /view/frame"]
    for k in range(1, EDITS + 1):
        value = 55 + k * 0.001
        lines.append('edit {"edit":"set","list":"viewer","name":"","key":"interpupillary_mm","value":%.3f}' % value)
        lines.append("print /project/viewer/interpupillary_mm")
    path.write_text("\n".join(lines) + "\n")


def script_of_recovery(path):
    path.write_text(
        "\n".join(
            [
                "print /recoveries",
                'run file.recover {"index":0}',
                "print /project/viewer/interpupillary_mm",
                "print /history/place",
                'run edit.jump {"place":0}',
                "print /project/viewer/interpupillary_mm",
                "run file.close",
            ]
        )
        + "\n"
    )


def numbers(text):
    return [float(n) for n in re.findall(r"-?\d+(?:\.\d+)?(?:e-?\d+)?", text)]


def edit_and_kill(editor, script, environment, after_s):
    """The values that were seen, each with when."""
    seen = []
    process = subprocess.Popen(
        [editor, "--hidden", "--script", str(script)], stdout=subprocess.PIPE, env=environment
    )
    begun = None
    os.set_blocking(process.stdout.fileno(), False)
    rest = ""
    while process.poll() is None:
        chunk = (process.stdout.read() or b"").decode()
        now = time.monotonic()
        rest += chunk
        *lines, rest = rest.split("\n")
        for line in lines:
            found = numbers(line)
            if begun is None:
                begun = now
            elif found:
                seen.append((now, found[-1]))
        if begun is not None and now - begun >= after_s:
            process.send_signal(signal.SIGKILL)
            process.wait()
            return seen, now
        time.sleep(0.001)
    sys.exit(f"kill_editor: the editor ended by itself with {process.returncode}")


def recover(editor, script, environment):
    done = subprocess.run(
        [editor, "--hidden", "--script", str(script)], capture_output=True, text=True, env=environment, timeout=60
    )
    if done.returncode != 0:
        sys.exit(f"kill_editor: nothing was recovered: {done.stdout}{done.stderr}")
    return [numbers(line)[-1] for line in done.stdout.splitlines() if numbers(line)]


def main():
    editor, kills = sys.argv[1], int(sys.argv[2])
    seed = int(os.environ.get("FOCALSTAGE_SEED", random.SystemRandom().randrange(1 << 30)))
    chance = random.Random(seed)
    print(f"seed {seed}")
    lost_most = 0
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        edits, recovery = folder / "edits.script", folder / "recovery.script"
        script_of_edits(edits)
        script_of_recovery(recovery)
        for k in range(kills):
            home = folder / f"home-{k}"
            environment = {**os.environ, "XDG_STATE_HOME": str(home / "state"), "XDG_CONFIG_HOME": str(home / "config")}
            seen, killed = edit_and_kill(editor, edits, environment, chance.uniform(0.02, 0.6))
            if not seen:
                continue
            count, value, place, first = recover(editor, recovery, environment)
            old = [v for when, v in seen if when <= killed - 1.0]
            if count != 1 or first != 63 or (old and value < old[-1]) or abs(place - (value - 55) * 1000) > 0.5:
                sys.exit(f"kill {k}: recovered {value} at step {place} (undone: {first}), seen {seen[-1][1]}")
            lost_most = max(lost_most, round((seen[-1][1] - value) * 1000))
    print(f"{kills} kills; edits lost at most: {max(lost_most, 0)}")


if __name__ == "__main__":
    main()
