#include "io/models/models.h"

#include <doctest/doctest.h>

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>

#include "io/models/shipped.h"
#include "tests/support/temporary_folder.h"

using namespace focalstage;

namespace {

namespace fs = std::filesystem;

const std::string bench_model = R"({
  "focalstage_projector_model": 1, "name": "bench", "width_px": 640, "height_px": 480,
  "depths": [ { "bits": 1, "least_exposure_ms": 0.25 }, { "bits": 8, "frames_per_second": 500, "least_exposure_ms": 1.5 } ]
})";

std::string changed(const std::string& what, const std::string& to) {
  std::string text = bench_model;
  const std::size_t at = text.find(what);
  REQUIRE(at != std::string::npos);
  return text.replace(at, what.size(), to);
}

Fault fault_of(const std::string& text) {
  const auto model = parse_model(text, "models/bench.json");
  REQUIRE_FALSE(model.ok());
  return model.fault();
}

void write(const fs::path& file, const std::string& text) {
  fs::create_directories(file.parent_path());
  std::ofstream(file) << text;
}

/// The user's configuration for as long as it lives.
class Configuration {
 public:
  explicit Configuration(const fs::path& folder) {
    if (const char* set = std::getenv("XDG_CONFIG_HOME")) before_ = set;
    setenv("XDG_CONFIG_HOME", folder.c_str(), 1);
  }
  ~Configuration() { before_.empty() ? unsetenv("XDG_CONFIG_HOME") : setenv("XDG_CONFIG_HOME", before_.c_str(), 1); }

 private:
  std::string before_;
};

}  // namespace

TEST_CASE("a model as its file says, rate and exposure standing for each other") {
  const auto model = parse_model(bench_model, "bench.json");
  REQUIRE(model);
  CHECK(
      *model ==
      ProjectorModelData{
          "bench", 640, 480, ProjectorClock::triggered, PixelLayout::square, {{1, 4000.0, 0.25}, {8, 500.0, 1.5}}, {}});
  const auto other = parse_model(
      changed(
          "\"height_px\": 480,",
          R"("height_px": 480, "clock": "master", "pixel_layout": "diamond", "planes_per_frame": 24, "note": "x",)"),
      "bench.json");
  REQUIRE(other);
  CHECK(other->clock == ProjectorClock::master);
  CHECK(other->layout == PixelLayout::diamond);
  CHECK(*other->planes_per_frame == 24);
}

TEST_CASE("the program has the files of models/, byte for byte") {
  CHECK(shipped_files().size() == 2);
  for (const ShippedModel& shipped : shipped_files()) {
    std::ostringstream bytes;
    bytes << std::ifstream(fs::path(FOCALSTAGE_SOURCE_DIR) / shipped.file).rdbuf();
    CHECK(bytes.str() == shipped.text);
  }
  const auto models = shipped_models();
  REQUIRE(models);
  CHECK(find_model(*models, "dynaflash") != nullptr);
  CHECK(find_model(*models, "lightcrafter4500") != nullptr);
}

TEST_CASE("a model that is none names file, place and remedy") {
  CHECK(fault_of("{").code.starts_with("json."));
  CHECK(fault_of("{").where.starts_with("models/bench.json"));
  const Fault missing = fault_of(changed("\"name\": \"bench\", ", ""));
  CHECK(missing.code == "model.schema");
  CHECK(missing.message.find("name") != std::string::npos);
  CHECK_FALSE(missing.remedy.empty());
  CHECK(fault_of(changed("640", "0")).where == "models/bench.json: /width_px");
  CHECK(fault_of(changed("\"name\"", "\"colour\": 3, \"name\"")).code == "model.schema");
  CHECK(fault_of(changed("\"bits\": 1, \"least_exposure_ms\": 0.25", "\"bits\": 1")).where ==
        "models/bench.json: /depths/0");
  CHECK(fault_of(changed("\"focalstage_projector_model\": 1", "\"focalstage_projector_model\": 2")).code ==
        "model.schema");
}

TEST_CASE("depths rise, and none is faster than fewer bits") {
  const Fault twice = fault_of(changed("\"bits\": 8", "\"bits\": 1"));
  CHECK(twice.code == "model.depths");
  CHECK(twice.where == "models/bench.json: /depths/1/bits");
  CHECK(fault_of(changed("500", "5000")).where == "models/bench.json: /depths/1/frames_per_second");
  CHECK(fault_of(changed("1.5", "0.2")).where == "models/bench.json: /depths/1/least_exposure_ms");
}

TEST_CASE("the user's models come after the program's, the project's after those") {
  const TemporaryFolder room;
  const Configuration configuration(room.path() / "config");
  const fs::path mine = room.path() / "config" / "focalstage" / "models", project = room.path() / "show";
  auto models = known_models(project);
  REQUIRE(models);
  CHECK(*models == *shipped_models());  // no such folders

  write(mine / "bench.json", bench_model);
  write(mine / "fast.json", changed("\"bench\"", "\"dynaflash\""));
  write(mine / "notes.txt", "not a model");
  models = known_models(project);
  REQUIRE(models);
  CHECK(models->size() == 3);
  CHECK(find_model(*models, "dynaflash")->width_px == 640);
  CHECK(find_model(*models, "bench")->width_px == 640);

  write(project / "models" / "bench.json", changed("640", "641"));
  models = known_models(project);
  REQUIRE(models);
  CHECK(find_model(*models, "bench")->width_px == 641);
  CHECK(find_model(*known_models(), "bench")->width_px == 640);
}

TEST_CASE("a folder with a broken file, or two of one name") {
  const TemporaryFolder room;
  CHECK(models_in(room.path() / "none")->empty());
  write(room.path() / "a.json", bench_model);
  write(room.path() / "b.json", bench_model);
  const auto twice = models_in(room.path());
  REQUIRE_FALSE(twice.ok());
  CHECK(twice.fault().code == "model.twice");
  CHECK(twice.fault().where == (room.path() / "b.json").string() + ": /name");
  write(room.path() / "b.json", "[]");
  CHECK(models_in(room.path()).fault().where.starts_with((room.path() / "b.json").string()));
  CHECK(models_in(room.path() / "a.json").fault().code == "file.unreadable");  // no folder at all
}

TEST_CASE("models go along to another folder, where what is there stays") {
  const TemporaryFolder room;
  const fs::path from = room.path() / "from", to = room.path() / "to";
  CHECK(copy_models(from, to));
  CHECK_FALSE(fs::exists(to));
  write(from / "models" / "bench.json", bench_model);
  write(from / "models" / "other.json", changed("\"bench\"", "\"other\""));
  write(to / "models" / "other.json", changed("\"bench\"", "\"other of there\""));
  REQUIRE(copy_models(from, to));
  CHECK(find_model(*models_in(to / "models"), "bench") != nullptr);
  CHECK(find_model(*models_in(to / "models"), "other of there") != nullptr);
}
