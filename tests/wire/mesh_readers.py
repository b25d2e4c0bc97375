"""How many triangles a mesh file holds, told from its bytes alone: polygons count as the triangles they become."""

import json
import struct


def triangles_of(corner_counts):
    return sum(count - 2 for count in corner_counts)


def count_obj(data):
    return triangles_of(len(line.split()) - 1 for line in data.decode().splitlines() if line.startswith("f "))


def count_off(data):
    words = data.decode().split()
    vertices, faces = int(words[1]), int(words[2])
    at, counts = 4 + 3 * vertices, []
    for _ in range(faces):
        counts.append(int(words[at]))
        at += 1 + counts[-1]
    return triangles_of(counts)


PLY_SIZES = {"char": "b", "uchar": "B", "short": "h", "ushort": "H", "int": "i", "uint": "I", "float": "f", "double": "d",
             "int8": "b", "uint8": "B", "int16": "h", "uint16": "H", "int32": "i", "uint32": "I", "float32": "f", "float64": "d"}


def count_ply(data):
    """Walks through every element as the header says, to the last byte."""
    head, body = data.split(b"end_header\n", 1)
    elements, form = [], None
    for line in head.decode().splitlines():
        words = line.split()
        if words[0] == "format":
            form = words[1]
        elif words[0] == "element":
            elements.append((words[1], int(words[2]), []))
        elif words[0] == "property":
            elements[-1][2].append(words[1:-1])
    if form == "ascii":
        rows = iter(body.decode().split())
        take = lambda _: int(float(next(rows)))
    else:
        order, place = ("<" if form == "binary_little_endian" else ">"), [0]

        def take(kind):
            code = order + PLY_SIZES[kind]
            value, = struct.unpack_from(code, body, place[0])
            place[0] += struct.calcsize(code)
            return value
    counts = []
    for name, count, properties in elements:
        for _ in range(count):
            for kind in properties:
                if kind[0] != "list":
                    take(kind[0])
                    continue
                length = take(kind[1])
                for _ in range(length):
                    take(kind[2])
                if name == "face":
                    counts.append(length)
    assert next(rows, None) is None if form == "ascii" else place[0] == len(body), "more than the header says"
    return triangles_of(counts)


def count_stl(data):
    if len(data) >= 84 and len(data) == 84 + 50 * struct.unpack_from("<I", data, 80)[0]:
        return struct.unpack_from("<I", data, 80)[0]
    return data.split().count(b"endfacet")


def count_gltf(data):
    """What the nodes of the scene draw; a mesh counts at each node that has it."""
    if data[:4] == b"glTF":
        length, = struct.unpack_from("<I", data, 12)
        data = data[20 : 20 + length]
    gltf = json.loads(data)

    def of_primitive(primitive):
        accessor = primitive.get("indices", primitive["attributes"]["POSITION"])
        corners, mode = gltf["accessors"][accessor]["count"], primitive.get("mode", 4)
        return {4: corners // 3, 5: corners - 2, 6: corners - 2}.get(mode, 0)

    def of_node(index):
        node = gltf["nodes"][index]
        own = sum(map(of_primitive, gltf["meshes"][node["mesh"]]["primitives"])) if "mesh" in node else 0
        return own + sum(map(of_node, node.get("children", [])))

    return sum(map(of_node, gltf["scenes"][gltf.get("scene", 0)]["nodes"]))


COUNTS = {".obj": count_obj, ".off": count_off, ".ply": count_ply, ".stl": count_stl, ".glb": count_gltf, ".gltf": count_gltf}


def count_triangles(file):
    return COUNTS[file.suffix](file.read_bytes())
