#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <thread>

#include <doctest/doctest.h>
#include <spdlog/spdlog.h>

#include "devices/roles/detection.h"
#include "devices/runtime/runtime.h"
#include "io/project/project_file.h"
#include "tests/devices/program/runtime_process.h"
#include "tests/devices/realtime/live_child.h"
#include "tests/devices/runtime/live_project.h"

namespace focalstage {
namespace {

using std::chrono::milliseconds;
using Clock = std::chrono::steady_clock;

double ms_since(Clock::time_point moment) {
  return std::chrono::duration<double, std::milli>(Clock::now() - moment).count();
}

RuntimeOptions options_in(const sample::Folder& folder, int width_px, int height_px) {
  spdlog::set_level(spdlog::level::off);
  RuntimeOptions options;
  options.listen = "127.0.0.1:0";
  options.store = folder.path() / "store";
  options.rig.rig = simulated_rig(sample::sim(width_px, height_px));
  return options;
}

/// Not a test by itself: the process that the next one kills.
TEST_CASE("the editor that is killed" * doctest::skip()) {
  const char* address = std::getenv(LiveChild::address_variable);
  const char* pipe = std::getenv(LiveChild::pipe_variable);
  if (address == nullptr || pipe == nullptr) return;
  auto client = RigClient::connect(address, milliseconds(5000));
  REQUIRE(client);
  auto link = LiveLink::start(*client, {1, project_text(sample::live_project()), {}, 0});
  REQUIRE(link);
  sample::LiveAnswers answers(*link);
  REQUIRE(answers.wait_compiled(1));
  REQUIRE(client->play());
  REQUIRE(answers.wait_appeared(1));
  REQUIRE(::write(std::atoi(pipe), "!", 1) == 1);
  std::this_thread::sleep_for(std::chrono::seconds(60));
}

TEST_CASE("an editor that is killed, or hangs: dark within 250 ms and a sweep, latched until go") {
  const double allowed_ms = 1e3 * dark_within_s(Doubt::live_client, 1.0 / 60.0);
  CHECK(allowed_ms == doctest::Approx(250.0 + 1000.0 / 60.0));
  for (const int signal : {SIGKILL, SIGSTOP}) {
    const sample::Folder folder;
    RuntimeOptions options = options_in(folder, 64, 48);
    options.lease = milliseconds(1000);
    const auto runtime = Runtime::start(options);
    REQUIRE(runtime);
    auto watcher = RigClient::connect(runtime->address(), milliseconds(3000));
    REQUIRE(watcher);
    LiveChild child;
    REQUIRE(child.start(runtime->address()));
    std::this_thread::sleep_for(milliseconds(700));  // many times longer than silence may last
    REQUIRE(watcher->state()->state == "playing");

    const auto killed = Clock::now();
    child.send(signal);
    double dark_ms = 0.0;
    RigState state;
    do {
      state = *watcher->state();
      dark_ms = ms_since(killed);
    } while (state.state != "dark" && dark_ms < 3000.0);
    std::printf("%s: dark after %.1f ms (%.1f allowed)\n", signal == SIGKILL ? "killed" : "hangs", dark_ms, allowed_ms);
    CHECK(state.state == "dark");
    CHECK(dark_ms < allowed_ms);
    CHECK(state.fault.find("rig.live-client") != std::string::npos);

    // The next editor gets the rig once the lease has run out, and light only after go.
    while (!watcher->state()->holder.empty()) std::this_thread::sleep_for(milliseconds(20));
    CHECK(watcher->play().fault().code == "rig.refused");
    CHECK(watcher->state()->state == "dark");
    REQUIRE(watcher->go());
    CHECK(watcher->play());
    CHECK(watcher->state()->state == "playing");
  }
}

TEST_CASE("a runtime that hangs is told by link and watch within a second") {
  const sample::Folder folder;
  RuntimeProcess runtime({"--listen", "127.0.0.1:0", "--store", (folder.path() / "store").string()});
  const std::string address = runtime.address();
  auto client = RigClient::connect(address, milliseconds(3000));
  REQUIRE(client);
  auto link = LiveLink::start(*client, {1, project_text(sample::live_project(1024, 768)), {}, 0});
  REQUIRE(link);
  sample::LiveAnswers answers(*link);
  REQUIRE(answers.wait_compiled(1));
  double watch_ms = 0.0;
  const auto stopped = Clock::now();
  std::jthread watching([&] {
    const Status watched = client->watch(milliseconds(50), [](const RigState&) { return true; });
    CHECK(watched.fault().code == "rig.unreachable");
    watch_ms = ms_since(stopped);
  });
  runtime.send(SIGSTOP);
  REQUIRE(answers.wait_ended());
  const double link_ms = ms_since(stopped);
  CHECK(answers.ended.back().fault.code == "rig.unreachable");
  CHECK(link_ms < 1000.0);
  watching.join();
  CHECK(watch_ms < 1100.0);
  std::printf("a runtime that hangs: told by the link after %.0f ms, by watch after %.0f ms\n", link_ms, watch_ms);
}

TEST_CASE("edit to light in real time: what a drag costs") {
  const sample::Folder folder;
  const auto runtime = Runtime::start(options_in(folder, 1024, 768));
  REQUIRE(runtime);
  auto client = RigClient::connect(runtime->address(), milliseconds(3000));
  REQUIRE(client);
  auto link = LiveLink::start(*client, {1, project_text(sample::live_project(1024, 768)), {}, 0}, true);
  REQUIRE(link);
  sample::LiveAnswers answers(*link);
  REQUIRE(answers.wait_compiled(1));
  REQUIRE(client->play());
  REQUIRE(answers.wait_appeared(1));
  answers.appeared.clear();
  answers.compiled.clear();

  // Two seconds of a drag at 60 edits a second, then one edit at rest.
  std::uint64_t revision = 1;
  for (int n = 0; n < 120; ++n) {
    REQUIRE(link->send(++revision, {sample::move_to(0.08 * std::sin(0.1 * n))}));
    std::this_thread::sleep_for(milliseconds(16));
  }
  REQUIRE(answers.wait_appeared(revision));
  std::vector<double> drag_ms;
  std::vector<double> compile_ms;
  for (const LiveAppeared& appeared : answers.appeared) drag_ms.push_back(appeared.edit_to_light_ms);
  for (const LiveCompiled& compiled : answers.compiled) compile_ms.push_back(compiled.compile_ms);
  std::ranges::sort(drag_ms);
  std::ranges::sort(compile_ms);
  std::this_thread::sleep_for(milliseconds(300));
  REQUIRE(link->send(++revision, {sample::move_to(0.0)}));
  REQUIRE(answers.wait_appeared(revision));
  const double rest_ms = answers.appeared.back().edit_to_light_ms;
  const RigState state = *client->state();
  std::printf(
      "120 edits in 2 s: %zu compiled (median %.1f ms), %zu appeared; edit to light median %.1f, worst %.1f ms; "
      "at rest %.1f ms; %llu sweeps late, %llu exposures missed\n",
      compile_ms.size(), compile_ms[compile_ms.size() / 2], drag_ms.size(), drag_ms[drag_ms.size() / 2], drag_ms.back(),
      rest_ms, static_cast<unsigned long long>(state.late_sweeps),
      static_cast<unsigned long long>(state.missed_exposures));
  CHECK(drag_ms.front() > 0.0);
  CHECK(drag_ms.size() >= 20);
  CHECK(rest_ms > 0.0);
  CHECK(rest_ms < 1000.0);
  for (const SlotReport& slot : state.slots) {
    if (slot.exposures > 0) CHECK(slot.right_image);
  }
}

}  // namespace
}  // namespace focalstage
