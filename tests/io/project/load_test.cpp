#include <algorithm>
#include <filesystem>
#include <fstream>

#include "core/scene/project_value.h"
#include "io/files/files.h"
#include "io/project/project_file.h"
#include "tests/io/project/sample.h"
#include "tests/support/temporary_folder.h"

using namespace focalstage;
namespace fs = std::filesystem;

// The example of the file's own description, which other tools were written against.
constexpr const char* example = R"({
  "focalstage": 1,
  "name": "Three rabbits",
  "viewer": { "position_m": [0,0,0], "rotation_xyzw": [0,0,0,1], "interpupillary_mm": 63 },
  "glasses": { "lens_to_pupil_mm": 15, "lens_range_d": [-10,10], "lens_aperture_mm": 16,
               "shutter_close_ms": 0.1, "shutter_open_ms": 3.0 },
  "sweep": { "frequency_hz": 60, "min_power_d": -1.5, "max_power_d": 1.5, "waveform": "sine" },
  "projectors": [ { "name": "main", "model": "dynaflash", "width_px": 1024, "height_px": 768, "frames_per_second": 2000,
                    "bits": 8, "color": "gray", "latency_ms": 0.15, "gamma": 1.0,
                    "fx_px": 1400, "fy_px": 1400, "cx_px": 512, "cy_px": 384, "distortion": [],
                    "position_m": [0,0.3,0], "rotation_xyzw": [0,0,0,1] } ],
  "slices": { "powers_d": [-1,0,1], "assignment": "linear", "breathing": "exact", "samples_per_pixel": 1 },
  "frames": { "count": 1, "rate_hz": 60 },
  "surfaces": [ { "name": "screen", "mesh": { "primitive": "plane", "size_m": [1.2,0.8] },
                  "position_m": [0,0,-0.5], "rotation_xyzw": [0,0,0,1], "illumination": 0.0 } ],
  "objects":  [ { "name": "near", "mesh": { "file": "assets/rabbit.glb" },
                  "position_m": [0,0,-0.333], "rotation_xyzw": [0,0,0,1], "scale": 0.1,
                  "appearance": { "unlit": [1,1,1] }, "depth": { "mode": "placed" } } ]
})";

TEST_CASE("the example of the description opens, and is saved with its own keys in its own order") {
  const auto loaded = parse_project(example, "example");
  REQUIRE_MESSAGE(loaded.ok(), describe(loaded.ok() ? Fault{} : loaded.fault()));
  CHECK(loaded->notes.empty());
  CHECK(value_from(loaded->project) == value_of(example));
  CHECK(loaded->project.projectors[0].pose.position_m == glm::dvec3(0, 0.3, 0));
  CHECK(std::get<UnlitAppearance>(loaded->project.objects[0].appearance).color == glm::dvec3(1));
  CHECK(project_text(loaded->project).ends_with("}\n"));
}

TEST_CASE("a project is its file or the folder that holds it") {
  const TemporaryFolder folder;
  const fs::path demo = folder / "demo";
  fs::create_directory(demo);
  CHECK(project_file(demo).fault().code == "project.missing");
  std::ofstream(demo / "other.focal") << example;
  CHECK(*project_file(demo) == demo / "other.focal");
  std::ofstream(demo / "third.focal") << example;
  CHECK(project_file(demo).fault().code == "project.missing");
  std::ofstream(demo / "demo.focal") << example;
  CHECK(*project_file(demo) == demo / "demo.focal");
  CHECK(*project_file(demo / "") == demo / "" / "demo.focal");
  CHECK(*project_file(demo / "third.focal") == demo / "third.focal");
  std::ofstream(demo / "show.h5") << "x";
  CHECK(project_file(demo / "show.h5").fault().code == "project.missing");
  CHECK(project_file(folder / "none").fault().code == "file.missing");

  const auto loaded = load_project(demo);
  REQUIRE(loaded.ok());
  CHECK(loaded->file == demo / "demo.focal");
  CHECK(loaded->text == example);
}

TEST_CASE("a fault is one line that names the file, the place in it, the cause and the remedy") {
  const TemporaryFolder folder;
  std::string text = example;
  text.replace(text.find("\"scale\": 0.1"), 12, "\"scale\": -2");
  std::ofstream(folder / "p.focal") << text;
  const auto loaded = load_project(folder / "p.focal");
  REQUIRE_FALSE(loaded.ok());
  CHECK(describe(loaded.fault()) == (folder / "p.focal").string() +
                                        ": /objects/0/scale: -2 is out of range (project.range); choose a number that "
                                        "is more than 0 and at most 1e+06");
}

TEST_CASE("a project cut at any byte is refused, never half read") {
  const std::string text = project_text(parse_project(full_sample, "x")->project);
  REQUIRE(text.ends_with("}\n"));
  for (std::size_t length = 0; length + 2 <= text.size(); ++length) {
    const auto cut = parse_project(std::string_view(text).substr(0, length), "x");
    REQUIRE_FALSE(cut.ok());
    REQUIRE(cut.fault().code == "json.syntax");
  }
  CHECK(parse_project(std::string_view(text).substr(0, text.size() - 1), "x").ok());
}

TEST_CASE("any one byte changed gives a project or a fault, and nothing worse") {
  const std::string text = project_text(parse_project(example, "x")->project);
  for (std::size_t i = 0; i < text.size(); ++i) {
    for (const char c : {'\0', '"', '}', '-', '9', '\x80'}) {
      std::string changed = text;
      changed[i] = c;
      const auto loaded = parse_project(changed, "x");
      if (loaded.ok()) {
        const auto again = parse_project(project_text(loaded->project), "x");
        REQUIRE(again.ok());
        REQUIRE(again->project == loaded->project);
      } else {
        REQUIRE(loaded.fault().where.starts_with("x"));
        REQUIRE_FALSE(loaded.fault().message.empty());
      }
    }
  }
}

TEST_CASE("empty, binary, deep, huge and foreign files are refused") {
  const TemporaryFolder folder;
  const auto refused = [&](const std::string& bytes) {
    std::ofstream(folder / "p.focal", std::ios::binary) << bytes;
    const auto loaded = load_project(folder / "p.focal");
    REQUIRE_FALSE(loaded.ok());
    CHECK(loaded.fault().where.starts_with((folder / "p.focal").string()));
    CHECK_FALSE(loaded.fault().remedy.empty());
    return loaded.fault().code;
  };
  CHECK(refused("") == "json.syntax");
  CHECK(refused(std::string(100, '\0')) == "json.syntax");
  CHECK(refused("\x89HDF\r\n\x1a\n") == "json.syntax");
  CHECK(refused(std::string(10'000, '[') + std::string(10'000, ']')) == "json.depth");
  CHECK(refused("[]") == "project.type");
  CHECK(refused("null") == "project.type");
  CHECK(refused("{}") == "project.version");
  std::string infinite = example;
  infinite.replace(infinite.find("0.333"), 5, "1e999");
  CHECK(refused(infinite) == "json.number");
  std::string not_a_number = example;
  not_a_number.replace(not_a_number.find("-0.333"), 6, "NaN");
  CHECK(refused(not_a_number) == "json.syntax");
  refused("{}");
  fs::resize_file(folder / "p.focal", 1u << 30);
  const auto huge = load_project(folder / "p.focal");
  REQUIRE_FALSE(huge.ok());
  CHECK(huge.fault().code == "file.too-large");
}
