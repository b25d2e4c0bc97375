"""Corner cuboids: the images of the rendering pipeline, one step after the other, as the paper's figure shows them.

Depth maps and filtered slices are not files that focalstage writes: they are computed here, from the project's numbers and the
paper's equations alone, and the projector's images are held against them.
"""

import json
import math

import matplotlib.image
import matplotlib.pyplot as plt
import numpy

from .lab import ROOT, gray
from .measure import looks_across, shift_between
from .optics import EyeLens, projector_pixel

LENS_TO_PUPIL_M = 0.015
FOV_DEG = 50
EYE = EyeLens(LENS_TO_PUPIL_M)


def turned(q, vector):
    axis, w = numpy.array(q[:3]), q[3]
    return vector + 2 * numpy.cross(axis, numpy.cross(axis, vector) + w * vector)


def faces_of(one):
    """Corner and both sides of each of a thing's flat faces."""
    mesh, found = one["mesh"], []
    if mesh["primitive"] == "box":
        size = numpy.diag(mesh["size_m"])
        for i in range(3):
            for sign in (-0.5, 0.5):
                j, k = (i + 1) % 3, (i + 2) % 3
                found.append((sign * size[i] - size[j] / 2 - size[k] / 2, size[j], size[k]))
    else:  # a corner
        width, height = mesh["size_m"]
        half = math.radians(mesh["angle_deg"]) / 2
        for side in (-1, 1):
            found.append((numpy.array([0, -height / 2, 0]), width * numpy.array([side * math.sin(half), 0, math.cos(half)]),
                          numpy.array([0, height, 0])))
    return [(turned(one["rotation_xyzw"], corner) + one["position_m"], turned(one["rotation_xyzw"], a), turned(one["rotation_xyzw"], b))
            for corner, a, b in found]


def nearest(faces, starts, ways):
    """How far along each ray the nearest face is; infinite where there is none."""
    found = numpy.full(ways.shape[:-1], numpy.inf)
    for corner, a, b in faces:
        normal = numpy.cross(a, b)
        with numpy.errstate(divide="ignore", invalid="ignore"):
            t = ((corner - starts) @ normal) / (ways @ normal)
            at = starts + t[..., None] * ways - corner
        u, v = at @ a / (a @ a), at @ b / (b @ b)
        hit = (t > 1e-6) & (u >= 0) & (u <= 1) & (v >= 0) & (v <= 1)
        found = numpy.where(hit & (t < found), t, found)
    return found


def looks(size):
    u, v = looks_across(*size, FOV_DEG)
    return numpy.stack([*numpy.meshgrid(u, v), numpy.full(size[::-1], -1.0)], axis=-1)


def depth_maps(project, size):
    """Axial distance from the lens of objects and of surfaces, along straight looks."""
    ways = looks(size)
    return [nearest([face for one in project[kind] for face in faces_of(one)], EYE.pupil, ways) - LENS_TO_PUPIL_M
            for kind in ("objects", "surfaces")]


def filtered(powers_d, objects_m, surfaces_m):
    """Of each slice the weight of each look: Eq. 1, then Eq. 5 between neighbours; 0 where nothing is."""
    with numpy.errstate(invalid="ignore"):
        wanted_d = numpy.clip(1 / surfaces_m - 1 / objects_m, powers_d[0], powers_d[-1])
    there = numpy.isfinite(objects_m) & numpy.isfinite(surfaces_m)
    weights = []
    for n, power_d in enumerate(powers_d):
        rising = numpy.ones_like(wanted_d) if n == 0 else (wanted_d - powers_d[n - 1]) / (power_d - powers_d[n - 1])
        falling = numpy.ones_like(wanted_d) if n + 1 == len(powers_d) else (powers_d[n + 1] - wanted_d) / (powers_d[n + 1] - power_d)
        weights.append(numpy.where(there, numpy.clip(numpy.minimum(rising, falling), 0, 1), 0))
    return weights


def through_lens(project, image, power_d, size):
    """A projector image as the eye sees it through a lens of that power: each look back through the lens to the screen, and
    from there to the projector's pixel."""
    way = looks(size)
    start = numpy.zeros_like(way) + EYE.lens
    start[..., :2] += LENS_TO_PUPIL_M * way[..., :2]
    bent = way.copy()
    bent[..., :2] *= 1 - power_d * LENS_TO_PUPIL_M
    faces = [face for one in project["surfaces"] for face in faces_of(one)]
    t = nearest(faces, start, bent)
    met = numpy.isfinite(t)
    pixels = projector_pixel(project["projectors"][0], start[met] + t[met][:, None] * bent[met])
    inside = (pixels >= 0).all(axis=1) & (pixels < [image.shape[1], image.shape[0]]).all(axis=1)
    column, row = numpy.where(inside[:, None], pixels, 0).astype(int).T
    seen = numpy.zeros(size[::-1])
    seen[met] = numpy.where(inside, image[row, column], 0)
    return seen


def exported(lab, show, name, powers_d):
    """The left eye's images, by slice."""
    folder = lab.folder / name
    lab.run("export", show, "-o", folder)
    return [matplotlib.image.imread(folder / f"frame-0000-left-{power_d:+.2f}D.png") for power_d in powers_d]


def show_row(axes, pictures, titles, crop=None, **how):
    for axis in axes:
        axis.set_axis_off()
    for axis, picture, title in zip(axes, pictures, titles):
        shown = picture[crop] if crop else picture
        axis.imshow(shown, **{"cmap": "gray", "vmin": 0, "vmax": 1, **how})
        axis.set_title(title, fontsize=8)


def draw(lab, powers_d, depths, slices, off, exact, retina):
    figure, axes = plt.subplots(5, 5, figsize=(10, 7.6), layout="constrained")
    height, width = depths[0].shape
    eye = (slice(int(0.12 * height), int(0.9 * height)), slice(int(0.12 * width), int(0.95 * width)))
    lit = numpy.argwhere(numpy.max(exact, axis=0) > 0)
    (top, left), (bottom, right) = lit.min(axis=0) - 12, lit.max(axis=0) + 12
    part = (slice(top, bottom), slice(left, right))
    show_row(axes[0], [retina["pinhole"]], ["rendered (eye's view)"], eye)
    for axis, depth, title in zip(axes[0][1:], depths, ("depth of the cuboids", "depth of the corner")):
        shown = axis.imshow(numpy.where(numpy.isfinite(depth), depth, numpy.nan)[eye], cmap="viridis", vmin=0.4, vmax=1.0)
        axis.set_title(title, fontsize=8)
    bar = figure.colorbar(shown, cax=axes[0][3].inset_axes([0.05, 0.45, 0.9, 0.12]), orientation="horizontal")
    bar.set_label("metres from the lens", fontsize=8)
    bar.ax.tick_params(labelsize=8)
    show_row(axes[1], [gray(one) for one in slices], [f"filtered for {power:+.1f} D" for power in powers_d], eye)
    show_row(axes[2], [gray(one) for one in off], [f"projector {power:+.1f} D, off" for power in powers_d], part)
    show_row(axes[3], [gray(one) for one in exact], [f"projector {power:+.1f} D, exact" for power in powers_d], part)
    names = ("off", "pinhole", "focus 0.50 m", "focus 0.70 m", "focus 0.90 m")
    titles = ("retina, pinhole, off", "retina, pinhole, exact", "retina, focus 0.5 m", "retina, focus 0.7 m", "retina, focus 0.9 m")
    show_row(axes[4], [retina[name] for name in names], titles, eye)
    lab.figure(figure, "pipeline")


def run(lab):
    project = json.loads((ROOT / "projects/corner-cuboids/corner-cuboids.focal").read_text())
    powers_d = project["slices"]["powers_d"]
    size = (800, 600) if lab.quick else (1200, 900)
    shows = {mode: lab.show(f"corner-{mode}", "corner-cuboids", [("slices", "breathing", mode)]) for mode in ("off", "exact")}
    images = {mode: exported(lab, show, f"corner-{mode}-images", powers_d) for mode, show in shows.items()}
    look = {"size": size, "fov_deg": FOV_DEG}
    rendered, _ = lab.look(shows["exact"], pupil_mm=0, **look)
    depths = depth_maps(project, size)
    slices = [weight * rendered for weight in filtered(powers_d, *depths)]
    rows, worst, total = [], {"off": 0.0, "exact": 0.0}, {"off": 0.0, "exact": 0.0}
    for n, power_d in enumerate(powers_d):
        row = [f"{power_d:+.1f}", f"{100 * numpy.mean(slices[n] > 0.02):.1f}"]
        for mode in ("off", "exact"):
            seen = through_lens(project, images[mode][n], power_d, size)
            total[mode] = total[mode] + seen
            apart = numpy.linalg.norm(shift_between(seen, slices[n], FOV_DEG))
            worst[mode] = max(worst[mode], apart)
            row.append(f"{apart:.2f}")
        rows.append(row)
    lab.table("pipeline", ["slice (D)", "of the picture (%)", "off: beside the filtered slice by (arcmin)", "exact (arcmin)"], rows)
    lab.claim("pipeline: each compensated projector image, seen through the lens, lies where depth filtering's slice lies, within 1.5 "
              "arc minutes", worst["exact"] < 1.5, f"worst {worst['exact']:.2f} arcmin (uncompensated {worst['off']:.2f})")
    apart = numpy.linalg.norm(shift_between(total["exact"], rendered, FOV_DEG))
    light = total["exact"].sum() / rendered.sum() - 1
    lab.claim("pipeline: together they are the picture that the retina has through a pinhole, within 0.2 arc minutes and 1 % of its light",
              apart < 0.2 and abs(light) < 0.01, f"{apart:.3f} arcmin, {100 * light:+.2f} % light")
    if lab.quick:
        return
    retina = {"pinhole": gray(rendered), "off": gray(lab.look(shows["off"], pupil_mm=0, **look)[0])}
    for focus_m in (0.5, 0.7, 0.9):
        retina[f"focus {focus_m:.2f} m"] = gray(lab.look(shows["exact"], focus_m=focus_m, pupil_mm=4, **look)[0])
    draw(lab, powers_d, depths, slices, images["off"], images["exact"], retina)
