#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <random>
#include <thread>

#include "core/scene/project_value.h"
#include "io/files/files.h"
#include "io/project/project_file.h"
#include "tests/io/files/small_disk.h"
#include "tests/io/project/sample.h"

using namespace focalstage;
namespace fs = std::filesystem;

namespace {

/// The full sample with so many objects that writing it takes a while.
Project long_project(const std::string& name, std::size_t objects) {
  Project project = *project_from(value_of(full_sample));
  project.name = name;
  const Object model = project.objects[0];
  for (std::size_t i = 0; i < objects; ++i) {
    project.objects.push_back(model);
    project.objects.back().name = name + " " + std::to_string(i);
  }
  return project;
}

std::string text_of(const fs::path& path) {
  const auto bytes = read_file(path, 64u << 20);
  REQUIRE(bytes.ok());
  return {reinterpret_cast<const char*>(bytes->data()), bytes->size()};
}

[[noreturn]] void save_in_turns(const Project& a, const Project& b, const fs::path& file) {
  for (;;) {
    if (!save_project(b, file).ok() || !save_project(a, file).ok()) ::_exit(1);
  }
}

}  // namespace

TEST_CASE("what is saved opens again as it was, alone in its folder") {
  const TemporaryFolder folder;
  const Project project = long_project("once", 3);
  REQUIRE(save_project(project, folder / "once.focal").ok());
  const auto loaded = load_project(folder.path());
  REQUIRE(loaded.ok());
  CHECK(loaded->project == project);
  CHECK(loaded->text == project_text(project));
  CHECK(folder.count() == 1);
}

TEST_CASE("a disk that is full leaves the saved project as it was") {
  const SmallDisk disk(512 << 10);
  const Project small = long_project("small", 100);
  const Project large = long_project("large", 2000);
  REQUIRE(project_text(small).size() < 200'000);
  REQUIRE(project_text(large).size() > 600'000);
  REQUIRE(save_project(small, disk / "p.focal").ok());
  const Status full = save_project(large, disk / "p.focal");
  REQUIRE_FALSE(full.ok());
  CHECK(full.fault().code == "file.unwritable");
  CHECK(full.fault().where == (disk / "p.focal").string());
  CHECK(load_project(disk.path())->project == small);
  CHECK(disk.count() == 1);
}

TEST_CASE("kill -9 at 100 random moments of saving: always one whole version") {
  const TemporaryFolder folder;
  const fs::path file = folder / "p.focal";
  const Project a = long_project("a", 200);
  const Project b = long_project("b", 230);
  const std::string text_a = project_text(a);
  const std::string text_b = project_text(b);
  const auto before = std::chrono::steady_clock::now();
  REQUIRE(save_project(a, file).ok());
  const auto one_save = std::chrono::steady_clock::now() - before;
  const auto seed = std::random_device()();
  INFO("seed ", seed);
  std::mt19937 random(seed);
  int found_b = 0;
  for (int i = 0; i < 100; ++i) {
    const pid_t child = ::fork();
    REQUIRE(child >= 0);
    if (child == 0) save_in_turns(a, b, file);
    std::this_thread::sleep_for(one_save * (random() % 4000) / 1000);  // within about four saves, on any disk
    ::kill(child, SIGKILL);
    int status = 0;
    REQUIRE(::waitpid(child, &status, 0) == child);
    REQUIRE(WIFSIGNALED(status));  // else it had met a fault

    const std::string text = text_of(file);
    REQUIRE((text == text_a || text == text_b));
    found_b += text == text_b;
    const auto loaded = load_project(folder.path());  // by folder: nothing left behind is taken for the project
    REQUIRE(loaded.ok());
    REQUIRE(loaded->file == file);
  }
  CHECK(found_b > 0);
  CHECK(found_b < 100);
}
