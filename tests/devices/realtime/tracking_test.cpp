#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <thread>

#include <doctest/doctest.h>
#include <spdlog/spdlog.h>

#include "devices/natnet/receiver.h"
#include "devices/roles/clock.h"
#include "devices/roles/detection.h"
#include "devices/runtime/runtime.h"
#include "io/project/project_file.h"
#include "tests/devices/natnet/emulator/server.h"
#include "tests/devices/runtime/live_project.h"
#include "tests/devices/runtime/spy_rig.h"

// A NatNet server, its receiver, the runtime and the simulated rig, in real time.

namespace focalstage {
namespace {

using natnet_emulator::Misbehaviour;
using natnet_emulator::Server;
using std::chrono::milliseconds;

constexpr int width_px = 64;
constexpr int height_px = 48;

/// The tracker's circle of 0.3 m about a place a metre before the viewer, at the height of the eyes.
const Rigid world_from_tracker{{0.0, -1.6, -1.0}, {}};

Project tracked_project() {
  Project project = sample::live_project(width_px, height_px);
  project.viewer.interpupillary_mm = 0.0001;  // both eyes see what the projector does: where the thing is
  project.objects[0].placement.track = "Head";
  return project;
}

struct Stand {
  sample::Folder folder;
  std::shared_ptr<sample::LightLog> log = std::make_shared<sample::LightLog>();
  std::unique_ptr<Server> server;
  std::shared_ptr<NatNetReceiver> tracker;
  std::unique_ptr<Runtime> runtime;
  std::unique_ptr<RigClient> client;
  std::unique_ptr<LiveLink> link;
  std::unique_ptr<sample::LiveAnswers> answers;

  Stand() {
    spdlog::set_level(spdlog::level::off);
    server = Server::start({});
    REQUIRE(server);
    NatNetSettings settings;
    settings.local = "127.0.0.1";
    settings.command_port = server->command_port();
    settings.cast = NatNetCast::unicast;
    settings.data_port = 0;
    tracker = std::make_shared<NatNetReceiver>(settings);
    RuntimeOptions options;
    options.listen = "127.0.0.1:0";
    options.store = folder.path() / "store";
    options.rig.rig = sample::spied_rig(sample::sim(width_px, height_px), log);
    options.tracker.tracker = tracker;
    options.tracker.world_from_tracker = world_from_tracker;
    Result<Runtime> started = Runtime::start(options);
    REQUIRE(started);
    runtime = std::make_unique<Runtime>(std::move(*started));
    client = std::make_unique<RigClient>(*RigClient::connect(runtime->address(), milliseconds(3000)));
    link = std::make_unique<LiveLink>(*LiveLink::start(*client, {1, project_text(tracked_project()), {}, 0}));
    answers = std::make_unique<sample::LiveAnswers>(*link);
    REQUIRE(answers->wait_compiled(1));
    REQUIRE(client->play());
    REQUIRE(answers->wait_appeared(1));
  }

  /// For so long, with the link kept alive.
  void go_on(milliseconds time) {
    const auto until = std::chrono::steady_clock::now() + time;
    (void)answers->wait([&] { return std::chrono::steady_clock::now() >= until; });
  }
};

/// Where the middle of the thing is in the picture, were it shown at that moment without any delay.
double true_px(double time_s, double server_from_ours_s) {
  const auto at = natnet_emulator::head_position(time_s + server_from_ours_s);
  const glm::dvec3 world = world_from_tracker.point({at[0], at[1], at[2]});
  return 0.5 * width_px + 1.4 * width_px * world.x / -world.z;
}

TEST_CASE("a tracked thing moves on the rig where it truly is, but for what prediction cannot know") {
  Stand stand;
  stand.go_on(milliseconds(300));
  (void)stand.log->take();
  stand.go_on(milliseconds(2000));
  const auto frame = stand.tracker->newest();
  REQUIRE(frame);
  const double server_from_ours_s = frame->time_s - (frame->arrival_s - *frame->latency_s);
  const RigState state = *stand.client->state();
  std::vector<double> off_px;
  std::vector<double> late_px;  // were poses shown as they are, as late as they are
  double least = width_px;
  double most = 0.0;
  for (const sample::SeenLight& light : stand.log->take()) {
    if (!light.middle_px) continue;
    const double now_px = true_px(light.start_s, server_from_ours_s);
    off_px.push_back(std::abs(*light.middle_px - now_px));
    late_px.push_back(std::abs(true_px(light.start_s - 1e-3 * state.pose_to_light_ms, server_from_ours_s) - now_px));
    least = std::min(least, *light.middle_px);
    most = std::max(most, *light.middle_px);
  }
  CHECK(state.state == "playing");
  REQUIRE(off_px.size() > 100);
  std::ranges::sort(off_px);
  std::ranges::sort(late_px);
  const double off = off_px[off_px.size() / 2];
  const double late = late_px[late_px.size() / 2];
  std::printf(
      "tracked: %.0f ms from pose to light; off by %.2f px in the median (%.2f without prediction), %zu of light\n",
      state.pose_to_light_ms, off, late, off_px.size());
  CHECK(most - least > 30.0);  // it went to and fro
  CHECK(off < 0.6 * late);
  CHECK(state.pose_to_light_ms > 90.0);
  CHECK(state.pose_to_light_ms < 250.0);
}

TEST_CASE("a stream that stops, or a body that is covered: dark within 100 ms and a sweep, latched until go") {
  const double allowed_s = dark_within_s(Doubt::tracker, 1.0 / 60.0);
  CHECK(allowed_s == doctest::Approx(0.1 + 1.0 / 60.0));
  for (const bool covered : {false, true}) {
    Stand stand;
    stand.go_on(milliseconds(300));
    REQUIRE(stand.client->state()->state == "playing");
    Misbehaviour how;
    (covered ? how.tracking_lost : how.silent) = true;
    const double stopped_s = monotonic_s();
    stand.server->misbehave(how);
    stand.go_on(milliseconds(400));
    double last_light_s = 0.0;
    for (const sample::SeenLight& light : stand.log->take()) last_light_s = std::max(last_light_s, light.start_s);
    std::printf("%s: last light after %.1f ms (%.1f allowed)\n", covered ? "covered" : "stopped",
                1e3 * (last_light_s - stopped_s), 1e3 * allowed_s);
    const RigState state = *stand.client->state();
    CHECK(state.state == "dark");
    CHECK(state.fault.find("rig.tracker") != std::string::npos);
    CHECK(last_light_s - stopped_s < allowed_s);
    CHECK(last_light_s > stopped_s);

    stand.server->misbehave({});
    stand.go_on(milliseconds(600));
    CHECK(stand.client->state()->state == "dark");
    REQUIRE(stand.client->go());
    REQUIRE(stand.client->play());
    stand.go_on(milliseconds(400));
    CHECK(stand.client->state()->state == "playing");
  }
}

}  // namespace
}  // namespace focalstage
