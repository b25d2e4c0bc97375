#!/usr/bin/python3
"""Pushing under bad luck: damaged shows, killed clients, a killed rig, a second rig on the same port."""

import errno
import json
import os
import random
import shutil
import signal
import subprocess
import time

from harness import (DONE, ENVIRONMENT, FOCALSTAGE, INVALID, RUNTIME, expect, focalstage, folder, free_port, main, rig,
                     small_project, succeed, write_project)

KILLS = 100


def big_show(frames=24):
    """A show of several chunks (about one for 12 frames) that a simulated rig takes."""
    project = small_project(frames=frames, slices={"powers_d": [-1, -0.5, 0, 0.5]})
    project["projectors"][0].update(width_px=1024, height_px=768, fx_px=1280, fy_px=1280, cx_px=512, cy_px=384)
    project["objects"][0].update(mesh={"primitive": "plane", "size_m": [0.3, 0.2]},
                                 appearance={"checker": {"squares": [301, 211], "a": [1, 1, 1], "b": [0.1, 0.1, 0.1]}})
    return project


def compiled(at, address, name="big", project=None):
    write_project(at / name, project or big_show())
    succeed("adopt-rig", at / name, "--to", address)
    ran = focalstage("compile", at / name, "-o", at / f"{name}.h5")
    assert ran.status == DONE, ran
    return at / f"{name}.h5"


def test_damaged_shows_are_refused():
    """A cut or a flipped bit never becomes the rig's show; what plays goes on."""
    dice = random.Random(5)
    with folder() as at, rig(at) as address:
        good = compiled(at, address, "small", small_project(frames=2))
        succeed("push", good, "--to", address, "--activate")
        before = succeed("rig", "play", "--to", address, "--json").json()
        data = good.read_bytes()
        bad = at / "bad.h5"
        for k in range(12):
            damaged = bytearray(data)
            if k % 2:
                damaged, named = damaged[: dice.randrange(512, len(data))], "bytes, its seal says"
            else:
                damaged[dice.randrange(512, len(data) - 32)] ^= 1 << dice.randrange(8)
                named = f"chunk 0 of 1 (bytes 512 to {len(data) - 32})"
            bad.write_bytes(damaged)
            ran = focalstage("push", bad, "--to", address, "--activate")
            assert ran.status in (INVALID, ENVIRONMENT), ran
            expect(ran, ran.status, "bad.h5", named)
        after = succeed("rig", "state", "--to", address, "--json").json()
        assert after["state"] == "playing" and after["show_sha256"] == before["show_sha256"], after


def push_when_free(show, address):
    """Pushes and activates; a client that just died may hold the rig until its lease runs out."""
    deadline = time.monotonic() + 30
    while True:
        ran = focalstage("push", show, "--to", address, "--activate")
        if "rig.held" not in ran.err or time.monotonic() > deadline:
            return ran
        time.sleep(0.5)


def test_killed_pushes():
    """Clients killed at random moments of a push: the rig plays on, the last push brings the show whole."""
    seed = random.SystemRandom().randrange(1 << 32)
    dice = random.Random(seed)
    with folder() as at, rig(at) as address:
        first = compiled(at, address, "small", small_project(frames=2))
        second = compiled(at, address)
        succeed("push", first, "--to", address, "--activate")
        playing = succeed("rig", "play", "--to", address, "--json").json()["show_sha256"]
        started = time.monotonic()
        succeed("push", second, "--to", address)
        whole_s = time.monotonic() - started
        kills = finished = 0
        while kills < KILLS and finished < 3 * KILLS:
            process = subprocess.Popen([FOCALSTAGE, "push", str(second), "--to", address], stdout=subprocess.DEVNULL,
                                       stderr=subprocess.DEVNULL)
            try:
                process.wait(dice.uniform(0.0, whole_s))
                finished += 1
            except subprocess.TimeoutExpired:
                process.send_signal(signal.SIGKILL)
                process.wait()
                kills += 1
        state = succeed("rig", "state", "--to", address, "--json").json()
        assert state["state"] == "playing" and state["show_sha256"] == playing, f"seed {seed}: {state}"
        ran = push_when_free(second, address)
        assert ran.status == DONE, f"seed {seed}: {ran}"
        state = succeed("rig", "state", "--to", address, "--json").json()
        assert state["show_sha256"] != playing, f"seed {seed}: {state}"
    return f"seed {seed}, {second.name}: {kills} kills, {finished} finished"


def test_killed_rigs():
    """A rig killed during pushes forgets at most what had not arrived; nothing half pushed is taken as whole."""
    dice = random.Random(7)
    with folder() as at:
        with rig(at) as address:
            show = compiled(at, address)
        for _ in range(10):
            address = f"127.0.0.1:{free_port()}"
            process = subprocess.Popen([RUNTIME, "--rig", "sim", "--listen", address, "--store", str(at / "rig")],
                                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            client = subprocess.Popen([FOCALSTAGE, "push", str(show), "--to", address, "--activate"],
                                      stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            time.sleep(dice.uniform(0.05, 0.5))
            process.kill()
            process.wait()
            client.wait(60)
        with rig(at) as address:
            succeed("push", show, "--to", address, "--activate")


def test_second_rig_on_the_same_port():
    with folder() as at, rig(at) as address:
        (at / "other").mkdir()
        second = subprocess.run([RUNTIME, "--rig", "sim", "--listen", address, "--store", str(at / "other")],
                                capture_output=True, text=True, timeout=30)
        assert second.returncode == ENVIRONMENT, second
        assert address in second.stderr and second.stderr.count("\n") == 1, second.stderr
        succeed("rig", "state", "--to", address)


def test_interrupted_push():
    """Whenever Ctrl-C comes, the rig is free for the next push at once."""
    with folder() as at, rig(at) as address:
        show = compiled(at, address)
        interrupted = 0
        for k in range(25):
            process = subprocess.Popen([FOCALSTAGE, "push", str(show), "--to", address], stdout=subprocess.PIPE,
                                       stderr=subprocess.PIPE, text=True)
            time.sleep(0.004 * k)
            process.send_signal(signal.SIGINT)
            process.communicate(timeout=10)
            assert process.returncode in (-signal.SIGINT, DONE), process.returncode
            interrupted += process.returncode != DONE
            state = succeed("rig", "state", "--to", address, "--json").json()
            assert state["holder"] == "", f"after {4 * k} ms: {state}"
            shutil.rmtree(at / "rig" / "partial", ignore_errors=True)
            (at / "rig" / "partial").mkdir()
        succeed("push", show, "--to", address, "--activate")
    return f"{interrupted} of 25 interrupted"


def test_full_disk_in_a_push():
    """A full disk ends a push with what is the matter; the rig plays on, and takes the show once there is room."""
    with folder() as at:
        disk = at / "rig"
        disk.mkdir()
        mounted = subprocess.run(["mount", "-t", "tmpfs", "-o", "size=24m", "tmpfs", str(disk)], capture_output=True)
        if mounted.returncode != 0:
            return "not run: needs root to mount a small tmpfs"
        try:
            # So slow that a push is still under way many seconds after its first chunk, however busy this machine is.
            slow = at / "slow.json"
            slow.write_text(json.dumps({"focalstage_rig": 1, "network": {"push_bytes_per_s": 3e5}}))
            with rig(at, "--config", str(slow)) as address:
                small = compiled(at, address, "small", small_project(frames=2))
                show = compiled(at, address, project=big_show(frames=40))
                succeed("push", small, "--to", address, "--activate")
                playing = succeed("rig", "play", "--to", address, "--json").json()["show_sha256"]
                fill = disk / "fill"
                fill_up(disk, fill, 3 << 19)  # a chunk and a half: refused before a byte is sent
                expect(focalstage("push", show, "--to", address), ENVIRONMENT, "the rig's disk is full", str(show))
                fill.unlink()
                err = push_while_disk_fills(show, address, disk, fill)
                assert "the rig's disk is full" in err, err
                state = succeed("rig", "state", "--to", address, "--json").json()
                assert state["state"] == "playing" and state["show_sha256"] == playing, state
                assert len(list((disk / "shows").iterdir())) == 1
                fill.unlink()
                succeed("push", show, "--to", address, "--activate")
                state = succeed("rig", "state", "--to", address, "--json").json()
                assert state["show_sha256"] != playing, state
                return f"a show of {show.stat().st_size / (1 << 20):.1f} chunks"
        finally:
            subprocess.run(["umount", "-l", str(disk)], check=True)


def push_while_disk_fills(show, address, disk, fill):
    """Stops a push after some chunks, takes all room that is left, lets it go on: what it says then."""
    process = subprocess.Popen([FOCALSTAGE, "push", str(show), "--to", address], stdout=subprocess.PIPE,
                               stderr=subprocess.PIPE, text=True)
    while process.poll() is None and not a_chunk_came(disk):
        time.sleep(0.005)
    process.send_signal(signal.SIGSTOP)
    fill_up(disk, fill, 0)
    process.send_signal(signal.SIGCONT)
    out, err = process.communicate(timeout=60)
    assert process.returncode == ENVIRONMENT, (process.returncode, out, err)
    return err


def a_chunk_came(disk):
    try:
        return any(part.stat().st_size > 0 for part in (disk / "partial").glob("*.part"))
    except FileNotFoundError:  # it has just become a show
        return False


def fill_up(disk, path, leave):
    """Takes all room of a small disk but `leave` bytes, page by page: the rig may be taking some of it meanwhile."""
    with open(path, "wb", buffering=0) as f:
        while leave == 0 or os.statvfs(disk).f_bavail * os.statvfs(disk).f_frsize > leave:
            try:
                f.write(bytes(4096))
            except OSError as full:
                assert full.errno == errno.ENOSPC, full
                return


if __name__ == "__main__":
    main([test_damaged_shows_are_refused, test_killed_pushes, test_killed_rigs, test_second_rig_on_the_same_port,
          test_interrupted_push, test_full_disk_in_a_push])
