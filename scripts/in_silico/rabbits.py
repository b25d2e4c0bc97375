"""Three rabbits on a flat screen beside three real blocks: what is sharp at which focus."""

import matplotlib.pyplot as plt
import numpy

from .lab import gray, thing

WANTED_D = {"near": 3, "near-block": 3, "middle": 2, "middle-block": 2, "far": 1, "far-block": 1}
FOCI_M = (0.333, 0.5, 1.0)
LOOK = {"fov_deg": 44, "pupil_mm": 4}


def draw_pictures(lab, pictures):
    figure, axes = plt.subplots(1, 3, figsize=(9.5, 3.25), layout="constrained")
    for axis, (focus_m, picture) in zip(axes, pictures.items()):
        height, width = picture.shape
        axis.imshow(gray(picture[:, : int(0.78 * width)]), cmap="gray", vmin=0, vmax=1)
        axis.set_title(f"focused at {1000 * focus_m:.0f} mm", fontsize=10)
        axis.set_axis_off()
    lab.figure(figure, "rabbits-pictures")


def draw_curves(lab, told):
    figure, axis = plt.subplots(figsize=(8, 3.6), layout="constrained")
    for k, (name, wanted_d) in enumerate(WANTED_D.items()):
        axis.plot(told["focus_d"], thing(told, name)["sharpness"], "-" if k % 2 == 0 else "--",
                  color=("#0072b2", "#009e73", "#d55e00")[k // 2], label=name.replace("-", " "))
        axis.axvline(wanted_d, color="0.8", lw=0.8, zorder=0)
    axis.set_xlabel("focus of the eye (dioptres at the lens)")
    axis.set_ylabel("sharpness (1: through a pinhole)")
    axis.set_ylim(0, 1.05)
    top = axis.secondary_xaxis("top", functions=(lambda d: d, lambda d: d))
    top.set_xticks([1, 1 / 0.667, 2, 2.5, 3], ["1000", "667", "500", "400", "333"])
    top.set_xlabel("millimetres from the lens")
    axis.legend(fontsize=8, ncols=3, loc="lower center")
    lab.figure(figure, "rabbits-sharpness")


def run(lab):
    show = lab.show("rabbits", "three-rabbits")
    size = (800, 600) if lab.quick else (1600, 1200)
    told_at, pictures = {}, {}
    for focus_m in FOCI_M:
        pictures[focus_m], told_at[focus_m] = lab.look(show, focus_m=focus_m, size=size, **LOOK)
    foci = (0.5, 3.5, 13 if lab.quick else 31)
    told = lab.sweep(show, foci, size=size, **LOOK)
    rows, errors = [], {}
    own, sharpest = True, True
    for name, wanted_d in WANTED_D.items():
        at = {focus_m: thing(told_at[focus_m], name)["sharpness"] for focus_m in FOCI_M}
        found = thing(told, name)
        errors[name] = found["peak_focus_d"] - wanted_d
        own = own and abs(1 / max(at, key=at.get) - wanted_d) < 0.01
        rows.append([name, f"{1000 / wanted_d:.0f}", f"{wanted_d}", *(f"{at[focus_m]:.2f}" for focus_m in FOCI_M),
                     f"{found['peak_focus_d']:.2f}", f"{errors[name]:+.2f}", f"{1000 * found['peak_focus_m']:.0f}"])
    for focus_m in FOCI_M:
        for kind in ("", "-block"):
            of_kind = [name for name in WANTED_D if name.endswith("-block") == bool(kind)]
            best = max(of_kind, key=lambda name: thing(told_at[focus_m], name)["sharpness"])
            sharpest = sharpest and abs(WANTED_D[best] - 1 / focus_m) < 0.01
    lab.table("rabbits", ["thing", "at (mm)", "wants (D)", "sharpness, focus 333 mm", "500 mm", "1000 mm", "peak (D)",
                          "off by (D)", "peak (mm)"], rows)
    lab.claim("each rabbit and each block is sharpest at its own of the three focus settings", own, "6 of 6" if own else "not all")
    lab.claim("at each setting its own rabbit and its own block are the sharpest of the three", sharpest,
              "3 of 3 settings" if sharpest else "not all")
    rabbits = max(abs(errors[name]) for name in ("near", "middle", "far"))
    lab.claim("each rabbit's peak lies within 0.1 D of its distance", rabbits < 0.1, f"worst {rabbits:.3f} D")
    spacing = [numpy.subtract(*(thing(told, name)["peak_focus_d"] for name in pair)) for pair in (("near", "middle"), ("middle", "far"))]
    lab.claim("neighbouring rabbits peak 1 D apart, within 0.1 D", max(abs(s - 1) for s in spacing) < 0.1,
              f"{spacing[0]:.2f} D and {spacing[1]:.2f} D")
    draw_pictures(lab, pictures)
    draw_curves(lab, told)
