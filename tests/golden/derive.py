"""What a show must hold, worked out from its project by hand, so to speak: plain formulas of design section 5 and 6, one
pixel or exposure at a time, for planes, folds, steps and boxes. Shares nothing with the engine but the project file."""

import functools
import importlib.util
import math
import pathlib
from fractions import Fraction
import zlib

import numpy

# Rigid motions ------------------------------------------------------------------------------------------------------


def turned(q, v):
    """The vector v turned by the quaternion x y z w."""
    axis, v = numpy.array(q[:3], float), numpy.array(v, float)
    return v + 2.0 * numpy.cross(axis, numpy.cross(axis, v) + q[3] * v)


def pose_of(thing, time_s):
    """Position and quaternion at a time: between keys linear and slerp."""
    keys = thing.get("keys")
    if not keys:
        return numpy.array(thing["position_m"], float), thing.get("rotation_xyzw", [0, 0, 0, 1])
    if time_s <= keys[0]["time_s"]:
        return numpy.array(keys[0]["position_m"], float), keys[0]["rotation_xyzw"]
    for a, b in zip(keys, keys[1:]):
        if time_s <= b["time_s"]:
            s = (time_s - a["time_s"]) / (b["time_s"] - a["time_s"])
            position = (1 - s) * numpy.array(a["position_m"]) + s * numpy.array(b["position_m"])
            return position, slerp(a["rotation_xyzw"], b["rotation_xyzw"], s)
    return numpy.array(keys[-1]["position_m"], float), keys[-1]["rotation_xyzw"]


def slerp(a, b, s):
    a, b = numpy.array(a, float), numpy.array(b, float)
    cosine = float(a @ b)
    if cosine < 0:
        b, cosine = -b, -cosine
    if cosine > 1 - 1e-12:
        return list(a)
    angle = math.acos(cosine)
    return list((math.sin((1 - s) * angle) * a + math.sin(s * angle) * b) / math.sin(angle))


# Shapes as flat faces -----------------------------------------------------------------------------------------------


class Face:
    """A rectangle: a corner, two sides, so that a point is corner + u side_u + v side_v with u and v in [0, 1]."""

    def __init__(self, name, corner, side_u, side_v, thing):
        self.name, self.corner, self.side_u, self.side_v, self.thing = name, corner, side_u, side_v, thing
        normal = numpy.cross(side_u, side_v)
        self.normal = normal / numpy.linalg.norm(normal)

    def meet(self, start, way):
        """(distance along the way, u, v), or None."""
        slope = float(self.normal @ way)
        if abs(slope) < 1e-12:
            return None
        t = float(self.normal @ (self.corner - start)) / slope
        d = start + t * way - self.corner
        u = float(d @ self.side_u) / float(self.side_u @ self.side_u)
        v = float(d @ self.side_v) / float(self.side_v @ self.side_v)
        return (t, u, v) if t > 1e-9 and 0 <= u <= 1 and 0 <= v <= 1 else None


def faces_of(thing, time_s):
    mesh = thing["mesh"]
    position, q = pose_of(thing, time_s)
    scale = thing.get("scale", 1)
    found = []

    def add(corner, side_u, side_v):
        place = [turned(q, scale * numpy.array(side, float)) for side in (corner, side_u, side_v)]
        found.append(Face(thing["name"], place[0] + position, place[1], place[2], thing))

    kind = mesh.get("primitive")
    if kind == "plane":
        w, h = mesh["size_m"]
        add((-w / 2, -h / 2, 0), (w, 0, 0), (0, h, 0))
    elif kind == "box":
        x, y, z = mesh["size_m"]
        for sign in (-0.5, 0.5):
            add((sign * x, -y / 2, -z / 2), (0, y, 0), (0, 0, z))
            add((-x / 2, sign * y, -z / 2), (0, 0, z), (x, 0, 0))
            add((-x / 2, -y / 2, sign * z), (x, 0, 0), (0, y, 0))
    elif kind == "corner":
        w, h = mesh["size_m"]
        half = math.radians(mesh["angle_deg"]) / 2  # each wing stands so far from +Z
        for side in (-1, 1):
            add((0, -h / 2, 0), (side * w * math.sin(half), 0, w * math.cos(half)), (0, h, 0))
    elif kind == "step":
        w, h = mesh["size_m"]
        d = mesh["depth_m"]
        add((-w / 2, -h / 2, 0), (w / 2, 0, 0), (0, h, 0))
        add((0, -h / 2, -d), (w / 2, 0, 0), (0, h, 0))
        add((0, -h / 2, -d), (0, 0, d), (0, h, 0))
    elif "file" in mesh:
        for name, corner, side_u, side_v, gray in figures(mesh["file"]).rectangles(time_s):
            add(corner, side_u, side_v)
            found[-1].name, found[-1].thing = name, {**thing, "appearance": {"unlit": [gray] * 3}}
    return found  # curved meshes have none


@functools.lru_cache
def figures(file):
    """What wrote a glTF file of rectangles that move, assets/NAME.glb: NAME.py of a sample in this folder."""
    path = next(pathlib.Path(__file__).parent.glob(f"*/{pathlib.Path(file).stem}.py"))
    spec = importlib.util.spec_from_file_location(path.stem, path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def luminance(rgb):
    return 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2]


@functools.lru_cache
def picture(file):
    """A PNG of a sample, 8-bit RGB without filters, as linear light: rows from the top."""
    path = next((pathlib.Path(__file__).parents[2] / "projects").glob(f"*/{file}"))
    data, at, packed = path.read_bytes(), 8, b""
    while at < len(data):
        size, kind = int.from_bytes(data[at:at + 4], "big"), data[at + 4:at + 8]
        body = data[at + 8:at + 8 + size]
        if kind == b"IHDR":
            width, height = int.from_bytes(body[:4], "big"), int.from_bytes(body[4:8], "big")
            assert body[8:] == bytes([8, 2, 0, 0, 0])
        packed += body if kind == b"IDAT" else b""
        at += size + 12
    rows = numpy.frombuffer(zlib.decompress(packed), numpy.uint8).reshape(height, 1 + 3 * width)
    assert not rows[:, 0].any()
    srgb = rows[:, 1:].reshape(height, width, 3) / 255.0
    return numpy.where(srgb <= 0.04045, srgb / 12.92, ((srgb + 0.055) / 1.055) ** 2.4)


def texel_at(file, uv):
    """Bilinear between the centres of texels, v from below."""
    texels = picture(file)
    height, width = texels.shape[:2]
    x, y = uv[0] * width - 0.5, (1 - uv[1]) * height - 0.5
    left, top = math.floor(x), math.floor(y)

    def at(row, column):
        return texels[min(max(row, 0), height - 1), min(max(column, 0), width - 1)]

    upper = (left + 1 - x) * at(top, left) + (x - left) * at(top, left + 1)
    lower = (left + 1 - x) * at(top + 1, left) + (x - left) * at(top + 1, left + 1)
    return (top + 1 - y) * upper + (y - top) * lower


@functools.lru_cache
def pictures():
    """What wrote the pictures of the sample that has some."""
    path = pathlib.Path(__file__).parent / "moving-pictures/pictures.py"
    spec = importlib.util.spec_from_file_location(path.stem, path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def picture_of(image, time_s):
    """The file of a picture, or of the one that a sequence shows, by whole numbers alone; time_s is a Fraction."""
    if "count" not in image:
        return image["file"]
    exact = [Fraction(str(image.get(key, 0))) for key in ("start_s", "rate_hz")]
    k, count = math.floor((time_s - exact[0]) * exact[1]), image["count"]
    end = image.get("loop", "loop")
    if k < 0:
        k = 0 if end != "once" else None
    elif end == "loop":
        k %= count
    elif end == "ping-pong":
        k %= 2 * count - 2
        k = min(k, 2 * count - 2 - k)
    elif k >= count:
        k = count - 1 if end == "hold" else None
    if k is None:
        return None
    digits = image["file"].count("#")
    return image["file"].replace("#" * digits, f"{image.get('first', 1) + k:0{digits}}")


def nearest(faces, start, way, there=lambda face, u, v: True):
    best = None
    for face in faces:
        met = face.meet(start, way)
        if met and there(face, met[1], met[2]) and (best is None or met[0] < best[1][0]):
            best = (face, met)
    return best


# A project ----------------------------------------------------------------------------------------------------------


class Room:
    def __init__(self, project, frame):
        self.project = project
        self.time_s = frame / project["frames"]["rate_hz"]
        self.exact_s = frame / Fraction(str(project["frames"]["rate_hz"]))
        self.surfaces = [f for s in project["surfaces"] for f in faces_of(s, self.time_s)]
        self.objects = [f for o in project["objects"] for f in faces_of(o, self.time_s)]
        self.powers_d = project["slices"]["powers_d"]
        viewer = project["viewer"]
        assert viewer["position_m"] == [0, 0, 0] and viewer["rotation_xyzw"] == [0, 0, 0, 1]
        half_m = viewer["interpupillary_mm"] / 2000
        self.pupils = {"left": numpy.array([-half_m, 0, 0]), "right": numpy.array([half_m, 0, 0])}
        self.lens_to_pupil_m = project["glasses"]["lens_to_pupil_mm"] / 1000

    def lens(self, eye):
        return self.pupils[eye] + [0, 0, -self.lens_to_pupil_m]

    def pixel_ray(self, x, y):
        """From the projector through the middle of pixel x, y."""
        p = self.project["projectors"][0]
        way = [(x + 0.5 - p["cx_px"]) / p["fx_px"], -(y + 0.5 - p["cy_px"]) / p["fy_px"], -1]
        return numpy.array(p["position_m"], float), turned(p["rotation_xyzw"], way)

    def pixel_of(self, point):
        p = self.project["projectors"][0]
        q = p["rotation_xyzw"]
        local = turned([-q[0], -q[1], -q[2], q[3]], numpy.array(point, float) - p["position_m"])
        return (int(math.floor(p["cx_px"] + p["fx_px"] * local[0] / -local[2])),
                int(math.floor(p["cy_px"] - p["fy_px"] * local[1] / -local[2])))

    def color(self, face, u, v, look):
        """The gray of an object where a look meets it."""
        appearance = face.thing.get("appearance", {})
        if "unlit" in appearance:
            return appearance["unlit"][0]
        if "checker" in appearance:
            checker = appearance["checker"]
            square = math.floor(u * checker["squares"][0]) + math.floor(v * checker["squares"][1])
            return checker["a" if square % 2 == 0 else "b"][0]
        if "image" in appearance:
            image = appearance["image"]
            assert image["filter"] == "nearest" and not image.get("lit")
            number = pictures().texel(picture_of(image, self.exact_s), u, v)[0]
            if image.get("color_space", "srgb") == "linear":
                return number
            return number / 12.92 if number <= 0.04045 else ((number + 0.055) / 1.055) ** 2.4
        normal = face.normal if face.normal @ look < 0 else -face.normal
        light = 0.0
        for lamp in self.project["lights"]:
            if lamp["kind"] == "sky":
                light += lamp["intensity"] * lamp["color"][0]
            elif lamp["kind"] == "sun":
                way = numpy.array(lamp["direction"], float)
                light += lamp["intensity"] * lamp["color"][0] * max(0.0, -normal @ way / numpy.linalg.norm(way))
        return light

    def there(self, face, u, v):
        """Whether an object is there at this place of its picture, not cut away."""
        image = face.thing.get("appearance", {}).get("image")
        if not image:
            return True
        file = picture_of(image, self.exact_s)
        return file is not None and pictures().texel(file, u, v)[1] >= image.get("alpha_cutoff", 0)

    def weight(self, n, wanted_d):
        """The share of slice n under the linear rule."""
        below = [p for p in self.powers_d if p <= wanted_d]
        above = [p for p in self.powers_d if p > wanted_d]
        own = self.powers_d[n]
        if not below or not above:
            return 1.0 if own == (min(above) if above else max(below)) else 0.0
        a, b = max(below), min(above)
        return {a: (b - wanted_d) / (b - a), b: (wanted_d - a) / (b - a)}.get(own, 0.0)

    def derive(self, x, y, eye, n, light):
        """The code of pixel x, y in the image of eye and slice n (None: a light image), and the way to it."""
        start, way = self.pixel_ray(x, y)
        hit = nearest(self.surfaces, start, way)
        if not hit:
            return 0, "the pixel's ray meets no surface"
        face, (t, u, v) = hit
        point = start + t * way
        said = f"the ray meets {face.name} at {numpy.round(point, 6).tolist()}"
        lit, content, weight = 0.0, 0.0, 0.0
        if light:
            lit = face.thing.get("illumination", 0)
            said += f", lit {lit:g} at zero power"
        if n is not None:
            content, weight, how = self.content(face, point, eye, n)
            said += how
        total, how = self.given(face, point, (u, v), content, weight, lit)
        said += how
        place = self.place_of(min(1.0, max(0.0, total)))
        code = math.floor(255 * place + 0.5)
        return code, f"{said}; round(255 x {place:.6f}) = {code}"

    def given(self, face, point, uv, content, weight, lit):
        """The light that has to be given so that content and lit come back (docs/colour.md), and the way to it."""
        asked = self.project["slices"].get("compensation", {"mode": "off"})
        if asked["mode"] == "off":
            return content + lit, ""
        projector = self.project["projectors"][0]
        density = 1.0
        if asked["mode"] == "even":
            q = projector["rotation_xyzw"]
            away = numpy.array(point) - projector["position_m"]
            depth = -turned([-q[0], -q[1], -q[2], q[3]], away)[2]
            density = abs(float(face.normal @ away)) / depth**3 * asked["reference_m"] ** 2
        albedo = luminance(self.albedo(face, uv))
        black = projector.get("black_level", 0)
        leak = black * (len(self.powers_d) + (0 if 0 in self.powers_d or not self.lit_at_all() else 1))
        total = (asked["white"] * content / (albedo * density) - leak * weight) / (1 - black) + asked["white"] * lit / density
        return total, (f"; albedo {albedo:.6f}, density {density:.6f}, leak {leak:g}: given {total:.6f} for content {content:.6f} "
                       f"of weight {weight:.6f} and light {lit:g}")

    def lit_at_all(self):
        return any(s.get("illumination", 0) > 0 for s in self.project["surfaces"])

    def albedo(self, face, uv):
        albedo = face.thing.get("albedo", [1, 1, 1])
        return texel_at(albedo["file"], uv) if isinstance(albedo, dict) else albedo

    def place_of(self, light):
        """Where along the codes, 0 to 1, the projector gives this light."""
        projector = self.project["projectors"][0]
        transfer = projector.get("transfer")
        if not transfer:
            return light ** (1 / projector["gamma"])
        return float(numpy.interp(light, transfer, numpy.linspace(0, 1, len(transfer))))

    def content(self, face, point, eye, n):
        pupil, lens = self.pupils[eye], self.lens(eye)
        sight = nearest(self.surfaces, pupil, point - pupil)
        if sight and sight[1][0] < 1 - 1e-9:
            return 0.0, 0.0, f"; {sight[0].name} hides it from the {eye} eye"
        d_p = lens[2] - point[2]
        look = (point - lens) + (1 - self.powers_d[n] * d_p) * (lens - pupil)
        met = nearest(self.objects, pupil, look, self.there)
        said = f"; d_p = {d_p:.6f} m, look {numpy.round(look, 6).tolist()}"
        if not met:
            return 0.0, 0.0, said + " meets no object"
        target, (t, u, v) = met
        seen = pupil + t * look
        depth = target.thing.get("depth", {"mode": "placed"})
        vergence_d = depth["vergence_d"] if depth["mode"] == "fixed" else 1 / (lens[2] - seen[2])
        slope = float(face.normal @ look)
        t_plane = float(face.normal @ (face.corner - pupil)) / slope
        d_plane = lens[2] - (pupil + t_plane * look)[2]
        wanted_d = 1 / d_plane - vergence_d
        weight, color = self.weight(n, wanted_d), self.color(target, u, v, look)
        said += (f" meets {target.name} at u = {u:.4f}, v = {v:.4f}: gray {color:.6f}, 1/d_v = {vergence_d:.6f} D; wanted "
                 f"1/{d_plane:.6f} - 1/d_v = {wanted_d:.6f} D: weight {weight:.6f}")
        return weight * color, weight, said


def exposure(project, eye, power_d):
    """Start of the exposure at a power of a sine sweep, and the way to it."""
    sweep, projector = project["sweep"], project["projectors"][0]
    period_s = 1 / sweep["frequency_hz"]
    middle, half = (sweep["min_power_d"] + sweep["max_power_d"]) / 2, (sweep["max_power_d"] - sweep["min_power_d"]) / 2
    rising_s = math.acos((middle - power_d) / half) / (2 * math.pi) * period_s
    centre_s = rising_s if eye == "left" else period_s - rising_s
    length_s = projector.get("exposure_ms", 1000 / projector["frames_per_second"]) / 1000
    side = "" if eye == "left" else "T - "
    how = f"{side}T/(2 pi) acos(({middle:g} - {power_d:g})/{half:g}) - e/2 with T = 1/{sweep['frequency_hz']:g} s, e = {length_s:g} s"
    return centre_s - length_s / 2, how
