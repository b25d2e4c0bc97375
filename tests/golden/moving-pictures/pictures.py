#!/usr/bin/python3
"""The pictures of the sample moving-pictures: as formulas, which tests/golden/derive.py takes for the truth, and as the
PNG files that the sample shows, packed by hand. Neither is read from the other.

    pictures.py write      writes them into projects/moving-pictures/pictures
    pictures.py check      for ctest: the files are what this would write

    wedge.png       16 bits, gray: 128 levels of which 8 bits hold five
    flame_01..06    8 bits, gray: a bar that climbs and brightens
    leaf.png        8 bits, gray and alpha: a disc, clear around it
"""

import pathlib
import struct
import sys
import zlib

FOLDER = pathlib.Path(__file__).resolve().parents[3] / "projects/moving-pictures/pictures"
FLAMES = 6


def wedge(x, y):
    return (40000 + 8 * (x + 64 * y)) / 65535, 1.0


def flame(number):
    def at(x, y):
        height = 15 - y  # from below
        return (100 + 25 * number if height // 2 == number else 40) / 255, 1.0

    return at


def leaf(x, y):
    inside = (x - 7.5) ** 2 + (y - 7.5) ** 2 < 42
    return (220 - 6 * y) / 255, 1.0 if inside else 0.0


# name: width, height, bits of a number, channels, formula
PICTURES = {"wedge.png": (64, 2, 16, 1, wedge), "leaf.png": (16, 16, 8, 2, leaf),
            **{f"flame_{k:02}.png": (16, 16, 8, 1, flame(k)) for k in range(1, FLAMES + 1)}}


def texel(file, u, v):
    """Number (0 to 1) and alpha of the pixel that (u, v) falls in; u = v = 0 is the lower left corner."""
    width, height, _, _, formula = PICTURES[pathlib.Path(file).name]
    return formula(min(int(u * width), width - 1), min(int((1 - v) * height), height - 1))


def chunk(name, data):
    return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))


def png(width, height, bits, channels, formula):
    full = 2 ** bits - 1
    kind = ">H" if bits == 16 else ">B"
    rows = b"".join(b"\0" + b"".join(b"".join(struct.pack(kind, round(full * share)) for share in formula(x, y)[:channels])
                                     for x in range(width)) for y in range(height))
    head = struct.pack(">IIBBBBB", width, height, bits, {1: 0, 2: 4}[channels], 0, 0, 0)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(rows, 0)) + chunk(b"IEND", b""))


def main():
    bad = []
    for name, how in PICTURES.items():
        if sys.argv[1:] == ["write"]:
            (FOLDER / name).write_bytes(png(*how))
        elif (FOLDER / name).read_bytes() != png(*how):
            bad.append(name)
    if bad:
        raise SystemExit(f"not what their formulas say: {', '.join(bad)}")


if __name__ == "__main__":
    main()
