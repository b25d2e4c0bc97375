#!/usr/bin/python3
"""`focalstage track-align`: a tracker set up by hand-made pairs, and what is refused."""

import math

from harness import INVALID, USAGE, expect, focalstage, folder, main, succeed

HEAD = "name,tracker_x_m,tracker_y_m,tracker_z_m,world_x_m,world_y_m,world_z_m\n"
POINTS = [(0, 0, 0), (1, 0.1, 0), (0.1, 0.9, 0.2), (-0.3, 0.4, 1.1), (0.7, -0.5, -0.8), (-0.9, 0.2, -0.4)]
ANGLE = math.radians(30)


def moved(p):
    """A turn by 30 degrees about Y, then a step."""
    x, y, z = p
    return (math.cos(ANGLE) * x + math.sin(ANGLE) * z + 0.5, y + 1.2, -math.sin(ANGLE) * x + math.cos(ANGLE) * z - 2)


def write(path, pairs, head=HEAD):
    rows = [f"p{i}," + ",".join(repr(v) for v in (*a, *b)) for i, (a, b) in enumerate(pairs)]
    path.write_text(head + "\n".join(rows) + "\n")
    return path


def exact():
    return [(p, moved(p)) for p in POINTS]


def test_the_transform_comes_out():
    with folder() as at:
        outcome = succeed("track-align", write(at / "pairs.csv", exact(), "# by hand\n" + HEAD), "--json").json()
        pose = outcome["world_from_tracker"]
        assert all(abs(a - b) < 1e-9 for a, b in zip(pose["position_m"], (0.5, 1.2, -2)))
        turn = (0, math.sin(ANGLE / 2), 0, math.cos(ANGLE / 2))
        assert all(abs(a - b) < 1e-9 for a, b in zip(pose["rotation_xyzw"], turn)), pose
        assert outcome["rms_mm"] < 1e-6 and len(outcome["pairs"]) == 6
        words = succeed("track-align", at / "pairs.csv").out
        assert "--tracker-pose 0.500000 1.200000 -2.000000 0.00000000 0.25881905 0.00000000 0.96592583" in words, words


def test_a_bad_fit_is_refused_unless_forced():
    with folder() as at:
        shaken = [(p, tuple(v + 0.004 * (-1) ** (i + k) for k, v in enumerate(w))) for i, (p, w) in enumerate(exact())]
        file = write(at / "pairs.csv", shaken)
        expect(focalstage("track-align", file), INVALID, "align.limit", "--force")
        outcome = succeed("track-align", file, "--force", "--json").json()
        assert outcome["rms_mm"] > 2 and outcome["worst_mm"] >= outcome["rms_mm"]
        assert abs(math.sqrt(sum(p["residual_mm"] ** 2 for p in outcome["pairs"]) / 6) - outcome["rms_mm"]) < 1e-9
        assert succeed("track-align", file, "--limit-mm", 20, "--json").json() == outcome


def test_refusals_name_the_place():
    with folder() as at:
        lying = exact()
        lying[3] = (lying[3][0], tuple(v + 0.1 for v in lying[3][1]))
        expect(focalstage("track-align", write(at / "lie.csv", lying)), INVALID, "align.pair-off", "pair 4 (p3)")
        mirrored = [((-x, y, z), w) for (x, y, z), w in exact()]
        expect(focalstage("track-align", write(at / "mirror.csv", mirrored), "--force"), INVALID, "align.mirrored")
        expect(focalstage("track-align", write(at / "few.csv", exact()[:2])), INVALID, "align.few")
        expect(focalstage("track-align", write(at / "head.csv", exact(), "")), INVALID, "line 1", "align.file")
        (at / "words.csv").write_text(HEAD + "a,1,2,3,4,5,six\n")
        expect(focalstage("track-align", at / "words.csv"), INVALID, "line 2", "align.file")
        expect(focalstage("track-align", at / "none.csv"), INVALID)
        expect(focalstage("track-align"), USAGE)
        expect(focalstage("track-align", at / "lie.csv", "--limit-mm", -1), USAGE)


if __name__ == "__main__":
    main([test_the_transform_comes_out, test_a_bad_fit_is_refused_unless_forced, test_refusals_name_the_place])
