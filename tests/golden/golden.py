#!/usr/bin/python3
"""Compiles a sample, of projects/ or of this folder, and holds its show against tests/golden/NAME/expected.json.

    golden.py check NAME           for ctest: says what changed, from findings over times and pixels down to the hash
    golden.py accept [NAME...]     writes the derived values and the hash anew, on purpose (scripts/accept-goldens)

Named values are derived from the project alone (derive.py, or a bound with its reason); the show must agree with them
before its hash is accepted.
"""

import hashlib
import json
import os
import pathlib
import subprocess
import sys
import tempfile

import h5py

sys.dont_write_bytecode = True
HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))
import derive  # noqa: E402

ROOT = HERE.parents[1]
FOCALSTAGE = pathlib.Path(os.environ.get("FOCALSTAGE_BIN", ROOT / "build/release/bin")) / "focalstage"
WITNESS = ROOT / "tests/io/show/read_with_h5py.py"
EYES = ["left", "right", "both"]
TIME_TOLERANCE_S = 1e-9


def folder_of(name):
    """A ready project, or one that is here for its test alone."""
    return next(f for f in (ROOT / "projects" / name, HERE / name) if (f / f"{name}.focal").exists())


def load(name):
    return (json.loads((folder_of(name) / f"{name}.focal").read_text()),
            json.loads((HERE / name / "expected.json").read_text()))


class Compiled:
    def __init__(self, name, folder):
        self.path = pathlib.Path(folder) / f"{name}.h5"
        ran = subprocess.run([FOCALSTAGE, "compile", folder_of(name), "-o", self.path, "--json"],
                             capture_output=True, text=True, timeout=600)
        if ran.returncode not in (0, 1):
            raise SystemExit(f"{name}: compile exits {ran.returncode}: {ran.stderr}")
        self.findings = [{key: f[key] for key in ("severity", "code", "where")} for f in json.loads(ran.stdout)["findings"]]
        self.sha256 = hashlib.sha256(self.path.read_bytes()).hexdigest()
        self.show = h5py.File(self.path)
        group = self.show["projector/0"]
        self.images, self.powers, self.eyes = group["images"], group["image/power_d"][:], group["image/eye"][:]
        self.kinds = group["image/kind"][:]
        self.slots = group["slot"]


def slot_values(project, compiled):
    """Every exposure with the start that the sweep's formula gives it."""
    values = []
    period_s = 1 / project["sweep"]["frequency_hz"]
    for k, image in enumerate(compiled.slots["image"][:]):
        eye = "left" if compiled.slots["start_s"][k] < period_s / 2 else "right"
        start_s, how = derive.exposure(project, eye, float(compiled.powers[image]))
        values.append({"slot": k, "image": int(image), "eye": eye, "power_d": float(compiled.powers[image]),
                       "start_s": round(start_s, 12), "derivation": how})
    return values


def pixel_value(project, pick, compiled):
    """The code of one named pixel, and how it comes about; None for what is only bounded."""
    if "least" in pick:
        return None, None
    image = pick["image"]
    n = None
    if compiled.kinds[image] != 1:
        n = [i for i in range(len(compiled.eyes)) if compiled.eyes[i] == compiled.eyes[image] and compiled.kinds[i] != 1].index(image)
    eye = EYES[compiled.eyes[image]]
    room = derive.Room(project, pick["frame"])
    return room.derive(*pick["at"], "left" if eye == "both" else eye, n, compiled.kinds[image] != 0)


def differences(name):
    project, expected = load(name)
    found = []
    with tempfile.TemporaryDirectory(prefix="focalstage-golden-") as folder:
        compiled = Compiled(name, folder)
        if compiled.findings != expected["findings"]:
            found.append(f"findings: {compiled.findings}, expected {expected['findings']}")
        if len(expected["slots"]) != len(compiled.slots["image"]):
            found.append(f"{len(compiled.slots['image'])} exposures, expected {len(expected['slots'])}")
        for want, derived in zip(expected["slots"], slot_values(project, compiled)):
            got_s = float(compiled.slots["start_s"][want["slot"]])
            if abs(got_s - want["start_s"]) > TIME_TOLERANCE_S or want["image"] != derived["image"]:
                found.append(f"slot {want['slot']} shows image {derived['image']} from {got_s:.9f} s, expected image "
                             f"{want['image']} from {want['start_s']:.9f} s = {want['derivation']}")
            if abs(derived["start_s"] - want["start_s"]) > TIME_TOLERANCE_S:
                found.append(f"slot {want['slot']}: the project's sweep now gives {derived['start_s']:.9f} s")
        for pick in expected["pixels"]:
            x, y = pick["at"]
            code = int(compiled.images[pick["frame"], pick["image"], y, x])
            least, most = pick.get("least", pick.get("code")), pick.get("most", pick.get("code"))
            if not least <= code <= most:
                found.append(f"{pick['why']}: frame {pick['frame']} image {pick['image']} pixel {pick['at']} is {code}, expected "
                             f"{least}..{most}: {pick['derivation']}")
            derived, how = pixel_value(project, pick, compiled)
            if derived is not None and derived != pick["code"]:
                found.append(f"{pick['why']}: the project now gives {derived}: {how}")
        witness = subprocess.run(["/usr/bin/python3", WITNESS, compiled.path], capture_output=True, text=True)
        if witness.returncode != 0:
            found.append(f"h5py: {witness.stdout}{witness.stderr}")
        if compiled.sha256 != expected["show_sha256"]:
            found.append(f"the show's SHA-256 is {compiled.sha256}, expected {expected['show_sha256']}" +
                         ("" if found else "; all named values hold. If it changed on purpose: scripts/accept-goldens"))
    return found


def accept(name):
    project, expected = load(name)
    with tempfile.TemporaryDirectory(prefix="focalstage-golden-") as folder:
        compiled = Compiled(name, folder)
        if any(f["severity"] == "error" for f in compiled.findings):
            raise SystemExit(f"{name}: a sample has no errors: {compiled.findings}")
        expected["slots"] = slot_values(project, compiled)
        expected["findings"] = compiled.findings
        for pick in expected["pixels"]:
            derived, how = pixel_value(project, pick, compiled)
            if derived is not None:
                pick["code"], pick["derivation"] = derived, how
        expected["show_sha256"] = compiled.sha256
    (HERE / name / "expected.json").write_text(json.dumps(expected, indent=1) + "\n")
    left = differences(name)
    for line in left:
        print(f"{name}: {line}")
    print(f"{name}: {'NOT accepted: the show disagrees with what is derived' if left else 'accepted'}")
    return not left


def main():
    if len(sys.argv) == 3 and sys.argv[1] == "check":
        found = differences(sys.argv[2])
        for line in found:
            print(f"{sys.argv[2]}: {line}")
        print(f"{sys.argv[2]}: {len(found)} differences")
        sys.exit(1 if found else 0)
    if len(sys.argv) >= 2 and sys.argv[1] == "accept":
        names = sys.argv[2:] or sorted(p.parent.name for p in HERE.glob("*/expected.json"))
        sys.exit(0 if all([accept(name) for name in names]) else 1)
    sys.exit(__doc__)


if __name__ == "__main__":
    main()
