"""Meshes as files of every format, written from what their specifications say, and counted again by readers of their own.

A mesh is a list of places and a list of faces, each a list of the places' numbers. Nothing here knows how focalstage reads."""

import json
import math
import struct


def torus(around, across):
    """Of quads."""
    places, faces = [], []
    for i in range(around):
        for j in range(across):
            a, b = 2 * math.pi * i / around, 2 * math.pi * j / across
            radius = 1 + 0.4 * math.cos(b)
            places.append((radius * math.cos(a), 0.4 * math.sin(b), radius * math.sin(a)))
            faces.append([i * across + j, i * across + (j + 1) % across, (i + 1) % around * across + (j + 1) % across,
                          (i + 1) % around * across + j])
    return places, faces


def polygons(count):
    """Fans of three to nine corners side by side, every third one with a notch."""
    places, faces = [], []
    for k in range(count):
        corners = 3 + k % 7
        first = len(places)
        for i in range(corners):
            angle = 2 * math.pi * i / corners
            radius = 0.1 if k % 3 == 0 and corners > 4 and i == 1 else 0.4
            places.append((k + radius * math.cos(angle), radius * math.sin(angle), 0.1 * (k % 5)))
        faces.append(list(range(first, first + corners)))
    return places, faces


def soup(dice, vertices, faces):
    """Triangles as they come: some share edges by threes, some stand twice, some look inwards, some have no area."""
    places = [tuple(dice.uniform(-1, 1) for _ in range(3)) for _ in range(vertices)]
    triangles = [dice.sample(range(vertices), 3) for _ in range(faces)]
    triangles[7] = list(triangles[3])
    triangles[8] = list(reversed(triangles[3]))
    triangles[9] = [triangles[9][0], triangles[9][1], triangles[9][1]]
    return places, triangles


def triangulated(mesh):
    places, faces = mesh
    return places, [[face[0], face[i], face[i + 1]] for face in faces for i in range(1, len(face) - 1)]


def write_obj(file, mesh):
    places, faces = mesh
    lines = [f"v {x:.9g} {y:.9g} {z:.9g}" for x, y, z in places]
    # Every second face counts from the end.
    for k, face in enumerate(faces):
        lines.append("f " + " ".join(str(i - len(places) if k % 2 else i + 1) for i in face))
    file.write_text("\n".join(lines) + "\n")


def write_off(file, mesh):
    places, faces = mesh
    lines = ["OFF", f"{len(places)} {len(faces)} 0"] + [f"{x:.9g} {y:.9g} {z:.9g}" for x, y, z in places]
    lines += [" ".join(map(str, [len(face), *face])) for face in faces]
    file.write_text("\n".join(lines) + "\n")


def write_ply(file, mesh, form, real="float", length="uchar", index="int"):
    places, faces = mesh
    head = (f"ply\nformat {form} 1.0\ncomment made to be counted\nelement vertex {len(places)}\n"
            f"property {real} x\nproperty {real} y\nproperty {real} z\n"
            f"element face {len(faces)}\nproperty list {length} {index} vertex_indices\nend_header\n").encode()
    if form == "ascii":
        rows = [f"{x:.9g} {y:.9g} {z:.9g}" for x, y, z in places] + [" ".join(map(str, [len(f), *f])) for f in faces]
        file.write_bytes(head + ("\n".join(rows) + "\n").encode())
        return
    order = "<" if form == "binary_little_endian" else ">"
    codes = {"float": "f", "double": "d", "uchar": "B", "ushort": "H", "uint": "I", "int": "i"}
    body = b"".join(struct.pack(order + codes[real] * 3, *place) for place in places)
    body += b"".join(struct.pack(f"{order}{codes[length]}{len(face)}{codes[index]}", len(face), *face) for face in faces)
    file.write_bytes(head + body)


def write_stl(file, mesh, binary):
    places, faces = mesh
    if binary:
        body = b"".join(struct.pack("<12fH", 0, 0, 0, *(c for i in face for c in places[i]), 0) for face in faces)
        file.write_bytes(b"solid in name only".ljust(80, b" ") + struct.pack("<I", len(faces)) + body)
        return
    lines = ["solid counted"]
    for face in faces:
        lines += ["facet normal 0 0 0", "outer loop", *("vertex %.9g %.9g %.9g" % places[i] for i in face), "endloop", "endfacet"]
    file.write_text("\n".join([*lines, "endsolid counted"]) + "\n")


def write_glb(file, mesh, index_bytes):
    """Triangles with indices of that many bytes; without, corner by corner."""
    places, faces = mesh
    if not index_bytes:
        places = [places[i] for face in faces for i in face]
    # As they are stored: bounds must be those of the 32 bits.
    stored = [struct.unpack("<3f", struct.pack("<3f", *place)) for place in places]
    points = b"".join(struct.pack("<3f", *place) for place in places)
    accessors = [{"bufferView": 0, "componentType": 5126, "count": len(places), "type": "VEC3",
                  "min": [min(p[k] for p in stored) for k in range(3)], "max": [max(p[k] for p in stored) for k in range(3)]}]
    views = [{"buffer": 0, "byteOffset": 0, "byteLength": len(points)}]
    primitive = {"attributes": {"POSITION": 0}}
    data = points
    if index_bytes:
        kind, code = {1: (5121, "B"), 2: (5123, "H"), 4: (5125, "I")}[index_bytes]
        indices = struct.pack(f"<{3 * len(faces)}{code}", *(i for face in faces for i in face))
        accessors.append({"bufferView": 1, "componentType": kind, "count": 3 * len(faces), "type": "SCALAR"})
        views.append({"buffer": 0, "byteOffset": len(points), "byteLength": len(indices)})
        primitive["indices"] = 1
        data += indices
    data += bytes(-len(data) % 4)
    text = json.dumps({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
                       "meshes": [{"primitives": [primitive]}], "accessors": accessors, "bufferViews": views,
                       "buffers": [{"byteLength": len(data)}]}).encode()
    text += b" " * (-len(text) % 4)
    file.write_bytes(struct.pack("<4sII", b"glTF", 2, 28 + len(text) + len(data)) + struct.pack("<I4s", len(text), b"JSON") + text
                     + struct.pack("<I4s", len(data), b"BIN\0") + data)
