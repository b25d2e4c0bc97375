#!/usr/bin/python3
"""Opens shows with h5py alone and holds every name, type and shape against the show format.

    read_with_h5py.py SHOW.h5...

Prints one line per show; exits 1 at the first thing that is missing or different, naming it.
"""
import hashlib
import json
import sys

import h5py
import numpy as np


class Wrong(Exception):
    pass


def demand(holds, what):
    if not holds:
        raise Wrong(what)


def text(value):
    return value.decode("utf-8") if isinstance(value, bytes) else str(value)


def numbers(show, name, dtype, shape):
    """The dataset `name`; None in `shape` fits any extent."""
    demand(name in show, f"{name} is missing")
    data = show[name]
    demand(data.dtype == np.dtype(dtype), f"{name} is {data.dtype}, not {dtype}")
    fits = len(data.shape) == len(shape) and all(want in (None, have) for have, want in zip(data.shape, shape))
    demand(fits, f"{name} has shape {data.shape}, not {shape}")
    if data.dtype.kind == "f":
        demand(np.isfinite(data[...]).all(), f"{name} is not finite")
    return data


def check_root(show):
    attributes = show.attrs
    for name in ("format", "version", "frequency_hz", "frames_per_second", "rate_hz", "project_sha256", "compiler"):
        demand(name in attributes, f"attribute {name} is missing")
    demand(text(attributes["format"]) == "focalstage-show", "attribute format is not focalstage-show")
    demand(int(attributes["version"]) == 1, "attribute version is not 1")
    for name in ("frequency_hz", "frames_per_second", "rate_hz"):
        demand(np.asarray(attributes[name]).dtype == np.float64 and attributes[name] > 0, f"attribute {name} is no rate")
    demand(text(attributes["compiler"]).startswith("focalstage "), "attribute compiler names no compiler")

    demand("project" in show and show["project"].shape == (), "project is not one string")
    demand(h5py.check_string_dtype(show["project"].dtype) is not None, "project is not a string")
    project = show["project"][()]
    project = project if isinstance(project, bytes) else project.encode("utf-8")
    demand(hashlib.sha256(project).hexdigest() == text(attributes["project_sha256"]), "project_sha256 is another's")
    return json.loads(project)


def check_assets(show):
    demand(isinstance(show.get("asset"), h5py.Group), "asset is missing")
    for name in show["asset"]:
        data = numbers(show, f"asset/{name}", "uint8", (None,))
        demand(hashlib.sha256(data[...].tobytes()).hexdigest() == name, f"asset/{name} has another hash")
        demand("path" in data.attrs and text(data.attrs["path"]), f"asset/{name} has no path")
        for path in map(text, data.attrs.get("paths", [])):
            demand(path and not path.startswith("/"), f"asset/{name} has an absolute path")


def check_projector(show):
    demand("projector/0/images" in show, "projector/0/images is missing")
    images = show["projector/0/images"]
    demand(images.dtype == np.uint8, "projector/0/images is not uint8")
    demand(images.ndim == 4 or (images.ndim == 5 and images.shape[4] == 3), "projector/0/images has another shape")
    frames, count, height, width = images.shape[:4]
    if count:
        demand(images.compression == "gzip", "projector/0/images is not deflated")
        demand(images.chunks[:2] == (1, 1), "a chunk of projector/0/images is larger than one image")
        stored = {images.id.get_chunk_info(i).chunk_offset for i in range(images.id.get_num_chunks())}
        for k in range(frames):
            for i in range(count):
                image = images[k, i]
                for y in range(0, height, images.chunks[2]):
                    for x in range(0, width, images.chunks[3]):
                        lit = image[y : y + images.chunks[2], x : x + images.chunks[3]].any()
                        offset = (k, i, y, x) + (0,) * (images.ndim - 4)
                        demand((offset in stored) == lit, f"chunk {offset}: a chunk is stored if and only if it is lit")

    eye = numbers(show, "projector/0/image/eye", "uint8", (count,))[...]
    kind = numbers(show, "projector/0/image/kind", "uint8", (count,))[...]
    numbers(show, "projector/0/image/power_d", "float64", (count,))
    demand((eye <= 2).all() and (kind <= 2).all(), "an image's eye or kind is above 2")

    slot_image = numbers(show, "projector/0/slot/image", "int32", (None,))[...]
    slots = len(slot_image)
    demand(((slot_image >= 0) & (slot_image < count)).all(), "a slot shows an image that is not there")
    for name in ("start_s", "exposure_s", "trigger_s", "power_d", "smear_d"):
        numbers(show, f"projector/0/slot/{name}", "float64", (slots,))
    demand((np.diff(show["projector/0/slot/start_s"][...]) >= 0).all(), "slots are not in time order")
    slot_eye = numbers(show, "projector/0/slot/eye", "uint8", (slots,))[...]
    demand(((eye[slot_image] == 2) | (eye[slot_image] == slot_eye)).all(), "a slot shows the other eye's image")
    return frames


def check_rig(show):
    samples = numbers(show, "lens/power_d", "float64", (2, None)).shape[1]
    numbers(show, "lens/drive_a", "float64", (2, samples))
    numbers(show, "shutter/left_s", "float64", (2,))
    numbers(show, "shutter/right_s", "float64", (2,))


def check_poses(show, frames, project):
    rows = [numbers(show, "pose/viewer", "float64", (frames, 7))[...]]
    for name in ("surfaces", "objects"):
        things = len(project[name]) if name in project else None
        rows.append(numbers(show, f"pose/{name}", "float64", (frames, things, 7))[...].reshape(-1, 7))
    for table in rows:
        demand(np.allclose(np.linalg.norm(table[:, 3:], axis=1), 1, atol=1e-9), "a pose's quaternion is not a unit's")


def check_cues(show, frames):
    demand("cue/name" in show and show["cue/name"].ndim == 1, "cue/name is missing")
    demand(h5py.check_string_dtype(show["cue/name"].dtype) is not None, "cue/name is not strings")
    frame = numbers(show, "cue/frame", "int32", (len(show["cue/name"]),))[...]
    demand(((frame >= 0) & (frame < frames)).all(), "a cue's frame is beyond the end")


def check(path):
    with h5py.File(path, "r") as show:
        project = check_root(show)
        check_assets(show)
        frames = check_projector(show)
        check_rig(show)
        check_poses(show, frames, project)
        check_cues(show, frames)
        return f"{path}: whole; images {show['projector/0/images'].shape}, {len(show['asset'])} assets"


def main(paths):
    if not paths:
        print(__doc__, file=sys.stderr)
        return 2
    for path in paths:
        try:
            print(check(path))
        except (Wrong, OSError, KeyError, ValueError) as error:
            print(f"{path}: {error}", file=sys.stderr)
            return 1
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
