#!/usr/bin/python3
"""`focalstage calibrate`: a projector measured by picked points, what is refused, and the picture that proves it."""

import json
import math
import struct
import zlib

from harness import INVALID, USAGE, expect, focalstage, folder, main, small_project, succeed, write_project

WIDTH, HEIGHT = 640, 480
FOCAL, CENTRE_U, CENTRE_V = 700.0, 331.0, 236.0
AT = (0.25, 0.4, 0.6)
YAW, PITCH = math.radians(14), math.radians(-21)

PLACES = [(-0.3, -0.1, -0.5), (0.1, 0.25, -0.7), (0.3, -0.15, -0.4), (0.0, 0.0, -0.9), (-0.2, 0.2, -0.8),
          (0.2, 0.1, -0.6), (0.05, -0.2, -0.45), (-0.1, 0.05, -0.35)]


def turned(x, y, z):
    """About X by the pitch, then about Y by the yaw: from the projector's axes to the room's."""
    y, z = math.cos(PITCH) * y - math.sin(PITCH) * z, math.sin(PITCH) * y + math.cos(PITCH) * z
    return math.cos(YAW) * x + math.sin(YAW) * z, y, -math.sin(YAW) * x + math.cos(YAW) * z


def pixel(place):
    off = [a - b for a, b in zip(place, AT)]
    x, y, z = (sum(a * b for a, b in zip(turned(*axis), off)) for axis in ((1, 0, 0), (0, 1, 0), (0, 0, 1)))
    return [CENTRE_U + FOCAL * x / -z, CENTRE_V - FOCAL * y / -z]


def points():
    return [{"name": f"p{i}", "world_m": list(place), "pixel": pixel(place)} for i, place in enumerate(PLACES)]


def project(at, **changes):
    lens = {"name": "main", "width_px": WIDTH, "height_px": HEIGHT, "frames_per_second": 2000, "bits": 8,
            "fx_px": FOCAL, "fy_px": FOCAL, "cx_px": CENTRE_U, "cy_px": CENTRE_V, **changes}
    return write_project(at / "room", small_project(projectors=[lens]))


def write(at, rows, **more):
    file = at / "points.json"
    file.write_text(json.dumps({"points": rows, **more}))
    return file


def gray(path):
    """The rows of an 8-bit gray PNG."""
    data, at, parts = path.read_bytes(), 8, b""
    WIDTH, HEIGHT = struct.unpack(">II", data[16:24])
    while at < len(data):
        size, kind = struct.unpack(">I4s", data[at:at + 8])
        parts += data[at + 8:at + 8 + size] if kind == b"IDAT" else b""
        at += 12 + size
    raw, rows, before = zlib.decompress(parts), [], bytearray(WIDTH)
    for y in range(HEIGHT):
        line = bytearray(raw[y * (WIDTH + 1) + 1:(y + 1) * (WIDTH + 1)])
        how = raw[y * (WIDTH + 1)]
        for x in range(WIDTH):
            left, up, corner = (line[x - 1] if x else 0), before[x], (before[x - 1] if x else 0)
            paeth = min((left, up, corner), key=lambda v: abs(left + up - corner - v))
            line[x] = (line[x] + (0, left, up, (left + up) // 2, paeth)[how]) & 255
        rows.append(line)
        before = line
    return rows


def write_gray(path, rows):
    def chunk(kind, body):
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))

    raw = b"".join(b"\0" + bytes(row) for row in rows)
    head = struct.pack(">IIBBBBB", len(rows[0]), len(rows), 8, 0, 0, 0, 0)
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(raw, 1)) + chunk(b"IEND", b""))


def captured(at):
    """The patterns as a camera that stands where the projector stands sees them on a blotchy wall."""
    project(at, width_px=128, height_px=96, cx_px=64.0, cy_px=48.0)
    succeed("calibrate", "patterns", at / "room", "-o", at / "scan")
    (at / "scan" / "one").mkdir()
    wall = [[0.5 + 0.2 * math.sin(0.31 * x + 0.17 * y) + 0.15 * math.sin(0.23 * y - 0.05 * x) for x in range(128)]
            for y in range(96)]
    for file in sorted((at / "scan").glob("[0-9]*.png")):
        rows = gray(file)
        write_gray(at / "scan" / "one" / file.name,
                   [[int(8 + 0.9 * code * white) for code, white in zip(row, blotches)] for row, blotches in zip(rows, wall)])
    return at / "scan"


def write_scan(folder, **changes):
    scan = {"board": {"squares": [9, 7], "square_m": 0.05, "marker_m": 0.03}, "captures": [{"folder": "one"}],
            "world": {"capture": "one", "position_m": [0, 0, -1]}, **changes}
    (folder / "scan.json").write_text(json.dumps(scan))


def test_patterns_are_pictures_and_a_manifest():
    with folder() as at:
        project(at, width_px=128, height_px=96, cx_px=64.0, cy_px=48.0)
        out = succeed("calibrate", "patterns", at / "room", "-o", at / "scan").out
        manifest = json.loads((at / "scan" / "patterns.json").read_text())
        names = [path.name for path in sorted((at / "scan").glob("[0-9]*.png"))]
        assert names == manifest["pictures"] and f"{len(names)} patterns of 128 x 96" in out, (names, out)
        assert all(code == 255 for row in gray(at / "scan" / "00-white.png") for code in row)
        stripes = gray(at / "scan" / "02-columns-code-0.png")
        assert [stripes[50][x] for x in (0, 63, 64, 127)] == [0, 0, 255, 255]
        assert (at / "scan" / "board.png").exists()
        expect(focalstage("calibrate", "patterns", at / "room", "-o", at / "x", "--stripe-px", 8), INVALID, "stripes.set")
        expect(focalstage("calibrate", "patterns", at / "room", "-o", at / "x", "--steps", 99), USAGE)


def test_captures_that_lie_are_refused_by_their_pictures():
    with folder() as at:
        scan = captured(at)
        one = scan / "one"
        project_text = (at / "room" / "room.focal").read_bytes()

        def refused(*words):
            expect(focalstage("calibrate", "scan", scan, at / "room"), INVALID, *words)

        refused("scan.json")
        write_scan(scan, world={"capture": "two", "position_m": [0, 0, -1]})
        refused("scan.file", "/world/capture", "two")
        write_scan(scan, world={"capture": "one"})
        refused("scan.file", "/world", "marks")
        write_scan(scan, captures=[{"folder": "one", "board": True}])
        refused("board.unseen", "one", "00-white.png")
        write_scan(scan, world={"capture": "one", "marks": [{"pixel": [3, 4], "world_m": [0, 0, -1]}]})
        refused("scan.few")
        kept = {path.name: path.read_bytes() for path in one.iterdir()}

        def spoilt(name, rows, *words):
            write_gray(one / name, rows)
            refused(*words, name)
            (one / name).write_bytes(kept[name])

        a, b = "04-columns-code-1.png", "08-columns-code-3.png"
        (one / a).write_bytes(kept[b])
        (one / b).write_bytes(kept[a])
        refused("capture.order", a, b)
        (one / a).write_bytes(kept[a])
        (one / b).write_bytes(kept[b])
        rows = gray(one / a)
        spoilt(a, [row[::-1] for row in rows[::-1]], "capture.turned")
        spoilt(a, [list(column) for column in zip(*rows)], "capture.size")
        white = gray(one / "00-white.png")
        spoilt("00-white.png", [[min(255, 3 * code) for code in row] for row in white], "capture.over-exposed")
        spoilt("00-white.png", [[8] * 128 for row in white], "capture.dark")
        again = [name for name in kept if "white-again" in name][0]
        spoilt(again, [[row[0], *row[:-1]] for row in white], "capture.moved")
        (one / a).write_bytes(kept[a][:200])
        refused(a)
        (one / a).unlink()
        refused("capture.missing", "04-columns-code-1")
        assert (at / "room" / "room.focal").read_bytes() == project_text


def test_points_become_the_projectors_pose():
    with folder() as at:
        file = project(at)
        outcome = succeed("calibrate", "points", write(at, points()), at / "room", "--json").json()
        assert outcome["applied"] and outcome["worst_px"] < 1e-6 and outcome["left_out_median_px"] < 1e-5, outcome
        saved = json.loads(file.read_text())["projectors"][0]
        assert all(abs(a - b) < 1e-6 for a, b in zip(saved["position_m"], AT)), saved
        turn = (math.sin(PITCH / 2) * math.cos(YAW / 2), math.cos(PITCH / 2) * math.sin(YAW / 2),
                -math.sin(PITCH / 2) * math.sin(YAW / 2), math.cos(PITCH / 2) * math.cos(YAW / 2))
        sign = 1 if saved["rotation_xyzw"][3] > 0 else -1
        assert all(abs(a - sign * b) < 1e-7 for a, b in zip(saved["rotation_xyzw"], turn)), (saved, turn)
        assert saved["fx_px"] == FOCAL and saved["latency_ms"] == 0
        words = succeed("calibrate", "points", at / "points.json", at / "room", "--dry-run", "--picture", at / "p.png").out
        assert "median 0.000 px" in words and "coverage" in words and "one standard deviation" in words, words
        assert (at / "p.png").read_bytes()[:4] == b"\x89PNG"


def test_the_lens_comes_out_where_asked():
    with folder() as at:
        file = project(at, fx_px=1100.0, fy_px=1100.0, cx_px=320.0, cy_px=240.0)
        succeed("calibrate", "points", write(at, points()), at / "room", "--solve", "centre", "-o", at / "new")
        saved = json.loads((at / "new" / "new.focal").read_text())["projectors"][0]
        assert abs(saved["fx_px"] - FOCAL) < 1e-3 and abs(saved["cx_px"] - CENTRE_U) < 1e-3, saved
        assert json.loads(file.read_text())["projectors"][0]["fx_px"] == 1100.0


def test_a_bad_fit_is_applied_only_deliberately():
    with folder() as at:
        file = project(at)
        before = file.read_bytes()
        rows = points()
        for i, row in enumerate(rows):
            row["pixel"] = [row["pixel"][0] + 3.0 * math.cos(2.3 * i), row["pixel"][1] + 3.0 * math.sin(2.3 * i)]
        write(at, rows)
        expect(focalstage("calibrate", "points", at / "points.json", at / "room"), INVALID, "calibrate.limit",
               "points.json: point", "--despite-residual")
        assert file.read_bytes() == before
        outcome = succeed("calibrate", "points", at / "points.json", at / "room", "--despite-residual", "--json").json()
        assert outcome["median_px"] > 1 and file.read_bytes() != before
        succeed("calibrate", "points", at / "points.json", at / "room", "--limit-px", 30)


def test_refusals_name_file_and_point_and_change_nothing():
    with folder() as at:
        file = project(at)
        before = file.read_bytes()

        def refused(rows, *words, **more):
            expect(focalstage("calibrate", "points", write(at, rows, **more), at / "room"), INVALID, "points.json", *words)

        refused(points()[:5], "points.few", "5 points")
        rows = points()
        rows[3]["pixel"][0] += 25
        refused(rows, "points.lying", "point 4 (p3)")
        rows = points()
        rows[3]["pixel"], rows[6]["pixel"] = rows[6]["pixel"], rows[3]["pixel"]
        refused(rows, "points.exchanged", "points 4 (p3), 7 (p6)")
        rows = points()
        rows[5]["pixel"][1] = 481
        refused(rows, "points.outside", "point 6 (p5)", "640 x 480")
        refused([{**row, "world_m": [-v for v in row["world_m"]]} for row in points()], "points.mirrored")
        refused([{**row, "world_m": [row["world_m"][0], 0, -1]} for row in points()], "points.")
        rows = points()
        rows[2]["world_m"] = [0, "a", 1]
        refused(rows, "points.file", "/points/2/world_m/1")
        del rows[2]["world_m"]
        refused(rows, "points.file", "/points/2", "world_m")
        (at / "points.json").write_text('{"points": [{"world_m": [0, 0, NaN]')
        expect(focalstage("calibrate", "points", at / "points.json", at / "room"), INVALID, "points.json", "line 1")
        refused_name = focalstage("calibrate", "points", write(at, points(), projector="side"), at / "room")
        expect(refused_name, INVALID, "calibrate.projector", "side", "main")
        expect(focalstage("calibrate", "points", at / "none.json", at / "room"), INVALID)
        expect(focalstage("calibrate", "points", at / "points.json"), USAGE)
        expect(focalstage("calibrate", "points", at / "points.json", at / "room", "--limit-px", 0), USAGE)
        expect(focalstage("calibrate"), USAGE)
        assert file.read_bytes() == before


def test_verify_draws_the_models_edges_where_they_stand():
    with folder() as at:
        project(at)
        succeed("calibrate", "points", write(at, points()), at / "room")
        assert "4 edges" in succeed("calibrate", "verify", at / "room", "-o", at / "verify.png").out
        rows = gray(at / "verify.png")
        # The screen of the small project: 1 m x 0.8 m about (0, 0, -0.515).
        corners = [(-0.5, -0.4), (0.5, -0.4), (0.5, 0.4), (-0.5, 0.4)]
        checked = 0
        for (ax, ay), (bx, by) in zip(corners, corners[1:] + corners[:1]):
            for i in range(1, 20):
                u, v = pixel((ax + (bx - ax) * i / 20, ay + (by - ay) * i / 20, -0.515))
                if 1 <= u < WIDTH - 1 and 1 <= v < HEIGHT - 1:
                    assert rows[int(v)][int(u)] > 60, (u, v)
                    checked += 1
        assert checked >= 20, checked
        lit = sum(1 for row in rows for code in row if code)
        assert 0 < lit < 0.05 * WIDTH * HEIGHT, lit


if __name__ == "__main__":
    main([test_patterns_are_pictures_and_a_manifest, test_captures_that_lie_are_refused_by_their_pictures,
          test_points_become_the_projectors_pose, test_the_lens_comes_out_where_asked,
          test_a_bad_fit_is_applied_only_deliberately, test_refusals_name_file_and_point_and_change_nothing,
          test_verify_draws_the_models_edges_where_they_stand])
