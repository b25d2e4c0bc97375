#include <chrono>
#include <fstream>
#include <iterator>
#include <random>
#include <thread>

#include <doctest/doctest.h>

#include "io/files/digest.h"
#include "io/protocol/client.h"
#include "tests/devices/program/runtime_process.h"
#include "tests/devices/runtime/sample_project.h"

namespace focalstage {
namespace {

using std::chrono::milliseconds;
using Clock = std::chrono::steady_clock;

TEST_CASE("a signal ends the runtime with status 0 within a second, also while a show plays") {
  const sample::Folder folder;
  const auto show = folder.path() / "show.h5";
  REQUIRE(sample::write_show(show, sample::project(1024, 768)));
  for (const int signal : {SIGTERM, SIGINT}) {
    RuntimeProcess runtime({"--listen", "127.0.0.1:0", "--store", (folder.path() / "store").string()});
    const std::string address = runtime.address();
    auto client = RigClient::connect(address, milliseconds(5000));
    REQUIRE(client);
    REQUIRE(client->push(show, true, {}));
    REQUIRE(client->play());
    std::this_thread::sleep_for(milliseconds(100));
    CHECK(client->state()->state == "playing");
    const auto sent = Clock::now();
    runtime.send(signal);
    CHECK(runtime.wait() == 0);
    CHECK(Clock::now() - sent < std::chrono::seconds(1));
  }
}

TEST_CASE("what it cannot do it says in one line, with the exit status of its kind") {
  const sample::Folder folder;
  const std::string store = (folder.path() / "store").string();
  RuntimeProcess first({"--listen", "127.0.0.1:0", "--store", store});
  const std::string address = first.address();
  REQUIRE_FALSE(address.empty());
  const auto fails = [](std::vector<std::string> arguments, int status, const std::string& word) {
    RuntimeProcess runtime(std::move(arguments));
    const std::string said = runtime.error_line();
    CAPTURE(said);
    CHECK(said.find(word) != std::string::npos);
    CHECK(runtime.address().empty());
    CHECK(runtime.wait() == status);
  };
  fails({"--listen", address, "--store", store + "2"}, 4, address);
  fails({"--listen", "127.0.0.1:0", "--store", store}, 4, store);
  fails({"--listen", "127.0.0.1:0", "--store", "/proc/none"}, 4, "/proc/none");
  fails({"--listen", "0.0.0.0:0", "--store", store}, 2, "0.0.0.0:0");
  fails({"--listen", "nonsense", "--store", store}, 2, "nonsense");
  fails({"--rig", "real"}, 2, "--rig");
  fails({"--unknown"}, 2, "--unknown");
  const std::string config = (folder.path() / "rig.json").string();
  fails({"--config", config}, 3, config);
  std::ofstream(config) << R"({"focalstage_rig": 1, "limits": {"current": 1}})";
  fails({"--config", config}, 3, "/limits");
}

TEST_CASE("a configuration file is obeyed, and flags go before it") {
  const sample::Folder folder;
  const std::string config = (folder.path() / "rig.json").string();
  std::ofstream(config) << R"({"focalstage_rig": 1, "rig": {"name": "gallery"}, "store": "kept",
                               "limits": {"lens_current_max_a": 0.125}, "network": {"listen": "1.2.3.4:1"}})";
  RuntimeProcess runtime({"--config", config, "--listen", "127.0.0.1:0"});
  auto client = RigClient::connect(runtime.address(), milliseconds(5000));
  REQUIRE(client);
  const auto rig = client->describe();
  REQUIRE(rig);
  CHECK(rig->name == "gallery");
  CHECK(rig->lens_current_max_a == 0.125);
  CHECK(std::filesystem::is_directory(folder.path() / "kept" / "shows"));
}

std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST_CASE("killed at a hundred random moments of a push, the store never takes a half for a whole") {
  const sample::Folder folder;
  const auto store = folder.path() / "store";
  const auto show = folder.path() / "show.h5";
  REQUIRE(sample::write_show(show, sample::project(1024, 768)));
  const unsigned seed = std::random_device{}();
  MESSAGE("seed ", seed);
  std::mt19937 random(seed);
  int finished = 0;
  for (int round = 0; round < 100; ++round) {
    RuntimeProcess runtime({"--listen", "127.0.0.1:0", "--store", store.string()});
    const std::string address = runtime.address();
    REQUIRE_FALSE(address.empty());
    auto client = RigClient::connect(address, milliseconds(5000));
    REQUIRE(client);
    const auto delay = std::chrono::microseconds(std::uniform_int_distribution<int>(0, 120'000)(random));
    std::jthread killer([&] {
      std::this_thread::sleep_for(delay);
      runtime.send(SIGKILL);
    });
    const Status pushed = client->push(show, false, {});
    killer.join();
    for (const auto& entry : std::filesystem::directory_iterator(store / "shows")) {
      CHECK(entry.path().stem() == hex(sha256_of(std::string_view(bytes_of(entry.path())))));
    }
    if (!pushed) continue;
    ++finished;
    std::filesystem::remove_all(store);
  }
  MESSAGE(finished, " of 100 pushes were whole before the kill");
  RuntimeProcess runtime({"--listen", "127.0.0.1:0", "--store", store.string()});
  auto client = RigClient::connect(runtime.address(), milliseconds(5000));
  REQUIRE(client);
  const Status pushed = client->push(show, true, {});
  CHECK_MESSAGE(pushed.ok(), (pushed ? std::string() : describe(pushed.fault())));
  CHECK(client->state()->state == "ready");
}

}  // namespace
}  // namespace focalstage
