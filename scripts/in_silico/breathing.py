"""Lens breathing: how wide the seams between slices are without compensation, with the paper's and with ours."""

import json
import math

import matplotlib.pyplot as plt
import numpy

from .lab import ROOT, gray
from .measure import looks_across, missing_light
from .optics import EyeLens, bisect, projector_pixel, turned_plane

MODES = ("off", "planar", "exact", "smooth")
SAMPLES = {"smooth": 16}  # per projector pixel; "smooth" is exact, with edges that pixels do not round
WORDS = {"smooth": "exact, 16 samples a pixel"}
COLOURS = {"off": "#d55e00", "planar": "#e69f00", "exact": "#0072b2", "smooth": "#56b4e9"}
DIM = ("objects", "checker", "appearance", {"checker": {"squares": [20, 4], "a": [0.45, 0.45, 0.45], "b": [0.02, 0.02, 0.02]}})
MARGIN = 0.018  # looks to each side of a seam
POWERS_D = (-1, -0.5, 0, 0.5, 1, 1.5)
LIGHT = 0.4  # of the plane where seams are measured: doubled where slices overlap, it still is no more than white
EVEN = ("objects", "checker", "appearance", {"unlit": [LIGHT, LIGHT, LIGHT]})


class Setup:
    """A screen and a lens; the plane that is shown is the sample's."""

    def __init__(self, name, words, lens_to_pupil_m, screen_turned_deg):
        self.name, self.words, self.turned_rad = name, words, math.radians(screen_turned_deg)
        project = json.loads((ROOT / "projects/slanted-checker/slanted-checker.focal").read_text())
        self.projector = project["projectors"][0]
        checker = project["objects"][0]
        turn = 2 * math.asin(checker["rotation_xyzw"][1])
        self.object = turned_plane(checker["position_m"], turn)
        half = checker["mesh"]["size_m"][0] / 2 * numpy.array([math.cos(turn), 0.0, -math.sin(turn)])
        self.screen = turned_plane([0, 0, -0.515], self.turned_rad)
        # The lens stays where it is, 0.5 m before the screen, and the pupil moves away from it.
        self.eye = EyeLens(lens_to_pupil_m, lens_to_pupil_m - 0.015)
        self.ends = [self.eye.straight(self.object[0] + way * half)[0] for way in (-1, 1)]
        self.edits = [("viewer", "position_m", [0, 0, lens_to_pupil_m - 0.015]),
                      ("glasses", "lens_to_pupil_mm", 1000 * lens_to_pupil_m),
                      ("surfaces", "screen", "rotation_xyzw", [0, math.sin(self.turned_rad / 2), 0, math.cos(self.turned_rad / 2)])]

    def needed_power(self, u):
        at_screen = self.eye.distance(self.eye.meet((u, 0), self.screen))
        return 1 / at_screen - 1 / self.eye.distance(self.eye.meet((u, 0), self.object))

    def boundaries(self):
        """Looks where one slice hands over to the next, with both powers, as far as the lens shows them."""
        rim = 0.008 / self.eye.d_e - MARGIN
        left, right = max(-rim, self.ends[0] + MARGIN), min(rim, self.ends[1] - MARGIN)
        found = []
        for low, high in zip(POWERS_D, POWERS_D[1:]):
            u = bisect(lambda u: self.needed_power(u) - (low + high) / 2, -0.3, 0.3)
            if left < u < right:
                found.append((u, low, high))
        return found

    def shown_at(self, u, power_d, mode):
        """Where content of look `u` is seen through its slice."""
        if mode in ("exact", "smooth"):
            return u
        factor = 1.0
        if mode == "planar":  # Eq. 7 with d_p at the screen's centre
            d_p = self.eye.distance(self.screen[0])
            factor = 1 - power_d * self.eye.d_e * d_p / (d_p + self.eye.d_e)
        return self.eye.seen(self.eye.meet((u * factor, 0), self.screen), power_d)[0]

    def predicted(self, u, low, high, mode):
        """Gap (+) or overlap (-) as a difference of looks."""
        return self.shown_at(u, high, mode) - self.shown_at(u, low, mode)

    def pixels_per_look(self, u):
        a, b = (projector_pixel(self.projector, self.eye.meet((at, 0), self.screen)) for at in (u - 0.001, u + 0.001))
        return float(numpy.linalg.norm(b - a) / 0.002)


def measure(lab, setup, mode):
    """Of each boundary: (u, low, high, measured, predicted), looks."""
    show = lab.show(f"breathing-{setup.name}-{mode}", "slanted-checker",
                    setup.edits + [EVEN, ("slices", "assignment", "nearest"),
                     ("slices", "breathing", "exact" if mode == "smooth" else mode),
                     ("slices", "samples_per_pixel", SAMPLES.get(mode, 1))])
    boundaries = setup.boundaries()
    fov = 2 * math.degrees(math.atan(max(abs(b[0]) for b in boundaries) + 0.02))
    size = (1600, 80) if lab.quick else (3000, 300)
    strip, _ = lab.look(show, pupil_mm=0, size=size, fov_deg=fov)
    strip = strip / (round(255 * LIGHT) / 255)
    columns, _ = looks_across(*size, fov)
    found = []
    for i, (u, low, high) in enumerate(boundaries):
        reach = min([MARGIN] + [0.45 * abs(u - other[0]) for other in boundaries if other[0] != u])
        found.append((u, low, high, missing_light(strip, columns, u - reach, u + reach), setup.predicted(u, low, high, mode)))
    return found


def draw_seams(lab, results):
    setups = list(results)
    figure, axes = plt.subplots(1, len(setups), figsize=(9, 3.2), layout="constrained")
    for axis, setup in zip(axes, setups):
        for k, mode in enumerate(MODES):
            found = results[setup][mode]
            x = numpy.arange(len(found)) + 0.2 * (k - 1.5)
            px = [setup.pixels_per_look(f[0]) for f in found]
            axis.bar(x, [f[3] * p for f, p in zip(found, px)], 0.18, label=WORDS.get(mode, mode), color=COLOURS[mode])
            axis.plot(x, [f[4] * p for f, p in zip(found, px)], "k_", ms=8, label="predicted" if k == 0 else None)
        axis.set_xticks(range(len(found)), [f"{f[1]:g} | {f[2]:g}" for f in found], fontsize=8)
        axis.set_xlabel("slices at the seam (D)")
        axis.set_title(setup.words, fontsize=9)
        axis.axhline(0, color="k", lw=0.5)
    axes[0].set_ylabel("gap (+) or overlap (−)\n(projector pixels)")
    axes[1].legend(fontsize=8, loc="lower right")
    lab.figure(figure, "breathing-seams")


def draw_pictures(lab, camera):
    """What the camera sees, without and with compensation: the paper's figure."""
    figure, axes = plt.subplots(2, 1, figsize=(7, 5.4), layout="constrained")
    for axis, mode in zip(axes, ("off", "exact")):
        show = lab.show(f"breathing-picture-{mode}", "slanted-checker",
                        camera.edits + [DIM, ("slices", "assignment", "nearest"), ("slices", "breathing", mode)])
        picture, _ = lab.look(show, pupil_mm=0, size=(1600, 640), fov_deg=15)
        axis.imshow(gray(picture), cmap="gray", vmin=0, vmax=1, extent=(-7.5, 7.5, -3, 3))
        axis.set_title(f"breathing {mode}", fontsize=10)
        axis.set_ylabel("degrees up")
    axes[1].set_xlabel("degrees to the right of the lens axis")
    lab.figure(figure, "breathing-pictures")


def run(lab):
    setups = [Setup("glasses", "glasses: pupil 15 mm\nbehind the lens", 0.015, 0),
              Setup("camera", "camera: pupil 60 mm\nbehind the lens", 0.060, 0),
              Setup("turned", "glasses, screen turned\nby 30°", 0.015, 30)]
    results = {setup: {mode: measure(lab, setup, mode) for mode in MODES} for setup in setups}
    rows, worst = [], {mode: 0.0 for mode in MODES}
    errors = []
    for setup in setups:
        for i, (u, low, high, _, _) in enumerate(results[setup]["off"]):
            per_look = setup.pixels_per_look(u)
            row = [setup.name, f"{low:g} \\| {high:g}", f"{math.degrees(math.atan(u)):+.1f}"]
            for mode in MODES:
                measured, predicted = results[setup][mode][i][3:]
                px = measured * per_look
                row.append(f"{px:+.2f}")
                if mode in ("off", "exact"):
                    row.append(f"{math.degrees(measured / (1 + u * u)):+.3f}")
                if mode == "off":
                    row.insert(-2, f"{predicted * per_look:+.2f}")
                    if abs(predicted * per_look) > 0.5:
                        errors.append(abs(measured / predicted - 1))
                worst[mode] = max(worst[mode], abs(px))
            rows.append(row)
    lab.table("breathing-seams", ["setup", "slices (D)", "at (°)", "off, predicted (px)", "off (px)", "off (°)", "planar (px)",
                                  "exact (px)", "exact (°)", "exact, 16 samples (px)"], rows)
    lab.claim("seams without compensation are as wide as the thin lens says, within 5 %", max(errors) < 0.05,
              f"worst {100 * max(errors):.1f} % of {len(errors)} seams over half a pixel")
    for mode, words in (("exact", "exact compensation"), ("planar", "the paper's resize")):
        lab.claim(f"seams with {words} stay below one projector pixel", worst[mode] < 1, f"worst {worst[mode]:.2f} px")
    lab.claim("what remains is the rounding of edges to pixels: with 16 samples a pixel it is below a third",
              worst["smooth"] < 1 / 3, f"worst {worst['smooth']:.2f} px")
    draw_seams(lab, results)
    if not lab.quick:
        draw_pictures(lab, setups[1])
