#!/usr/bin/python3
"""Projector models as a user adds them: beside a project, in the configuration, broken, and not at all."""

import json

from harness import DONE, FINDINGS, INVALID, expect, focalstage, folder, main, small_project, succeed, write_project


def bench(**changes):
    return {"focalstage_projector_model": 1, "name": "bench", "width_px": 96, "height_px": 64,
            "depths": [{"bits": 8, "frames_per_second": 2500}], **changes}


def write_model(file, model):
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text(model if isinstance(model, str) else json.dumps(model))


def bench_project(at, **projector):
    project = small_project(frames=1)
    project["projectors"][0].update(model="bench", **projector)
    return write_project(at, project)


def codes(ran):
    return [finding["code"] for finding in ran.json()["findings"]]


def test_unknown_until_described():
    with folder() as at:
        project = bench_project(at / "show", frames_per_second=3000)
        configuration = {"XDG_CONFIG_HOME": str(at / "config")}
        found = expect(focalstage("check", project, "--json", environment=configuration), DONE)
        assert codes(found) == ["projector.unknown-model"], found
        message = found.json()["findings"][0]["message"]
        assert "models/bench.json" in message and "dynaflash" in message, message
        # The user's own, then the project's, which is slower.
        write_model(at / "config/focalstage/models/bench.json", bench(depths=[{"bits": 8, "frames_per_second": 4000}]))
        assert codes(expect(focalstage("check", project, "--json", environment=configuration), DONE)) == []
        write_model(at / "show/models/bench.json", bench())
        found = expect(focalstage("check", project, "--json", environment=configuration), FINDINGS)
        assert codes(found) == ["schedule.bit-depth"], found
        assert found.json()["findings"][0]["amount"]["limit"] == 2500, found
        # A show is judged by what the user knows; what compiling found is the project's.
        expect(focalstage("compile", project, "-o", at / "s.h5", environment=configuration), FINDINGS)
        expect(focalstage("check", at / "s.h5", environment=configuration), DONE)
        # The remedy, applied elsewhere, takes the model along.
        edits = at / "edits.jsonl"
        edits.write_text("".join(json.dumps(edit) + "\n" for edit in found.json()["findings"][0]["remedy"]))
        succeed("apply", project, edits, "-o", at / "mended")
        assert (at / "mended/models/bench.json").read_bytes() == (at / "show/models/bench.json").read_bytes()
        assert codes(succeed("check", at / "mended", "--json")) == []


def test_broken_models():
    with folder() as at:
        project = bench_project(at / "show")
        file = at / "show/models/bench.json"
        cases = [("{", "bench.json"), ("[]", "bench.json"), (bench(depths=[]), "/depths"), (bench(colour=1), "colour"),
                 (bench(width_px=0), "/width_px"), (bench(clock="sundial"), "/clock"),
                 (bench(depths=[{"bits": 8}]), "/depths/0"),
                 (bench(depths=[{"bits": 8, "frames_per_second": 1}, {"bits": 1, "frames_per_second": 2}]), "/depths/1/bits")]
        for model, word in cases:
            write_model(file, model)
            for command in (["check", project], ["solve", project], ["compile", project, "-o", at / "s.h5"]):
                expect(focalstage(*command), INVALID, "bench.json", word)
        write_model(file, bench())
        write_model(at / "show/models/other.json", bench())
        expect(focalstage("check", project), INVALID, "other.json", "/name", "bench")
        assert not (at / "s.h5").exists()


def test_diamond_lattice():
    with folder() as at:
        project = bench_project(at / "show", pixel_layout="diamond", height_px=128, fy_px=240, cy_px=64)
        write_model(at / "show/models/bench.json", bench(height_px=128, pixel_layout="diamond"))
        assert codes(expect(focalstage("check", project, "--json"), DONE)) == []
        succeed("compile", project, "-o", at / "diamond.h5")
        succeed("compile", project, "--reference", "-o", at / "reference.h5")
        for name in ("diamond", "reference"):
            succeed("export", at / f"{name}.h5", "-o", at / name)
            succeed("retina", at / f"{name}.h5", "--eye", "left", "--focus-m", "0.5", "--size", "80x60", "-o",
                    at / f"{name}.png")
        write_model(at / "show/models/bench.json", bench(height_px=128))
        assert codes(expect(focalstage("check", project, "--json"), DONE)) == ["projector.pixel-layout"]
        bench_project(at / "odd", pixel_layout="hexagon")
        expect(focalstage("check", at / "odd"), INVALID, "/projectors/0/pixel_layout", "hexagon", "diamond")


if __name__ == "__main__":
    main([test_unknown_until_described, test_broken_models, test_diamond_lattice])
