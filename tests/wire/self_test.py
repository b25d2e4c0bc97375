#!/usr/bin/python3
"""A rig measures itself by the command line, says so from then on, and a project takes it over."""

import json

from harness import ENVIRONMENT, USAGE, expect, focalstage, folder, main, rig, succeed


def described(address, at):
    """What adopt-rig would take into a fresh project, as edits."""
    succeed("new", str(at))
    edits = succeed("adopt-rig", str(at), "--to", address, "--dry-run").out
    return [json.loads(line) for line in edits.splitlines()]


def test_a_rig_measures_itself_and_a_project_takes_it_over():
    with folder() as at:
        with rig(at, "--virtual-time") as address:
            found = succeed("rig", "self-test", "--harmonics", "2", "--json", "--to", address).json()
            latency = found["latency_ms"]
            assert abs(latency["value"] - 0.15) < 4 * latency["spread"] < 0.05, latency
            first = found["left"]["lens"][1]
            assert abs(first["gain_d_per_a"]["value"] - 37.063664) < 4 * first["gain_d_per_a"]["spread"], first
            assert abs(first["phase_deg"]["value"] + 14.905518) < 4 * first["phase_deg"]["spread"], first
            assert len(found["right"]["lens"]) == 3
            assert succeed("rig", "state", "--to", address, "--json").json()["state"] == "dark"
            expect(focalstage("rig", "self-test", "--to", address), ENVIRONMENT, "say go first")
            before = described(address, at / "before")
        # The runtime is another one now; what was measured lies in its store.
        with rig(at, "--virtual-time") as address:
            edits = described(address, at / "after")
            assert edits == before
            lens = [edit for edit in edits if edit["key"] == "lens_response"][0]["value"]
            assert lens["left"][1]["gain_d_per_a"] == first["gain_d_per_a"]["value"]
            assert {edit["key"] for edit in edits} >= {"lens_response", "shutter_open_ms", "shutter_close_ms", "latency_ms"}


def test_a_table_for_people_and_nothing_kept_in_a_dry_run():
    with folder() as at, rig(at, "--virtual-time") as address:
        before = described(address, at / "before")
        text = succeed("rig", "self-test", "--harmonics", "1", "--dry-run", "--to", address).out
        for words in ("projector latency", "left shutter opens in", "right lens, harmonic 1, phase", "±", "dry run"):
            assert words in text, text
        assert described(address, at / "after") == before


def test_what_cannot_be_asked():
    with folder() as at, rig(at, "--virtual-time") as address:
        assert focalstage("rig", "self-test", "bow", "--to", address).status == USAGE
        expect(focalstage("rig", "self-test", "--harmonics", "99", "--to", address), ENVIRONMENT, "1 to 24")


if __name__ == "__main__":
    main([test_a_rig_measures_itself_and_a_project_takes_it_over, test_a_table_for_people_and_nothing_kept_in_a_dry_run,
          test_what_cannot_be_asked])
