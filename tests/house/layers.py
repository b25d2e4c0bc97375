#!/usr/bin/python3
"""Holds every #include of the tree against the table in cmake/Rooms.cmake.

The table says which rooms a room may see; what those see, it sees too. Beside that: the layers never look down, core
touches no file, socket, clock or device, window libraries stay in editor/window, and a library's headers are seen
only by rooms that link it. Prints one line per break and exits 1 if there is any.
"""

import argparse
import pathlib
import re
import sys

LAYERS = ["core", "io", "devices", "editor"]
SOURCES = {".h", ".cpp"}

# What core must not know: files, streams to the outside, sockets, clocks, devices, processes.
CORE_FORBIDDEN = re.compile(
    r"^(fstream|filesystem|iostream|chrono|ctime|time\.h|stdio_ext\.h|unistd\.h|fcntl\.h|netdb\.h|poll\.h|termios\.h"
    r"|signal\.h|csignal|dlfcn\.h|sys/.*|netinet/.*|arpa/.*|linux/.*|boost/asio.*)$"
)
WINDOW_ONLY = re.compile(r"^(imgui|backends/imgui|imconfig|misc/cpp/imgui|vtk|GLFW/|GL/|glad/|EGL/|X11/)")

# Headers of a library -> the target that a room must link to see them.
LIBRARY_OF = [
    (r"^tbb/|^oneapi/tbb/", "TBB::tbb"),
    (r"^embree3/", "embree"),
    (r"^nlohmann/", "nlohmann_json::nlohmann_json"),
    (r"^valijson/", "ValiJSON::valijson"),
    (r"^png\.h$", "PNG::PNG"),
    (r"^tiny_gltf\.h$", "TinyGLTF::TinyGLTF"),
    (r"^openssl/", "OpenSSL::Crypto"),
    (r"^(hdf5|H5[A-Za-z]*)\.h$", "hdf5::hdf5"),
    (r"^cairo", "cairo::cairo"),
    (r"^lo/", "liblo::liblo"),
    (r"^libdeflate\.h$", "deflate::deflate"),
    (r"^CLI/", "CLI11::CLI11"),
    (r"^boost/", "Boost::headers"),
    (r"^spdlog/", "spdlog::spdlog"),
    (r"^glm/", "glm::glm"),
    (r"^Eigen/", "Eigen3::Eigen"),
    (r"^opencv2/aruco", "opencv::aruco"),
    (r"^opencv2/calib3d", "opencv::calib3d"),
    (r"^opencv2/", "opencv::core"),
    (r"^(grpc|grpcpp|grpc\+\+)/", "gRPC::grpc++"),
    (r"^google/protobuf/", "protobuf::libprotobuf"),
    (r"^imgui|^backends/imgui", "imgui::imgui"),
    (r"^vtk", "vtk::vtk"),
    (r"^GLFW/", "glfw::glfw"),
    (r"^epoxy/", "epoxy::epoxy"),
    (r"^simavr/", "simavr, which is the tests' alone"),
    (r"^hidapi/", "hidapi::hidraw"),
    (r"^xf86drm", "drm::drm"),
    (r"^libusb", "usb::usb"),
    (r"^umockdev", "umockdev::umockdev"),
]

# Rooms of devices/ that are more than one device, and what all others may see besides core.
NO_DRIVERS = {"devices/player", "devices/rig", "devices/catalog", "devices/runtime", "devices/service"}
SEEN_BY_DRIVERS = {"devices/roles", "devices/serial", "devices/usb", "devices/display", "devices/planes"}

INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*([<"])([^>"]+)[>"]', re.MULTILINE)


class Room:
    def __init__(self, name, words):
        self.name = name
        self.layer = name.split("/")[0]
        parts = {"USES": [], "LIBS": [], "PRIVATE_LIBS": [], "LABELS": [], "NAME": []}
        key = None
        for word in words:
            if word in parts:
                key = word
            elif key:
                parts[key].append(word)
        self.uses = parts["USES"]
        self.libs = parts["LIBS"]
        self.private_libs = parts["PRIVATE_LIBS"]


def read_calls(path, function):
    """The calls of one CMake function in a file, as Rooms in order."""
    text = re.sub(r"#.*", "", path.read_text())
    calls = re.findall(rf"\b{function}\s*\(([^)]*)\)", text)
    return [Room(words[0], words[1:]) for words in (call.split() for call in calls) if words]


def reach(rooms, names):
    """`names` and all that they see."""
    seen, todo = set(), list(names)
    while todo:
        name = todo.pop()
        if name in seen:
            continue
        seen.add(name)
        if name in rooms:
            todo += rooms[name].uses
    return seen


def check_table(table):
    breaks, above = [], {}
    for room in table:
        if room.layer not in LAYERS:
            breaks.append(f"cmake/Rooms.cmake: {room.name} stands in no layer ({', '.join(LAYERS)})")
        for used in room.uses:
            if used not in above:
                breaks.append(f"cmake/Rooms.cmake: {room.name} uses {used}, which does not stand above it")
            elif LAYERS.index(used.split("/")[0]) > LAYERS.index(room.layer):
                breaks.append(f"cmake/Rooms.cmake: {room.name} uses {used} of a layer below its own")
        above[room.name] = room
    for room in table:
        if room.layer == "devices" and room.name not in NO_DRIVERS:
            for used in room.uses:
                if not used.startswith("core/") and used not in SEEN_BY_DRIVERS:
                    breaks.append(f"cmake/Rooms.cmake: {room.name} is a driver and sees core, roles and transports, not {used}")
    return breaks


def room_of(relative, rooms):
    """The room a source belongs to: its own folder."""
    folder = relative.parent.as_posix()
    return folder if folder in rooms else None


def line_of(text, offset):
    return text.count("\n", 0, offset) + 1


def linked_by_hand(root, name):
    """What a room's own room.cmake links."""
    extra = root / name / "room.cmake"
    return set(re.findall(r"[A-Za-z_]+::[A-Za-z+_]+", extra.read_text())) if extra.exists() else set()


def check_library(root, header, room, rooms):
    visible = set(room.libs) | set(room.private_libs) | linked_by_hand(root, room.name)
    for name in reach(rooms, room.uses):
        if name in rooms:
            visible |= set(rooms[name].libs) | linked_by_hand(root, name)
    for pattern, library in LIBRARY_OF:
        if re.match(pattern, header) and library not in visible:
            return f"includes <{header}>, but {room.name} does not link {library}"
    return None


def check_source(root, relative, rooms, allowed, room):
    """The breaks of one file. `allowed`: the rooms it may include; `room` is None for tests and programs."""
    text = (root / relative).read_text(errors="replace")
    breaks, own_header = [], relative.with_suffix(".h")
    includes = [(m.group(1), m.group(2), line_of(text, m.start())) for m in INCLUDE.finditer(text)]
    if room and relative.suffix == ".cpp" and (root / own_header).exists():
        if not includes or includes[0][1] != own_header.as_posix():
            breaks.append((1, f"does not include its own header {own_header} first"))
    if relative.suffix == ".h":
        if "#pragma once" not in text:
            breaks.append((1, "a header without #pragma once"))
        found = re.search(r"^\s*using\s+namespace\b", text, re.MULTILINE)
        if found:
            breaks.append((line_of(text, found.start()), "using namespace in a header"))
    for kind, header, line in includes:
        top = header.split("/")[0]
        if top in LAYERS or (kind == '"' and top == "tests"):
            target = pathlib.PurePosixPath(header).parent.as_posix()
            if top in LAYERS and target not in allowed:
                breaks.append((line, f'includes "{header}", but the table does not let it see {target}'))
            elif not (root / header).exists() and not header.endswith(".pb.h"):
                breaks.append((line, f'includes "{header}", which does not exist'))
        of_window = re.search("editor/window/|devices/display_glfw/", relative.as_posix())  # their tests too
        if WINDOW_ONLY.match(header) and not of_window:
            breaks.append((line, f"includes <{header}>: window libraries belong to editor/window and devices/display_glfw"))
        if relative.parts[0] == "core" and CORE_FORBIDDEN.match(header):
            breaks.append((line, f"includes <{header}>: core knows no file, socket, clock or device"))
        if room:
            library = check_library(root, header, room, rooms)
            if library:
                breaks.append((line, library))
    return [f"{relative.as_posix()}:{line}: {message}" for line, message in breaks]


def check_tree(root):
    table = read_calls(root / "cmake/Rooms.cmake", "focalstage_room")
    rooms = {room.name: room for room in table}
    breaks = check_table(table)
    programs = {p.name: p for p in read_calls(root / "cmake/Programs.cmake", "focalstage_program")}
    tests = {t.name: t for t in read_calls(root / "tests/CMakeLists.txt", "focalstage_room_tests")}
    files = 0
    for layer in LAYERS + ["tests"]:
        for path in sorted((root / layer).rglob("*")):
            if path.suffix not in SOURCES:
                continue
            files += 1
            relative = path.relative_to(root)
            name = room_of(relative, rooms)
            if name:
                breaks += check_source(root, relative, rooms, reach(rooms, [name]), rooms[name])
            elif layer == "tests":
                tested = relative.parent.relative_to("tests").as_posix()
                seen = reach(rooms, [tested] + tests[tested].uses) if tested in tests else set(rooms)
                breaks += check_source(root, relative, rooms, seen, None)
            else:
                owner = [p for p in programs.values() if p.name == relative.parent.as_posix()]
                if not owner:
                    breaks.append(f"{relative.as_posix()}:1: stands in no room of cmake/Rooms.cmake")
                    continue
                breaks += check_source(root, relative, rooms, reach(rooms, owner[0].uses), None)
    if not table or not files:
        breaks.append(f"{root}: no rooms or no sources found; is this the tree?")
    return breaks, len(table), files


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("root", nargs="?", default=pathlib.Path(__file__).resolve().parents[2], type=pathlib.Path)
    root = parser.parse_args().root
    breaks, rooms, files = check_tree(root)
    for line in breaks:
        print(line)
    print(f"layers: {files} sources in {rooms} rooms, {len(breaks)} breaks")
    return 1 if breaks else 0


if __name__ == "__main__":
    sys.exit(main())
