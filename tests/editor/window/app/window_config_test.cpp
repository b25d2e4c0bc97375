#include "editor/window/app/window_config.h"

#include <doctest/doctest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

using namespace focalstage;
namespace fs = std::filesystem;

namespace {

struct Folder {
  fs::path path = fs::temp_directory_path() / ("window-config-" + std::to_string(::getpid()));
  Folder() { fs::remove_all(path); }
  ~Folder() { fs::remove_all(path); }
  void write(const char* text) const {
    fs::create_directories(path);
    std::ofstream(path / "window.json") << text;
  }
};

}  // namespace

TEST_CASE("what was saved is loaded, into a folder that was not there") {
  const Folder folder;
  WindowConfig config;
  config.splits.outline = 333.0;
  config.splits.down = 0.25;
  config.size_px = {1234, 777};
  config.steer = {2.5, true, false, true};
  REQUIRE(save_window_config(config, folder.path / "deeper").ok());
  CHECK(load_window_config(folder.path / "deeper") == config);
}

TEST_CASE("a missing or spoilt file gives the defaults, a spoilt member its own") {
  const Folder folder;
  CHECK(load_window_config(folder.path) == WindowConfig{});
  for (const char* text : {"", "{", "[]", "\"x\"", "{\"outline\": \"wide\"}", "{\"across\": 7, \"width_px\": 1e300}"}) {
    CAPTURE(text);
    folder.write(text);
    CHECK(load_window_config(folder.path) == WindowConfig{});
  }
  folder.write("{\"outline\": -5, \"bottom\": 99}");
  WindowConfig expected;
  expected.splits.bottom = 99.0;
  CHECK(load_window_config(folder.path) == expected);
}
