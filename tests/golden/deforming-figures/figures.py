#!/usr/bin/python3
"""The figures of the deforming sample: as formulas of time, which tests/golden/derive.py takes for the truth, and as
the glTF file that the sample shows. Neither is read from the other.

    figures.py write      writes assets/figures.glb
    figures.py check      for ctest: the file is what this would write

Every figure stays a rectangle, so that one formula says where it is:

    root     a rectangle that stands, on the skin's joint "ground"
    flag     beside it, wholly on the joint "hinge", which turns away by 50 degrees in a second (LINEAR rotation)
    tail     above it, half on "ground" and half on "lift", which rises by 80 mm (CUBICSPLINE translation)
    bar      two morph targets, one widens it, one takes it away (CUBICSPLINE weights: t^3 and t)
    curtain  a morph target in a sparse accessor lifts it (STEP weights)
    runner   a node that jumps at half a second (STEP translation)
"""

import json
import math
import pathlib
import struct
import sys

HERE = pathlib.Path(__file__).resolve().parent
FILE = HERE / "assets" / "figures.glb"
GRAYS = {"root": 0.9, "flag": 0.7, "tail": 0.5, "bar": 0.8, "curtain": 0.4, "runner": 0.6}
HINGE = (-0.10, 0.0, -0.5)

# corner, side along u, side along v, in metres at rest
REST = {
    "root": ((-0.16, -0.03, -0.5), (0.06, 0, 0), (0, 0.06, 0)),
    "flag": ((HINGE[0], -0.03, -0.5), (0.06, 0, 0), (0, 0.06, 0)),
    "tail": ((-0.16, 0.05, -0.55), (0.06, 0, 0), (0, 0.04, 0)),
    "bar": ((0.02, -0.03, -0.45), (0.03, 0, 0), (0, 0.05, 0)),
    "curtain": ((0.0, 0.05, -0.6), (0.06, 0, 0), (0, 0.04, 0)),
    "runner": ((0.10, -0.06, -0.5), (0.04, 0, 0), (0, 0.05, 0)),
}


# As formulas ----------------------------------------------------------------------------------------------------------


def added(a, b):
    return tuple(x + y for x, y in zip(a, b))


def rectangles(time_s):
    """(name, corner, side_u, side_v, gray) of every figure at a time; what moves, moves in the first second."""
    t = min(max(time_s, 0.0), 1.0)
    now = dict(REST)
    turn = math.radians(50) * t
    corner, _, side_v = REST["flag"]
    now["flag"] = (corner, (0.06 * math.cos(turn), 0, -0.06 * math.sin(turn)), side_v)
    corner, side_u, side_v = REST["tail"]
    now["tail"] = (added(corner, (0, 0.5 * 0.08 * (3 * t**2 - 2 * t**3), 0)), side_u, side_v)
    corner, side_u, side_v = REST["bar"]
    now["bar"] = (added(corner, (0, 0, -0.1 * t)), (0.03 + 0.05 * t**3, 0, 0), side_v)
    corner, side_u, side_v = REST["curtain"]
    now["curtain"] = (corner, side_u, (0, 0.04 + (0.05 if t >= 0.5 else 0.0), 0))
    corner, side_u, side_v = REST["runner"]
    now["runner"] = (added(corner, (0.05 if t >= 0.5 else 0.0, 0, 0)), side_u, side_v)
    return [(name, *place, GRAYS[name]) for name, place in now.items()]


# As a file ------------------------------------------------------------------------------------------------------------


class Buffer:
    def __init__(self):
        self.data, self.views, self.accessors = b"", [], []

    def view(self, data):
        self.data += b"\0" * (-len(self.data) % 4)
        self.views.append({"buffer": 0, "byteOffset": len(self.data), "byteLength": len(data)})
        self.data += data
        return len(self.views) - 1

    def accessor(self, kind, values, component_type=5126, **more):
        code = {5126: "f", 5123: "H", 5121: "B"}[component_type]
        size = {"SCALAR": 1, "VEC3": 3, "VEC4": 4, "MAT4": 16}[kind]
        entry = {"bufferView": self.view(struct.pack(f"<{len(values)}{code}", *values)), "componentType": component_type,
                 "count": len(values) // size, "type": kind, **more}
        if kind == "VEC3":
            rows = [struct.unpack("<3f", struct.pack("<3f", *values[i:i + 3])) for i in range(0, len(values), 3)]
            entry["min"], entry["max"] = [min(c) for c in zip(*rows)], [max(c) for c in zip(*rows)]
        self.accessors.append(entry)
        return len(self.accessors) - 1

    def sparse(self, count, places, values):
        rows = [values[i:i + 3] for i in range(0, len(values), 3)] + [(0.0, 0.0, 0.0)]
        rows = [struct.unpack("<3f", struct.pack("<3f", *row)) for row in rows]
        self.accessors.append({
            "componentType": 5126, "count": count, "type": "VEC3",
            "min": [min(c) for c in zip(*rows)], "max": [max(c) for c in zip(*rows)],
            "sparse": {"count": len(places),
                       "indices": {"bufferView": self.view(struct.pack(f"<{len(places)}H", *places)),
                                   "componentType": 5123},
                       "values": {"bufferView": self.view(struct.pack(f"<{len(values)}f", *values))}}})
        return len(self.accessors) - 1


def corners(name):
    corner, side_u, side_v = REST[name]
    return [added(corner, move) for move in ((0, 0, 0), side_u, added(side_u, side_v), side_v)]


def flat(rows):
    return [number for row in rows for number in row]


def primitive(buffer, name, materials):
    return {"attributes": {"POSITION": buffer.accessor("VEC3", flat(corners(name)))},
            "indices": buffer.accessor("SCALAR", [0, 1, 2, 0, 2, 3], 5123), "material": materials[name]}


def moved(x, y, z):
    return [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, x, y, z, 1]


def skinned_mesh(buffer, materials):
    """Shares as bytes where they are whole, as floats where they are halves."""
    mesh = {"name": "figure", "primitives": []}
    for name, joints, shares in (("root", [0, 0, 0, 0], [255, 0, 0, 0]), ("flag", [1, 0, 0, 0], [255, 0, 0, 0]),
                                 ("tail", [0, 2, 0, 0], [0.5, 0.5, 0, 0])):
        made = primitive(buffer, name, materials)
        made["attributes"]["JOINTS_0"] = buffer.accessor("VEC4", joints * 4, 5121)
        whole = {"component_type": 5121, "normalized": True} if shares[0] == 255 else {}
        made["attributes"]["WEIGHTS_0"] = buffer.accessor("VEC4", shares * 4, **whole)
        mesh["primitives"].append(made)
    return mesh


def bar_mesh(buffer, materials):
    made = primitive(buffer, "bar", materials)
    made["targets"] = [{"POSITION": buffer.accessor("VEC3", [0, 0, 0, 0.05, 0, 0, 0.05, 0, 0, 0, 0, 0])},
                       {"POSITION": buffer.accessor("VEC3", [0, 0, -0.1] * 4)}]
    return {"name": "bar", "primitives": [made], "weights": [0, 0]}


def curtain_mesh(buffer, materials):
    made = primitive(buffer, "curtain", materials)
    made["targets"] = [{"POSITION": buffer.sparse(4, [2, 3], [0, 0.05, 0, 0, 0.05, 0])}]
    return {"name": "curtain", "primitives": [made]}


def animation(buffer, node_of):
    half = math.radians(25)
    zero = (0, 0, 0)
    moves = [
        ("hinge", "rotation", "LINEAR", "VEC4", [0, 1], [0, 0, 0, 1, 0, math.sin(half), 0, math.cos(half)]),
        ("lift", "translation", "CUBICSPLINE", "VEC3", [0, 1], flat([zero, zero, zero, zero, (0, 0.08, 0), zero])),
        ("bar", "weights", "CUBICSPLINE", "SCALAR", [0, 1], [0, 0, 0, 0, 0, 1, 3, 1, 1, 1, 0, 0]),
        ("curtain", "weights", "STEP", "SCALAR", [0, 0.5], [0, 1]),
        ("runner", "translation", "STEP", "VEC3", [0, 0.5], [0, 0, 0, 0.05, 0, 0]),
    ]
    made = {"name": "all", "samplers": [], "channels": []}
    for node, path, interpolation, kind, times, values in moves:
        made["channels"].append({"sampler": len(made["samplers"]), "target": {"node": node_of[node], "path": path}})
        time = buffer.accessor("SCALAR", times)
        buffer.accessors[time].update(min=[times[0]], max=[times[-1]])
        value = buffer.accessor(kind, values)
        if kind == "VEC3":
            del buffer.accessors[value]["min"], buffer.accessors[value]["max"]
        made["samplers"].append({"input": time, "output": value, "interpolation": interpolation})
    return made


def glb():
    buffer = Buffer()
    names = list(GRAYS)
    materials = {name: i for i, name in enumerate(names)}
    meshes = [skinned_mesh(buffer, materials), bar_mesh(buffer, materials), curtain_mesh(buffer, materials),
              {"name": "runner", "primitives": [primitive(buffer, "runner", materials)]}]
    nodes = [{"name": "ground", "children": [1, 2]}, {"name": "hinge", "translation": list(HINGE)},
             {"name": "lift"}, {"name": "figure", "mesh": 0, "skin": 0}, {"name": "bar", "mesh": 1},
             {"name": "curtain", "mesh": 2}, {"name": "runner", "mesh": 3}]
    node_of = {node["name"]: i for i, node in enumerate(nodes)}
    binds = moved(0, 0, 0) + moved(*[-c for c in HINGE]) + moved(0, 0, 0)
    document = {
        "asset": {"version": "2.0"},
        "extensionsUsed": ["KHR_materials_unlit"],
        "scene": 0,
        "scenes": [{"nodes": [0, 3, 4, 5, 6]}],
        "nodes": nodes,
        "meshes": meshes,
        "materials": [{"name": name, "pbrMetallicRoughness": {"baseColorFactor": [gray, gray, gray, 1]},
                       "extensions": {"KHR_materials_unlit": {}}} for name, gray in GRAYS.items()],
        "skins": [{"joints": [0, 1, 2], "inverseBindMatrices": buffer.accessor("MAT4", binds)}],
        "animations": [animation(buffer, node_of)],
    }
    document.update(accessors=buffer.accessors, bufferViews=buffer.views, buffers=[{"byteLength": len(buffer.data)}])
    text = json.dumps(document, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    data = buffer.data + b"\0" * (-len(buffer.data) % 4)
    chunks = struct.pack("<II", len(text), 0x4E4F534A) + text + struct.pack("<II", len(data), 0x004E4942) + data
    return struct.pack("<III", 0x46546C67, 2, 12 + len(chunks)) + chunks


def main():
    if sys.argv[1:] == ["write"]:
        FILE.write_bytes(glb())
    elif sys.argv[1:] == ["check"]:
        sys.exit(0 if FILE.read_bytes() == glb() else f"{FILE} is not what figures.py writes")
    else:
        sys.exit(__doc__)


if __name__ == "__main__":
    main()
