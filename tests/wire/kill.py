#!/usr/bin/python3
"""kill -9, Ctrl-C and full disks during a compile: no half show, and --resume ends in the same bytes."""

import os
import pathlib
import pty
import random
import re
import select
import signal
import subprocess
import sys
import time

from harness import DONE, ENVIRONMENT, FOCALSTAGE, expect, focalstage, folder, main, small_project, succeed, write_project

KILLS = 100
FRAMES = 160


def compile_command(project, show, *options):
    return [FOCALSTAGE, "compile", str(project), "-o", str(show), *options]


def test_kill_and_resume():
    """Killed at random moments again and again, each compile goes on where the last one fell."""
    seed = random.SystemRandom().randrange(1 << 32)
    dice = random.Random(seed)
    kills = resumed = rounds = 0
    with folder() as at:
        write_project(at / "small", small_project(frames=FRAMES))
        started = time.monotonic()
        succeed("compile", at / "small", "-o", at / "whole.h5", "--threads", "1")
        whole_s = time.monotonic() - started
        whole = (at / "whole.h5").read_bytes()
        show = at / "killed.h5"
        while kills < KILLS:
            process = subprocess.Popen(compile_command(at / "small", show, "--threads", "1", "--resume"),
                                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            try:
                process.wait(dice.uniform(0.0, whole_s))
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()
            if process.returncode == -signal.SIGKILL:
                kills += 1
                # Either no show, or one that is whole.
                if show.exists():
                    assert show.read_bytes() == whole, f"seed {seed}: a half show after kill {kills}"
                continue
            assert process.returncode == DONE, f"seed {seed}: exit {process.returncode} after {kills} kills"
            assert show.read_bytes() == whole, f"seed {seed}: other bytes after {kills} kills"
            rounds += 1
            if (at / "killed.h5.part").exists():
                raise AssertionError(f"seed {seed}: the part is left behind")
            show.unlink()
        ran = succeed("compile", at / "small", "-o", show, "--resume", "--json").json()
        resumed = ran["resumed"]
        assert show.read_bytes() == whole, f"seed {seed}: other bytes after the last kill"
        left = sorted(p.name for p in at.iterdir())
        assert left == ["killed.h5", "small", "whole.h5"], f"seed {seed}: left behind: {left}"
    return f"seed {seed}, {kills} kills, {rounds} finished in between, {resumed} of {FRAMES} frames taken over by the last"


def test_resume_what_is_none():
    """Nothing there, another project's part, other frames of the same one, a finished show: simply compiled."""
    with folder() as at:
        write_project(at / "a", small_project(frames=8))
        write_project(at / "b", small_project(frames=8, slices={"powers_d": [-0.4, 0, 0.4]}))
        for name in ("a", "b"):
            succeed("compile", at / name, "-o", at / f"{name}-whole.h5")
        show = at / "show.h5"
        succeed("compile", at / "a", "-o", show, "--resume")
        assert show.read_bytes() == (at / "a-whole.h5").read_bytes()
        succeed("compile", at / "b", "-o", show, "--resume")  # a finished show of another project
        assert show.read_bytes() == (at / "b-whole.h5").read_bytes()
        stop_early(at / "a", show)
        succeed("compile", at / "b", "-o", show, "--resume")  # another project's part
        assert show.read_bytes() == (at / "b-whole.h5").read_bytes()


def stop_early(project, show):
    """Leaves a part of some frames: a compile that is killed as soon as the part appears."""
    part = pathlib.Path(str(show) + ".part")
    process = subprocess.Popen(compile_command(project, show, "--threads", "1"), stdout=subprocess.DEVNULL,
                               stderr=subprocess.DEVNULL)
    while process.poll() is None and not part.exists():
        time.sleep(0.001)
    process.kill()
    process.wait()


def test_interrupt():
    """Ctrl-C: gone within 200 ms, one line, the old show untouched, and --resume ends in the same bytes."""
    slowest = 0.0
    with folder() as at:
        write_project(at / "small", small_project(frames=4000))
        show = at / "show.h5"
        show.write_bytes(b"an older show")
        for wait_s in (0.05, 0.1, 0.2, 0.3, 0.4):
            process = subprocess.Popen(compile_command(at / "small", show, "--resume"), stdout=subprocess.PIPE,
                                       stderr=subprocess.PIPE, text=True)
            time.sleep(wait_s)
            asked = time.monotonic()
            process.send_signal(signal.SIGINT)
            _, err = process.communicate(timeout=10)
            slowest = max(slowest, time.monotonic() - asked)
            assert process.returncode == -signal.SIGINT, f"exit {process.returncode}: {err}"
            assert show.read_bytes() == b"an older show"
        assert slowest < 0.2 + float(os.environ.get("FOCALSTAGE_SLACK_S", "0.3")), f"{slowest:.3f} s after Ctrl-C"
        assert "--resume" in err, err
    return f"slowest {slowest * 1000:.0f} ms"


def test_progress_bar_on_a_terminal():
    with folder() as at:
        write_project(at / "small", small_project(frames=600))
        leader, follower = pty.openpty()
        process = subprocess.Popen(compile_command(at / "small", at / "x.h5"), stdout=follower, stderr=follower)
        os.close(follower)
        text = b""
        while select.select([leader], [], [], 60)[0]:
            try:
                piece = os.read(leader, 4096)
            except OSError:
                break
            if not piece:
                break
            text += piece
        os.close(leader)
        assert process.wait() == DONE
        shown = text.decode()
        assert re.search(r"Compiling Small  \[#+-*\] +\d+ %  frame \d+ of 600", shown), shown
        assert shown.rstrip().splitlines()[-1].endswith("no findings") or "x.h5:" in shown, shown
        plain = focalstage("compile", at / "small", "-o", at / "y.h5")
        assert "\r" not in plain.err and "\x1b" not in plain.err, plain
        quiet = focalstage("compile", at / "small", "-o", at / "y.h5", "--json")
        assert quiet.err == "" and quiet.out.count("\n") == 1, quiet


def test_disk_full():
    """On a full disk: status 4, the old show whole, nothing taken as whole; with room again, the same bytes."""
    with folder() as at:
        write_project(at / "small", small_project(frames=60))
        succeed("compile", at / "small", "-o", at / "whole.h5")
        disk = at / "disk"
        disk.mkdir()
        size = (at / "whole.h5").stat().st_size
        mounted = subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={max(size // 2, 65536)}", "tmpfs", str(disk)],
                                 capture_output=True)
        if mounted.returncode != 0:
            return "not run: needs root to mount a small tmpfs"
        try:
            expect(focalstage("compile", at / "small", "-o", disk / "x.h5", "--threads", "1"), ENVIRONMENT, "x.h5")
            assert not (disk / "x.h5").exists()
            (disk / "x.h5").write_bytes(b"")
            expect(focalstage("compile", at / "small", "-o", disk / "x.h5", "--resume"), ENVIRONMENT, "x.h5")
            assert (disk / "x.h5").read_bytes() == b""
            subprocess.run(["mount", "-o", f"remount,size={size * 4 + (1 << 20)}", str(disk)], check=True)
            succeed("compile", at / "small", "-o", disk / "x.h5", "--resume")
            assert (disk / "x.h5").read_bytes() == (at / "whole.h5").read_bytes()

            subprocess.run(["mount", "-o", f"remount,size={(disk / 'x.h5').stat().st_size + 8192}", str(disk)], check=True)
            project = disk / "p.focal"
            project.write_bytes((at / "small/small.focal").read_bytes())
            before = project.read_bytes()
            filler = disk / "filler"
            with open(filler, "wb", buffering=0) as out:
                try:
                    while True:
                        out.write(b"x" * 4096)
                except OSError:
                    pass
            edits = at / "e.jsonl"
            edits.write_text('{"edit":"set","list":"objects","name":"box","key":"scale","value":2}\n')
            expect(focalstage("apply", project, edits), ENVIRONMENT, "p.focal")
            assert project.read_bytes() == before, "a failed save changed the project"
        finally:
            subprocess.run(["umount", str(disk)], check=True)


def test_not_writable():
    with folder() as at:
        write_project(at / "small", small_project(frames=1))
        expect(focalstage("compile", at / "small", "-o", at / "none/x.h5"), ENVIRONMENT, "none")
        succeed("compile", at / "small", "-o", at / "x.h5")
        (at / "file").write_text("")
        expect(focalstage("export", at / "x.h5", "-o", at / "file"), ENVIRONMENT, "file")


def test_same_bytes():
    """1 and 2 threads, portable and best instructions, two runs, and the C library's sines for processors without FMA."""
    older = {"GLIBC_TUNABLES": "glibc.cpu.hwcaps=-AVX2,-FMA,-FMA4,-AVX2_Usable,-FMA_Usable"}
    with folder() as at:
        succeed("new", at / "room", "--from", "first-light")
        variants = [(("--threads", "1"), {}), (("--threads", "2"), {}), (("--vectors", "portable"), {}), ((), {}), ((), older)]
        shows = []
        for k, (options, environment) in enumerate(variants):
            succeed("compile", at / "room", "-o", at / f"{k}.h5", "--frames", "3:6", *options, environment=environment)
            shows.append((at / f"{k}.h5").read_bytes())
        assert all(show == shows[0] for show in shows), [len(show) for show in shows]
    return f"{len(variants)} ways, {len(shows[0])} bytes"


def test_memory_of_a_long_show():
    """600 full frames stay under 1 GiB."""
    with folder() as at:
        project = small_project(frames=600)
        project["projectors"][0].update(width_px=1024, height_px=768, fx_px=1280, fy_px=1280, cx_px=512, cy_px=384)
        write_project(at / "long", project)
        process = subprocess.Popen(compile_command(at / "long", at / "long.h5", "--json"), stdout=subprocess.DEVNULL)
        _, status, usage = os.wait4(process.pid, 0)
        assert status == 0, status
        assert usage.ru_maxrss < 1 << 20, f"{usage.ru_maxrss} KiB"
    return f"{usage.ru_maxrss // 1024} MiB"


if __name__ == "__main__":
    sys.dont_write_bytecode = True
    main([test_kill_and_resume, test_resume_what_is_none, test_interrupt, test_progress_bar_on_a_terminal, test_disk_full,
          test_not_writable, test_same_bytes, test_memory_of_a_long_show])
