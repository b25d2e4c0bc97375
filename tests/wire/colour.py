#!/usr/bin/python3
"""Painted surfaces through the command line: findings and their remedy, the clip map, contrast, what the eye sees."""

import json
import struct
import zlib

from first_light import png16
from harness import focalstage, folder, main, small_project, succeed, write_project


def png8(path):
    """Width, height and the bytes of an 8-bit RGB PNG, whatever its filters."""
    data, at, packed = path.read_bytes(), 8, b""
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at:at + 8])
        body = data[at + 8:at + 8 + length]
        if kind == b"IHDR":
            width, height, bits, colour = struct.unpack(">IIBB", body[:10])
            assert (bits, colour) == (8, 2), (bits, colour)
        packed += body if kind == b"IDAT" else b""
        at += 12 + length
    raw, stride, rows, before = zlib.decompress(packed), 3 * width, [], bytes(3 * width)
    for y in range(height):
        how, row = raw[y * (stride + 1)], bytearray(raw[y * (stride + 1) + 1:(y + 1) * (stride + 1)])
        for i in range(stride):
            left, up = row[i - 3] if i > 2 else 0, before[i]
            corner = before[i - 3] if i > 2 else 0
            guess = left + up - corner
            paeth = min((left, up, corner), key=lambda one: abs(guess - one))
            row[i] = (row[i] + (0, left, up, (left + up) // 2, paeth)[how]) & 255
        rows.append(bytes(row))
        before = row
    return width, height, rows


def painted():
    project = small_project(frames=1)
    project["surfaces"][0].update(albedo=[0.5, 0.5, 0.5], illumination=0)
    for thing in project["objects"]:
        thing.update(appearance={"unlit": [1, 1, 1]}, depth={"mode": "slice", "index": 1})
    project["slices"]["compensation"] = {"mode": "albedo", "white": 1}
    return project


def test_what_cannot_be_reached_is_said_drawn_and_mended():
    with folder() as at:
        project = painted()
        write_project(at / "paint", project)
        show = at / "paint.h5"
        said = focalstage("compile", at / "paint", "-o", show, "--json").json()
        clipped = [f for f in said["findings"] if f["code"] == "light.clipped"]
        assert len(clipped) == 1 and clipped[0]["where"] == "/surfaces/0", said
        assert "up to 2 times" in clipped[0]["message"], clipped
        assert focalstage("check", show, "--json").json()["findings"] == said["findings"], "the show says otherwise"

        succeed("export", show, "-o", at / "out", "--clipped")
        width, height, rows = png8(at / "out/frame-0000-clipped.png")
        projector = project["projectors"][0]
        assert (width, height) == (projector["width_px"], projector["height_px"])
        red = [row[3 * x] for row in rows for x in range(width)]
        blue = [row[3 * x + 2] for row in rows for x in range(width)]
        assert max(red) == 64 + round(191 / 2) and 0 in red, set(red)  # half of what is wanted is missing
        assert max(blue) == 0

        remedy = at / "remedy.jsonl"
        remedy.write_text("".join(json.dumps(edit) + "\n" for edit in clipped[0]["remedy"]))
        succeed("apply", at / "paint", remedy)
        left = focalstage("check", at / "paint", "--json").json()["findings"]
        assert not [f for f in left if f["code"] == "light.clipped"], left
        succeed("compile", at / "paint", "-o", show)
        succeed("export", show, "-o", at / "out", "--clipped")
        assert not any(any(row) for row in png8(at / "out/frame-0000-clipped.png")[2])


def test_contrast_is_told():
    with folder() as at:
        project = painted()
        project["surfaces"][0]["albedo"] = [1, 1, 1]
        project["projectors"][0].update(black_level=0.01, lumens=300)
        project["ambient_lux"] = 1
        write_project(at / "room", project)
        told = focalstage("check", at / "room", "--json").json()["contrast"]
        assert len(told) == 1 and told[0]["surface"] == project["surfaces"][0]["name"], told
        exposures = len(project["slices"]["powers_d"])
        assert told[0]["exposures"] == exposures and abs(told[0]["leak"] - 0.01 * exposures) < 1e-6, told
        assert abs(told[0]["contrast"] - told[0]["white"] / (told[0]["leak"] + told[0]["ambient"])) < 1e-6, told
        text = focalstage("check", at / "room").out
        assert "White against black" in text, text
        del project["projectors"][0]["lumens"]
        write_project(at / "unknown", project)
        said = focalstage("check", at / "unknown", "--json").json()
        assert said["contrast"][0]["ambient"] is None and said["contrast"][0]["contrast"] is None, said
        assert "light.ambient-unknown" in [f["code"] for f in said["findings"]], said


def test_the_eye_sees_the_leak_of_every_exposure():
    with folder() as at:
        project = painted()
        project["objects"] = []
        project["projectors"][0]["black_level"] = 0.02
        write_project(at / "dark", project)
        succeed("compile", at / "dark", "-o", at / "dark.h5")
        succeed("retina", at / "dark.h5", "--eye", "left", "--focus-m", "0.5", "--size", "80x60", "--fov-deg", "10", "-o", at / "eye.png")
        wanted = 65535 * 0.5 * 0.02 * len(project["slices"]["powers_d"])
        rows = png16(at / "eye.png")
        values = [value for row in rows[20:40] for value in row[30:50]]
        assert all(abs(v - wanted) < 0.02 * wanted for v in values), (wanted, min(values), max(values))


if __name__ == "__main__":
    main([test_what_cannot_be_reached_is_said_drawn_and_mended, test_contrast_is_told,
          test_the_eye_sees_the_leak_of_every_exposure])
