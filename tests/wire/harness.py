"""What the end-to-end tests share: running the programs, a temporary folder, a rig on a free port, a small project."""

import contextlib
import json
import os
import pathlib
import re
import signal
import socket
import subprocess
import sys
import tempfile
import time
import traceback

BIN = pathlib.Path(os.environ.get("FOCALSTAGE_BIN", "build/release/bin")).resolve()
FOCALSTAGE = str(BIN / "focalstage")
RUNTIME = str(BIN / "focalstage-runtime")
PROJECTS = pathlib.Path(__file__).resolve().parents[2] / "projects"
TIMEOUT_S = 240

# These tests have no display, whoever runs them has one.
for variable in ("DISPLAY", "WAYLAND_DISPLAY"):
    os.environ.pop(variable, None)

PROGRESS = re.compile(r"[A-Z].*: \d+ %")

DONE, FINDINGS, USAGE, INVALID, ENVIRONMENT = range(5)


class Ran:
    """A command that has ended."""

    def __init__(self, arguments, status, out, err):
        self.arguments, self.status, self.out, self.err = arguments, status, out, err

    def __str__(self):
        return f"focalstage {' '.join(map(str, self.arguments))}\n  exit {self.status}\n  out: {self.out!r}\n  err: {self.err!r}"

    def json(self):
        return json.loads(self.out)


def focalstage(*arguments, cwd=None, stdin=None, environment=None):
    done = subprocess.run([FOCALSTAGE, *map(str, arguments)], capture_output=True, text=True, cwd=cwd, input=stdin,
                          timeout=TIMEOUT_S, env={**os.environ, **(environment or {})})
    return Ran(arguments, done.returncode, done.stdout, done.stderr)


def expect(ran, status, *words, line=True):
    """The status, one line on stderr where it is a failure, and the words in it."""
    assert ran.status == status, f"wanted exit {status}:\n{ran}"
    if line and status in (USAGE, INVALID, ENVIRONMENT):
        lines = [l for l in ran.err.splitlines() if not PROGRESS.match(l)]
        assert len(lines) == 1 and lines[0].startswith("focalstage"), f"wanted one line on stderr:\n{ran}"
        assert lines[0].isprintable(), f"wanted only printable signs:\n{ran}"
        assert ran.out == "", f"wanted nothing on stdout:\n{ran}"
    for word in words:
        assert word in ran.err, f"wanted '{word}' on stderr:\n{ran}"
    return ran


def succeed(*arguments, **options):
    return expect(focalstage(*arguments, **options), DONE)


@contextlib.contextmanager
def folder():
    with tempfile.TemporaryDirectory(prefix="focalstage-test-") as name:
        yield pathlib.Path(name)


def free_port():
    with socket.socket() as s:
        s.bind(("127.0.0.1", 0))
        return s.getsockname()[1]


@contextlib.contextmanager
def rig(store, *options):
    """A simulated rig of its own; yields its address."""
    address = f"127.0.0.1:{free_port()}"
    with open(pathlib.Path(store) / "rig.log", "w") as log:
        process = subprocess.Popen([RUNTIME, "--rig", "sim", "--listen", address, "--store", str(pathlib.Path(store) / "rig"),
                                    *options], stdout=log, stderr=subprocess.STDOUT)
    try:
        for _ in range(100):
            asked = focalstage("rig", "state", "--to", address)
            if asked.status == DONE or "rig.unpaired" in asked.err:
                break
            assert process.poll() is None, "the rig ended: " + (pathlib.Path(store) / "rig.log").read_text()
            time.sleep(0.1)
        else:
            raise AssertionError("the rig does not answer")
        yield address
    finally:
        process.send_signal(signal.SIGTERM)
        try:
            process.wait(10)
        except subprocess.TimeoutExpired:
            process.kill()
            raise AssertionError("the rig did not end within 10 s of SIGTERM") from None


def small_project(frames=12, **changes):
    """A project that compiles in milliseconds: a box that turns before a plane, seen by a small projector."""
    project = {
        "focalstage": 1,
        "name": "Small",
        "projectors": [{"name": "main", "width_px": 96, "height_px": 64, "frames_per_second": 2000, "bits": 8,
                        "latency_ms": 0.15, "fx_px": 120, "fy_px": 120, "cx_px": 48, "cy_px": 32,
                        "position_m": [0, 0, 0.2], "rotation_xyzw": [0, 0, 0, 1]}],
        "slices": {"powers_d": [-0.5, 0, 0.5]},
        "frames": {"count": frames, "rate_hz": 60},
        "surfaces": [{"name": "screen", "mesh": {"primitive": "plane", "size_m": [1, 0.8]},
                      "position_m": [0, 0, -0.515], "illumination": 0.2}],
        "objects": [{"name": "box", "mesh": {"primitive": "box", "size_m": [0.1, 0.1, 0.1]},
                     "position_m": [0, 0, -0.515], "appearance": {"unlit": [0.8, 0.8, 0.8]},
                     "keys": [{"time_s": 0, "position_m": [0, 0, -0.515], "rotation_xyzw": [0, 0, 0, 1]},
                              {"time_s": frames / 60, "position_m": [0.05, 0, -0.515],
                               "rotation_xyzw": [0, 0.6, 0, 0.8]}]}],
    }
    project.update(changes)
    return project


def write_project(path, project):
    path = pathlib.Path(path)
    path.mkdir(parents=True, exist_ok=True)
    file = path / (path.name + ".focal")
    file.write_text(json.dumps(project, indent=1))
    return file


def main(tests):
    """Runs the functions of a test file (or those named on the command line), prints one line each."""
    wanted = sys.argv[1:]
    failed = 0
    for test in tests:
        if wanted and test.__name__ not in wanted:
            continue
        started = time.monotonic()
        try:
            note = test()
            print(f"ok    {test.__name__} ({time.monotonic() - started:.1f} s){': ' + note if note else ''}", flush=True)
        except Exception as problem:  # any failure of a test is its report
            failed += 1
            print(f"FAIL  {test.__name__}: {problem}", flush=True)
            if not isinstance(problem, AssertionError):
                traceback.print_exc()
    sys.exit(1 if failed else 0)
