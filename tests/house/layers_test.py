#!/usr/bin/python3
"""Plants breaks in a copy of the tree and expects layers.py to name each; the tree as it is must pass."""

import pathlib
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
CHECK = ROOT / "tests/house/layers.py"

# file to append to (made if missing), text, what the report must say
BREAKS = [
    ("core/optics/planted.cpp", '#include "core/schedule/schedule.h"\n', "does not let it see core/schedule"),
    ("core/schedule/planted.cpp", '#include "core/compile/frame.h"\n', "does not let it see core/compile"),
    ("core/base/planted.h", '#pragma once\n#include "io/files/files.h"\n', "does not let it see io/files"),
    ("core/mesh/planted.cpp", "#include <fstream>\n", "core knows no file"),
    ("core/scene/planted.cpp", "#  include <filesystem>\n", "core knows no file"),
    ("core/stage/planted.cpp", "#include <sys/socket.h>\n", "core knows no file"),
    ("core/check/planted.cpp", "#include <chrono>\n", "core knows no file"),
    ("core/optics/planted.cpp", "#include <tbb/parallel_for.h>\n", "does not link TBB::tbb"),
    ("core/schedule/planted.cpp", "#include <boost/math/distributions/fisher_f.hpp>\n", "does not link Boost::headers"),
    ("io/files/planted.cpp", "#include <imgui.h>\n", "belong to editor/window"),
    ("editor/cli/planted.cpp", "#include <vtkActor.h>\n", "belong to editor/window"),
    ("editor/cli/planted.cpp", "#include <GLFW/glfw3.h>\n", "belong to editor/window"),
    ("editor/cli/planted.cpp", '#include "devices/sim/lens.h"\n', "does not let it see devices/sim"),
    ("io/json/planted.cpp", '#include "core/scene/nothing_here.h"\n', "does not exist"),
    ("core/loose/planted.cpp", "int planted;\n", "stands in no room"),
    ("core/optics/vergence.cpp", None, "own header"),
    ("core/base/planted.h", "#pragma once\nusing namespace std;\n", "using namespace in a header"),
    ("core/base/planted.h", "int planted;\n", "without #pragma once"),
    ("cmake/Rooms.cmake", "focalstage_room(core/late USES io/files)\n", "of a layer below its own"),
    ("cmake/Rooms.cmake", "focalstage_room(core/late USES core/later)\n", "does not stand above it"),
    ("cmake/Rooms.cmake", "focalstage_room(devices/x USES io/files)\n", "is a driver and sees core"),
    ("tests/core/optics/planted_test.cpp", '#include "io/show/show.h"\n', "does not let it see io/show"),
]


def copy_tree(to):
    for folder in ("core", "io", "devices", "editor", "tests", "cmake"):
        if (ROOT / folder).exists():
            shutil.copytree(ROOT / folder, to / folder, ignore=shutil.ignore_patterns("*.h5", "*.png", "*.bin"))


def run(root):
    done = subprocess.run(["/usr/bin/python3", str(CHECK), str(root)], capture_output=True, text=True)
    return done.returncode, done.stdout + done.stderr


def main():
    failures = 0
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder)
        copy_tree(root)
        status, report = run(root)
        if status != 0:
            print("the tree itself does not pass:\n" + report)
            return 1
        for name, text, expected in BREAKS:
            path = root / name
            before = path.read_text() if path.exists() else None
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text("#include <cmath>\n" + before if text is None else (before or "") + text)
            status, report = run(root)
            if status != 1 or expected not in report:
                failures += 1
                print(f"not caught: {name}: {text!r}; wanted '{expected}', got:\n{report}")
            if before is None:
                path.unlink()
            else:
                path.write_text(before)
    print(f"layers: {len(BREAKS) - failures} of {len(BREAKS)} planted breaks caught")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
