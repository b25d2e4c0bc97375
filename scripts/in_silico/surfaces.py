"""A step surface and a moving board: what is projected keeps place, size and focus, or does not."""

import math

import matplotlib.image
import matplotlib.pyplot as plt
import numpy

from .lab import CONVENTIONAL, gray
from .measure import looks_across, peak, place_and_size, sharpness

FOCUS_M = 0.45
LIT = 0.02
LOOK = {"fov_deg": 22, "pupil_mm": 4}
EDGE_LOOK = 0.0315 / 0.465  # of the left eye past the step's edge: to its right is the back plane
EDGE_CLEAR = math.radians(0.25)  # what is blurred on one plane reaches over the edge by so much
COLOURS = {"multifocal": "#0072b2", "conventional": "#d55e00"}
STYLES = {"front": "-", "back": "--", "all": "-"}


def parts_of(picture, split):
    """Masks of what is lit: all of it, or what stands on the front plane and on the back one."""
    lit = picture > LIT
    if not split:
        return {"all": lit}
    u, _ = looks_across(picture.shape[1], picture.shape[0], LOOK["fov_deg"])
    return {"front": lit & (u < EDGE_LOOK - EDGE_CLEAR), "back": lit & (u > EDGE_LOOK + EDGE_CLEAR)}


def measure_frame(lab, show, frame, foci, size, split):
    """(x, y, width, height in degrees), and of each part (sharpness at FOCUS_M, peak in dioptres)."""
    pinhole, _ = lab.look(show, pupil_mm=0, frame=frame, size=size, fov_deg=LOOK["fov_deg"])
    picture, _ = lab.look(show, focus_m=FOCUS_M, frame=frame, size=size, **LOOK)
    told = lab.sweep(show, foci, frame=frame, size=size, **LOOK)
    stack = [matplotlib.image.imread(file) for file in told["files"]]
    parts = {}
    for name, mask in parts_of(pinhole, split).items():
        if mask.sum() > 400:  # else too little of it stands there
            parts[name] = (sharpness(picture, pinhole, mask), peak(told["focus_d"], [sharpness(s, pinhole, mask) for s in stack]))
    return place_and_size(pinhole, LOOK["fov_deg"]), parts


def measure(lab, name, project, foci, frames, split):
    """{condition: {frame: measured}}"""
    size = (600, 450) if lab.quick else (800, 600)
    shows = {"multifocal": lab.show(f"{name}-multifocal", project), "conventional": lab.show(f"{name}-conventional", project, CONVENTIONAL)}
    found = {condition: {k: measure_frame(lab, show, k, foci, size, split) for k in frames} for condition, show in shows.items()}
    return shows, found


def over(found, condition, part):
    """Frames, peaks and sharpnesses of a part."""
    rows = [(k, one[1][part][1], one[1][part][0]) for k, one in found[condition].items() if part in one[1]]
    frames, peaks, sharp = zip(*rows)
    return numpy.array(frames), numpy.array([math.nan if p is None else p for p in peaks], float), numpy.array(sharp)


def focus_rows(found, parts, wanted_d):
    """A table's rows, and {(condition, part): (worst focus error, least sharpness)}."""
    rows, worst = [], {}
    for condition in COLOURS:
        for part in parts:
            _, peaks, sharp = over(found, condition, part)
            errors = peaks - wanted_d
            worst[condition, part] = (numpy.nanmax(numpy.abs(errors)), sharp.min())
            rows.append([condition, part, f"{numpy.nanmean(errors):+.2f}", f"{numpy.nanmin(errors):+.2f} to {numpy.nanmax(errors):+.2f}",
                         f"{sharp.mean():.2f}", f"{sharp.min():.2f}"])
    return rows, worst


FOCUS_HEAD = ["condition", "part", "focus error, mean (D)", "over the path (D)", "sharpness at 450 mm, mean", "least"]


def places(found, condition):
    return numpy.array([one[0] for one in found[condition].values()])


def draw_path(lab, name, found, parts, wanted_d, drift_label, drift):
    seconds_per_frame = 1 / 15  # both samples
    figure, axes = plt.subplots(1, 3, figsize=(10, 3.2), layout="constrained")
    for condition in COLOURS:
        for part in parts:
            frames, peaks, sharp = over(found, condition, part)
            label = condition if part == "all" else f"{condition}, {part} plane"
            axes[0].plot(frames * seconds_per_frame, peaks - wanted_d, STYLES[part], marker=".", color=COLOURS[condition], label=label)
            axes[1].plot(frames * seconds_per_frame, sharp, STYLES[part], marker=".", color=COLOURS[condition])
    axes[0].set_ylabel("focus error: peak − wanted (D)")
    axes[0].axhspan(-0.3, 0.3, color="0.93", zorder=0)
    axes[1].set_ylabel("sharpness, focused at 450 mm")
    axes[1].set_ylim(0, 1.05)
    for label, (times, arcmin), colour in drift:
        axes[2].plot(times, arcmin, marker=".", label=label, color=colour)
    axes[2].set_ylabel(drift_label)
    axes[2].legend(fontsize=7, loc="upper left")
    axes[2].margins(y=0.8)
    for axis in axes:
        axis.set_xlabel("time (s)")
    axes[0].legend(fontsize=7)
    axes[0].margins(y=0.2)
    lab.figure(figure, f"{name}-path")


def draw_pictures(lab, name, shows, frames, titles, crop):
    """Both conditions at some frames, as an eye focused at 450 mm sees them."""
    shape = (crop[0].stop - crop[0].start) / (crop[1].stop - crop[1].start)
    figure, axes = plt.subplots(2, len(frames), figsize=(2.5 * len(frames), 2 * (2.4 * shape + 0.45)), layout="constrained", squeeze=False)
    for row, (condition, show) in enumerate(shows.items()):
        for axis, frame, title in zip(axes[row], frames, titles):
            picture, _ = lab.look(show, focus_m=FOCUS_M, frame=frame, size=(1000, 750), **LOOK)
            axis.imshow(gray(picture[crop]), cmap="gray", vmin=0, vmax=1)
            axis.set_title(f"{condition}\n{title}", fontsize=9)
            axis.set_axis_off()
    lab.figure(figure, f"{name}-pictures")


def run_step(lab):
    frames = (0, 11) if lab.quick else range(30)
    wanted_d = 1 / 0.45
    shows, found = measure(lab, "step", "step-teapot", (0.9, 2.9, 11 if lab.quick else 21), frames, True)
    rows, worst = focus_rows(found, ("front", "back"), wanted_d)
    lab.table("step-focus", FOCUS_HEAD, rows)
    apart = (places(found, "multifocal") - places(found, "conventional")) * 60
    lab.table("step-place", ["multifocal against conventional", "worst over the turn (arcmin)", "of (arcmin)"],
              [[what, f"{numpy.abs(apart[:, i]).max():.2f}", of] for i, (what, of) in enumerate(
                  [("centre, across", ""), ("centre, up", ""),
                   ("width", f"{60 * places(found, 'conventional')[:, 2].mean():.0f}"),
                   ("height", f"{60 * places(found, 'conventional')[:, 3].mean():.0f}")])])
    lab.claim("step: on both planes the teapot's peak stays within 0.3 D of the front plane's distance",
              max(worst["multifocal", part][0] for part in ("front", "back")) < 0.3,
              f"worst {worst['multifocal', 'front'][0]:.2f} D front, {worst['multifocal', 'back'][0]:.2f} D back")
    lab.claim("step: without the sweep its part on the back plane is over 0.6 D off", worst["conventional", "back"][0] > 0.6,
              f"{worst['conventional', 'back'][0]:.2f} D")
    lab.claim("step: focused at the front plane, the part on the back plane is sharper with the sweep at every moment",
              worst["multifocal", "back"][1] > over(found, "conventional", "back")[2].max(),
              f"least {worst['multifocal', 'back'][1]:.2f} against most {over(found, 'conventional', 'back')[2].max():.2f}")
    moved, grown = numpy.abs(apart[:, :2]).max(), (numpy.abs(apart[:, 2:]) / 60 / places(found, "conventional")[:, 2:]).max()
    lab.claim("step: the teapot's place is that of a projection without a sweep, within 1 arc minute, its size within 1 %",
              moved < 1 and grown < 0.01, f"worst {moved:.2f} arcmin, {100 * grown:.2f} %")
    if not lab.quick:
        times = numpy.array(frames) / 15
        draw_path(lab, "step", found, ("front", "back"), wanted_d, "against conventional (arc minutes)",
                  [("centre across", (times, apart[:, 0]), "#009e73"),
                   ("centre up", (times, apart[:, 1]), "#cc79a7"), ("width", (times, apart[:, 2]), "#56b4e9")])
        draw_pictures(lab, "step", shows, (0, 4, 8, 15), ("0 s", "0.27 s", "0.53 s", "1 s"),
                      (slice(180, 580), slice(370, 990)))


def run_moving(lab):
    frames = (0, 4, 8, 15) if lab.quick else range(30)
    wanted_d = 1 / 0.45
    shows, found = measure(lab, "moving", "moving-plane", (1.4, 3.6, 12 if lab.quick else 23), frames, False)
    rows, worst = focus_rows(found, ("all",), wanted_d)
    lab.table("moving-focus", FOCUS_HEAD, rows)
    drift = {condition: (places(found, condition) - places(found, condition).mean(axis=0)) * 60 for condition in COLOURS}
    mean = {condition: places(found, condition).mean(axis=0) for condition in COLOURS}
    lab.table("moving-place", ["condition", "centre, worst drift across (arcmin)", "up (arcmin)", "width (°)", "changes by (%)",
                               "height (°)", "changes by (%)"],
              [[condition, f"{numpy.abs(drift[condition][:, 0]).max():.2f}", f"{numpy.abs(drift[condition][:, 1]).max():.2f}",
                f"{mean[condition][2]:.2f}", f"{100 * numpy.abs(drift[condition][:, 2]).max() / 60 / mean[condition][2]:.2f}",
                f"{mean[condition][3]:.2f}", f"{100 * numpy.abs(drift[condition][:, 3]).max() / 60 / mean[condition][3]:.2f}"]
               for condition in COLOURS])
    moved = numpy.abs(drift["multifocal"][:, :2]).max()
    grown = max(numpy.abs(drift["multifocal"][:, 2 + i]).max() / 60 / mean["multifocal"][2 + i] for i in (0, 1))
    lab.claim("moving: the rabbit's centre stays within 2 arc minutes over the whole path", moved < 2, f"worst {moved:.2f} arcmin")
    lab.claim("moving: its width and height stay within 1 %", grown < 0.01, f"worst {100 * grown:.2f} %")
    lab.claim("moving: its focus stays within 0.3 D of where it is to be", worst["multifocal", "all"][0] < 0.3,
              f"worst {worst['multifocal', 'all'][0]:.2f} D")
    lab.claim("moving: without the sweep it goes with the board, over 0.8 D off", worst["conventional", "all"][0] > 0.8,
              f"worst {worst['conventional', 'all'][0]:.2f} D")
    lab.claim("moving: focused at the rabbit, the least sharp moment with the sweep beats that without",
              worst["multifocal", "all"][1] > worst["conventional", "all"][1] + 0.1,
              f"{worst['multifocal', 'all'][1]:.2f} against {worst['conventional', 'all'][1]:.2f}")
    if not lab.quick:
        times = numpy.array(frames) / 15
        draw_path(lab, "moving", found, ("all",), wanted_d, "from the path's mean (arc minutes)",
                  [(f"{words}, {condition}", (times, drift[condition][:, i]), colour) for words, i, condition, colour in
                   (("drift across", 0, "multifocal", "#0072b2"), ("up", 1, "multifocal", "#56b4e9"),
                    ("across", 0, "conventional", "#d55e00"), ("up", 1, "conventional", "#e69f00"))])
        draw_pictures(lab, "moving", shows, (0, 7, 15), ("board at 500 mm", "at about 400 mm", "at 300 mm"),
                      (slice(30, 720), slice(400, 920)))
