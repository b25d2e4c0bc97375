"""The bench all experiments work at: it runs `focalstage` and nothing else, and keeps what they found."""

import dataclasses
import json
import os
import pathlib
import subprocess
import tempfile

import matplotlib

matplotlib.use("Agg")
import matplotlib.image
import numpy

ROOT = pathlib.Path(__file__).resolve().parents[2]

# A lens that stands still at 0 D and one image per eye: projection as it is without a sweep. The 0.01 D are there
# because a sweep has to have a width.
CONVENTIONAL = [("slices", "powers_d", [0]), ("sweep", "min_power_d", -0.01), ("sweep", "max_power_d", 0.01)]


@dataclasses.dataclass
class Claim:
    """A sentence that holds, or does not."""

    text: str
    holds: bool
    found: str


@dataclasses.dataclass
class Table:
    """Rows for the page; `head` names the columns with their units."""

    name: str
    head: list
    rows: list


class Lab:
    def __init__(self, folder, quick):
        self.folder, self.quick = pathlib.Path(folder), quick
        self.folder.mkdir(parents=True, exist_ok=True)
        bin_folder = pathlib.Path(os.environ.get("FOCALSTAGE_BIN", ROOT / "build/release/bin"))
        self.program = str(bin_folder.resolve() / "focalstage")
        self.scratch = tempfile.TemporaryDirectory(prefix="look-", dir=self.folder)  # goes when the bench does
        self.tables, self.claims, self.figures = [], [], []

    def run(self, *arguments, also=()):
        """Runs focalstage; an exit status that is neither 0 nor in `also` ends everything."""
        done = subprocess.run([self.program, *map(str, arguments)], capture_output=True, text=True)
        if done.returncode not in (0, *also):
            raise SystemExit(f"scripts/experiments: focalstage {' '.join(map(str, arguments))}: exit {done.returncode}\n{done.stderr}")
        return done.stdout

    def show(self, name, project, edits=()):
        """A sample of projects/, edited, compiled; findings of severity error are let pass, for what breaks a rule on
        purpose is compiled too. `edits`: (list, key, value) or (list, name, key, value)."""
        at, variant = self.folder / "shows", ROOT / "projects" / project
        at.mkdir(exist_ok=True)
        if edits:
            lines = []
            for edit in edits:
                keys = ("list", "key", "value") if len(edit) == 3 else ("list", "name", "key", "value")
                lines.append(json.dumps({"edit": "set", **dict(zip(keys, edit))}))
            (at / f"{name}.jsonl").write_text("\n".join(lines) + "\n")
            variant = at / name
            self.run("apply", ROOT / "projects" / project, at / f"{name}.jsonl", "-o", variant)
        self.run("compile", variant, "-o", at / f"{name}.h5", "--json", also=(1,))
        return at / f"{name}.h5"

    def look(self, show, *, focus_m=0.5, pupil_mm=4, size=(800, 600), fov_deg=50, eye="left", frame=0):
        """(picture, what focalstage says of it): linear light, rows from the top."""
        file = pathlib.Path(self.scratch.name) / "look.png"
        told = self.run("retina", show, "--eye", eye, "--focus-m", focus_m, "--pupil-mm", pupil_mm, "--size",
                        f"{size[0]}x{size[1]}", "--fov-deg", fov_deg, "--frame", frame, "-o", file, "--json")
        return matplotlib.image.imread(file), json.loads(told)

    def sweep(self, show, foci, *, pupil_mm=4, size=(800, 600), fov_deg=50, eye="left", frame=0):
        """What `retina --sweep` says, and its pictures' `files`, there until the next sweep; `foci`: (from, to, count) in
        dioptres at the lens."""
        stack = pathlib.Path(self.scratch.name) / "stack"
        told = json.loads(self.run("retina", show, "--eye", eye, "--sweep", ":".join(map(str, foci)), "--pupil-mm", pupil_mm,
                                   "--size", f"{size[0]}x{size[1]}", "--fov-deg", fov_deg, "--frame", frame, "-o",
                                   stack, "--json"))
        told["files"] = [stack / picture for picture in told["pictures"]]
        return told

    def claim(self, text, holds, found):
        self.claims.append(Claim(text, bool(holds), found))
        print(f"  {'holds' if holds else 'FAILS'}  {text}: {found}", flush=True)

    def table(self, name, head, rows):
        self.tables.append(Table(name, head, rows))

    def keep(self, name):
        """Writes what an experiment found into the folder, and forgets it: the page is made from the folder."""
        found = {"quick": self.quick, "tables": [vars(table) for table in self.tables], "claims": [vars(claim) for claim in self.claims],
                 "figures": [file.name for file in self.figures]}
        (self.folder / f"{name}.json").write_text(json.dumps(found, indent=1))
        self.tables, self.claims, self.figures = [], [], []

    def kept(self, name):
        """What a full run of the experiment found last."""
        file = self.folder / f"{name}.json"
        found = json.loads(file.read_text()) if file.exists() else {"quick": True}
        if found["quick"]:
            raise SystemExit(f"scripts/experiments: {file}: no full run of {name} yet; run scripts/experiments {name}")
        return found

    def figure(self, figure, name):
        """Keeps a matplotlib figure as NAME.png."""
        file = self.folder / f"{name}.png"
        figure.savefig(file, dpi=110, metadata={"Software": None})
        matplotlib.pyplot.close(figure)
        self.figures.append(file)


def thing(told, name):
    return next(one for one in told["things"] if one["name"] == name)


def gray(light):
    """Linear light as a screen shows it (sRGB's curve)."""
    light = numpy.clip(light, 0, 1)
    return numpy.where(light <= 0.0031308, 12.92 * light, 1.055 * light ** (1 / 2.4) - 0.055)
