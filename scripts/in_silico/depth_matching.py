"""The user study's stimulus, without a user: at which focus and at which disparity the target is really shown."""

import json
import math

import matplotlib.pyplot as plt
import numpy

from .lab import CONVENTIONAL, ROOT, thing
from .measure import looks_across
from .optics import HALF_IPD_M

LOOK = {"fov_deg": 14, "pupil_mm": 4}
TARGET_DEG = 2.4
LENS_TO_PUPIL_M = 0.015
COLOURS = {"multifocal": "#0072b2", "conventional": "#d55e00"}
SWEEPS = {"multifocal": (1.5, 3.5), "conventional": (0.0, 1.0)}


def targets():
    """(name, distance from the lens) of each frame."""
    project = json.loads((ROOT / "projects/depth-matching/depth-matching.focal").read_text())
    return [(one["name"], -one["position_m"][2] - LENS_TO_PUPIL_M) for one in project["objects"]]


def seen_by(lab, show, eye, frame, size):
    """Direction of the target's centre and its width, in degrees."""
    picture, _ = lab.look(show, eye=eye, frame=frame, size=size, fov_deg=LOOK["fov_deg"], pupil_mm=0)
    u, v = looks_across(picture.shape[1], picture.shape[0], LOOK["fov_deg"])
    light = picture[numpy.abs(v) < 0.03]  # above the pointer
    columns = light.sum(axis=0)
    lit = numpy.degrees(numpy.arctan(u[light.max(axis=0) > 0.25]))
    step = math.degrees(u[1] - u[0])
    return math.degrees(math.atan((columns * u).sum() / columns.sum())), lit[-1] - lit[0] + step


def measure(lab, condition, show):
    """Of each target: (distance, peak, error of vergence in arcmin, width in degrees, conflict as focalstage reports it,
    sharpness when focused at, peak at half the pixel size)."""
    coarse, fine = (700, 350), (1400, 700)
    low, high = SWEEPS[condition]
    found = []
    for frame, (name, distance_m) in enumerate(targets()):
        def peak_of(size, step):
            told = lab.sweep(show, (low, high, round((high - low) / step) + 1), frame=frame, size=size, **LOOK)
            return thing(told, name)["peak_focus_d"]
        _, at_target = lab.look(show, focus_m=distance_m, frame=frame, size=coarse, **LOOK)
        (left, width), (right, _) = (seen_by(lab, show, eye, frame, coarse if lab.quick else fine) for eye in ("left", "right"))
        wanted = 2 * math.degrees(math.atan(HALF_IPD_M / (distance_m + LENS_TO_PUPIL_M)))
        found.append((distance_m, peak_of(coarse, 0.1 if lab.quick else 0.05), 60 * (left - right - wanted), width,
                      thing(at_target, name)["conflict_mean_d"], thing(at_target, name)["sharpness"],
                      math.nan if lab.quick else peak_of(fine, 0.1)))
    return found


def draw(lab, results):
    figure, axes = plt.subplots(1, 2, figsize=(8.5, 3.3), layout="constrained")
    wanted = [1 / one[0] for one in results["multifocal"]]
    axes[0].plot(wanted, wanted, color="0.8", label="vergence of the target")
    axes[0].plot(wanted, [one[6] for one in results["multifocal"]], "s--", ms=4, color="#56b4e9", label="multifocal, finest detail")
    for condition, found in results.items():
        axes[0].plot(wanted, [one[1] for one in found], "o-", color=COLOURS[condition], label=condition)
        axes[1].plot(wanted, [one[2] for one in found], "o-", color=COLOURS[condition], label=condition)
    axes[0].set_ylabel("sharpest at a focus of (D)")
    axes[0].set_ylim(0, 3.3)
    axes[0].legend(fontsize=8)
    axes[1].set_ylabel("disparity − geometric (arc minutes)")
    axes[1].set_ylim(-1, 1)
    axes[1].axhline(0, color="0.8", zorder=0)
    for axis in axes:
        axis.set_xlabel("distance of the target (D; " + ", ".join(f"{1000 * one[0]:.0f}" for one in results["multifocal"][::-1]) + " mm)", fontsize=9)
        axis.set_xticks(wanted, [f"{one:.2f}" for one in wanted])
    lab.figure(figure, "depth-matching")


def run(lab):
    shows = {"multifocal": lab.show("depth-multifocal", "depth-matching"),
             "conventional": lab.show("depth-conventional", "depth-matching", CONVENTIONAL)}
    results = {condition: measure(lab, condition, show) for condition, show in shows.items()}
    rows = []
    for condition, found in results.items():
        for distance_m, peak_d, vergence, width, conflict_d, sharp, fine_d in found:
            error = peak_d - 1 / distance_m
            rows.append([condition, f"{1000 * distance_m:.0f}", f"{1 / distance_m:.2f}", f"{peak_d:.2f}", f"{error:+.2f}",
                         f"{fine_d - 1 / distance_m:+.2f}", f"{conflict_d:+.2f}", f"{sharp:.2f}", f"{vergence:+.2f}", f"{width:.2f}"])
    lab.table("depth-matching", ["condition", "target (mm)", "(D)", "sharpest at (D)", "focus error (D)", "of the finest detail (D)",
                                 "reported conflict (D)",
                                 "sharpness, focused at the target", "disparity error (arcmin)", "width (°)"], rows)
    errors = {condition: [abs(one[1] - 1 / one[0]) for one in found] for condition, found in results.items()}
    lab.claim("depth matching: with depth filtering the target is sharpest within 0.15 D of its distance, all five",
              max(errors["multifocal"]) < 0.15, f"worst {max(errors['multifocal']):.2f} D, mean {numpy.mean(errors['multifocal']):.2f} D")
    if not lab.quick:
        fine = max(abs(one[6] - 1 / one[0]) for one in results["multifocal"])
        lab.claim("depth matching: the finest detail keeps nearer to the slices, half their spacing off at most", fine < 0.25,
                  f"worst {fine:.2f} D")
    lab.claim("depth matching: in the conventional condition the screen's focus stays, over 1.5 D off for all five",
              min(errors["conventional"]) > 1.5, f"{min(errors['conventional']):.2f} to {max(errors['conventional']):.2f} D")
    disparity = max(abs(one[2]) for found in results.values() for one in found)
    lab.claim("depth matching: disparity is right in both conditions, within 1 arc minute", disparity < 1, f"worst {disparity:.2f} arcmin")
    size = max(abs(one[3] - TARGET_DEG) for found in results.values() for one in found)
    lab.claim("depth matching: the target is as wide as the paper's 2.4 degrees, within 0.05", size < 0.05, f"worst {size:.3f} off")
    draw(lab, results)
