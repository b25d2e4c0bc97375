#include "editor/rig/rig_link.h"

#include <doctest/doctest.h>
#include <signal.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <string>
#include <thread>

#include "editor/rig/simulated_rig.h"
#include "io/protocol/client.h"
#include "tests/support/temporary_folder.h"

using namespace focalstage;
using Phase = RigStatus::Phase;

namespace {

bool wait(const std::function<bool()>& until, double patience_s = 15.0) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(patience_s);
  while (std::chrono::steady_clock::now() < end) {
    if (until()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return false;
}

/// The process that listens with `store` among its arguments.
pid_t runtime_with(const std::string& store) {
  for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
    std::ifstream in(entry.path() / "cmdline", std::ios::binary);
    const std::string line{std::istreambuf_iterator<char>(in), {}};
    if (line.find("focalstage-runtime") != std::string::npos && line.find(store) != std::string::npos) {
      return std::atoi(entry.path().filename().c_str());
    }
  }
  return -1;
}

}  // namespace

TEST_CASE("a simulated rig starts, answers and goes with its owner") {
  const TemporaryFolder folder;
  {
    auto rig = SimulatedRig::start(folder.path() / "store");
    REQUIRE(rig.ok());
    CHECK(rig->running());
    CHECK(RigClient::connect(rig->address(), std::chrono::milliseconds(2000)).ok());
  }
  CHECK(runtime_with(folder.path().string()) == -1);
}

TEST_CASE("nobody at the address is said, and costs nothing") {
  const TemporaryFolder folder;
  RigLink link([] {}, folder.path());
  link.connect("127.0.0.1:1");
  REQUIRE(wait([&] { return link.status().fault.has_value(); }));
  CHECK(link.status().fault->code == "rig.unreachable");
  CHECK(link.status().phase == Phase::none);
  link.play();
  link.blackout();
}

TEST_CASE("a simulated rig that is killed is said to be lost, and comes back") {
  const TemporaryFolder folder;
  RigLink link([] {}, folder.path());
  link.simulate();
  REQUIRE(wait([&] { return link.status().phase == Phase::connected; }));
  const std::string first = link.status().address;
  CHECK_FALSE(link.status().description.projectors.empty());
  REQUIRE(kill(runtime_with(folder.path().string()), SIGKILL) == 0);
  CHECK(wait([&] { return link.status().phase == Phase::lost || link.status().address != first; }));
  CHECK(wait([&] { return link.status().phase == Phase::connected && link.status().address != first; }));
}

TEST_CASE("a push that cannot be made says why, and blackout is not held up by it") {
  const TemporaryFolder folder;
  RigLink link([] {}, folder.path());
  link.simulate();
  REQUIRE(wait([&] { return link.status().phase == Phase::connected; }));
  link.push([](const std::function<void(double)>& progress, std::stop_token stop) -> Result<std::filesystem::path> {
    progress(0.5);
    while (!stop.stop_requested()) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    return Fault{"compile.cancelled", "show.h5", "stopped before the end", ""};
  });
  REQUIRE(wait([&] { return link.status().push_share == 0.5; }));
  link.blackout();
  CHECK(wait([&] { return link.status().state.state == "dark"; }));
  CHECK(link.status().pushing);
  link.cancel_push();
  REQUIRE(wait([&] { return !link.status().pushing; }));
  CHECK(link.status().fault->code == "compile.cancelled");
}

TEST_CASE("a hand that hammers on Blackout gets darkness, not a thread for each press") {
  const TemporaryFolder folder;
  RigLink link([] {}, folder.path());
  link.simulate();
  REQUIRE(wait([&] { return link.status().phase == Phase::connected; }));
  const auto threads = [] {
    return std::distance(std::filesystem::directory_iterator("/proc/self/task"), std::filesystem::directory_iterator());
  };
  const auto before = threads();
  for (int press = 0; press < 200; ++press) link.blackout();
  CHECK(wait([&] { return link.status().state.state == "dark"; }));
  CHECK(threads() < before + 100);  // gRPC keeps a handful of its own
}
