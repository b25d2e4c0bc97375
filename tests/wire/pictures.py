#!/usr/bin/python3
"""Pictures and sequences of them on objects, from their files to the rig; and what is wrong with some."""

import hashlib
import shutil
import struct
import time
import zlib

import h5py

from harness import INVALID, expect, focalstage, folder, main, rig, small_project, succeed, write_project


def chunk(name, data):
    return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))


def png(width, height, rows, bits=8, colour=0):
    head = struct.pack(">IIBBBBB", width, height, bits, colour, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b"")


def even(gray, width=4, height=4):
    return png(width, height, (b"\0" + bytes([gray]) * width) * height)


def showing(image, frames=8):
    """A small project whose one object, on the screen itself, looks like the picture."""
    project = small_project(frames=frames)
    project["frames"]["rate_hz"] = 20
    project["objects"] = [{"name": "card", "mesh": {"primitive": "plane", "size_m": [0.2, 0.15]},
                           "position_m": [0, 0, -0.515], "appearance": {"image": image}}]
    return project


def code(gray):
    """What a picture's gray comes to in an image of full weight, with the surface's own light of 0.2."""
    share = gray / 255
    linear = share / 12.92 if share <= 0.04045 else ((share + 0.055) / 1.055) ** 2.4
    return round(255 * min(1, linear + 0.2))


def test_a_sequence_from_its_files_to_the_rig():
    grays = [60, 110, 160, 210]
    with folder() as at, rig(at) as address:
        image = {"file": "frames/card_##.png", "count": 4, "first": 7, "rate_hz": 10, "start_s": 0.05, "loop": "hold",
                 "color_space": "srgb"}
        write_project(at / "show", showing(image, frames=12))
        (at / "show/frames").mkdir()
        for k, gray in enumerate(grays):
            (at / f"show/frames/card_{k + 7:02}.png").write_bytes(even(gray))
        succeed("adopt-rig", at / "show", "--to", address)
        succeed("compile", at / "show", "-o", at / "show.h5")
        with h5py.File(at / "show.h5") as show:
            paths = {name: data.attrs["path"] for name, data in show["asset"].items()}
            for k, gray in enumerate(grays):
                assert paths[hashlib.sha256(even(gray)).hexdigest()] == f"frames/card_{k + 7:02}.png", paths
            images, powers = show["projector/0/images"], show["projector/0/image/power_d"][:]
            zero = [i for i, power in enumerate(powers) if power == 0][0]
            middle = [int(images[k, zero, 32, 48]) for k in range(12)]
        # Frame k shows t = k / 20; a picture stands for two frames, the first one of them from frame 1 on.
        wanted = [code(grays[min(max(k - 1, 0) // 2, 3)]) for k in range(12)]
        assert middle == wanted, (middle, wanted)

        # Nothing beside the show is read any more.
        checked = focalstage("check", at / "show", "--json").json()
        shutil.rmtree(at / "show")
        assert focalstage("check", at / "show.h5", "--json").json() == checked
        succeed("push", at / "show.h5", "--to", address, "--activate")
        succeed("rig", "play", "--to", address)
        time.sleep(0.5)
        state = succeed("rig", "state", "--to", address, "--json").json()
        assert state["state"] == "playing" and all(slot["delivered"] for slot in state["slots"]), state


def test_once_is_not_there_before_and_after():
    with folder() as at:
        write_project(at / "show", showing({"file": "a#.png", "count": 2, "rate_hz": 20, "start_s": 0.1, "loop": "once"}))
        for k in (1, 2):
            (at / f"show/a{k}.png").write_bytes(even(200))
        succeed("compile", at / "show", "-o", at / "show.h5")
        with h5py.File(at / "show.h5") as show:
            zero = list(show["projector/0/image/power_d"][:]).index(0)
            middle = [int(show["projector/0/images"][k, zero, 32, 48]) for k in range(8)]
        assert middle == [51, 51, code(200), code(200), 51, 51, 51, 51], middle


def test_what_cannot_be_shown_is_named():
    with folder() as at:
        def refused(name, content, *said, image=None):
            path = at / name
            write_project(path, showing(image or {"file": "card.png"}))
            for file, data in content.items():
                (path / file).write_bytes(data)
            started = time.monotonic()
            ran = focalstage("compile", path, "-o", at / "x.h5")
            assert time.monotonic() - started < 3, f"{name}: it took too long"
            expect(ran, INVALID, *said)
            assert not (at / "x.h5").exists()

        whole = even(99, 64, 64)
        numbered = {"file": "n_##.png", "count": 3, "rate_hz": 24}
        refused("missing", {"n_01.png": whole, "n_03.png": whole}, "n_02.png", "picture 2 of 3", image=numbered)
        refused("sizes", {"n_01.png": whole, "n_02.png": whole, "n_03.png": even(1, 5, 5)}, "n_03.png has 5 x 5",
                image=numbered)
        refused("cut", {"card.png": whole[:-30]}, "card.png", "image.invalid")
        refused("noise", {"card.png": b"GIF89a" + whole}, "card.png", "image.unsupported")
        big = bytearray(even(1))
        big[16:24] = struct.pack(">II", 16385, 1)
        big[29:33] = struct.pack(">I", zlib.crc32(bytes(big[12:29])))
        refused("wide", {"card.png": bytes(big)}, "card.png", "16385 x 1")
        huge = bytearray(even(1))
        huge[16:24] = struct.pack(">II", 16384, 16384)
        huge[29:33] = struct.pack(">I", zlib.crc32(bytes(huge[12:29])))
        refused("huge", {"card.png": bytes(huge)}, "card.png", "image.")
        damaged = bytearray(whole)
        damaged[60] ^= 0x5A
        refused("damaged", {"card.png": bytes(damaged)}, "card.png", "image.invalid")
        refused("outside", {}, "path.outside", image={"file": "../card.png"})
        refused("norate", {}, "rate_hz", image={"file": "n_##.png", "count": 3})
        refused("noplace", {}, "#", image={"file": "n.png", "count": 3, "rate_hz": 24})


if __name__ == "__main__":
    main([test_a_sequence_from_its_files_to_the_rig, test_once_is_not_there_before_and_after,
          test_what_cannot_be_shown_is_named])
