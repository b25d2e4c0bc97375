#include <doctest/doctest.h>
#include <spdlog/spdlog.h>

#include "devices/runtime/runtime.h"
#include "io/project/project_file.h"
#include "tests/devices/runtime/fake_tracker.h"
#include "tests/devices/runtime/live_project.h"

// Live with a tracker, over real gRPC, with the simulated rig in virtual time. The tracker's time is real.

namespace focalstage {
namespace {

using std::chrono::milliseconds;

TrackedBody at(double x_m, double z_m, bool tracked = true) {
  return {7, "Card", tracked, {{x_m, 0.0, z_m}, {}}, 1e-4};
}

Project tracked_project() {
  Project project = sample::live_project();
  project.objects[0].placement.track = "Card";
  return project;
}

/// The tracked project with the square where it is said to be.
Project standing(double x_m, double z_m) {
  Project project = sample::live_project();
  project.objects[0].placement.pose.position_m = {x_m, 0.0, z_m};
  return project;
}

struct Stand {
  sample::Folder folder;
  std::shared_ptr<sample::FakeTracker> tracker = std::make_shared<sample::FakeTracker>();
  RuntimeOptions options;
  std::unique_ptr<Runtime> runtime;
  std::unique_ptr<RigClient> client;
  std::unique_ptr<LiveLink> link;
  std::unique_ptr<sample::LiveAnswers> answers;

  explicit Stand(bool with_tracker = true) {
    spdlog::set_level(spdlog::level::off);
    options.listen = "127.0.0.1:0";
    options.store = folder.path() / "store";
    options.rig.rig = simulated_rig(sample::sim(64, 48));
    options.rig.clock = RigClock::virtual_time;
    if (with_tracker) options.tracker.tracker = tracker;
    options.tracker.world_from_tracker.position_m = {0.0, 0.0, -1.0};
    options.tracker.body_from_thing["Card"].position_m = {0.01, 0.0, 0.0};
  }

  void begin(const Project& project) {
    Result<Runtime> started = Runtime::start(options);
    REQUIRE(started);
    runtime = std::make_unique<Runtime>(std::move(*started));
    Result<RigClient> connected = RigClient::connect(runtime->address(), milliseconds(3000));
    REQUIRE(connected);
    client = std::make_unique<RigClient>(std::move(*connected));
    Result<LiveLink> begun = LiveLink::start(*client, {1, project_text(project), {}, 0}, true);
    REQUIRE(begun);
    link = std::make_unique<LiveLink>(std::move(*begun));
    answers = std::make_unique<sample::LiveAnswers>(*link);
  }

  bool comes_to_be(const std::string& state) {
    return answers->wait([&] { return answers->state.state == state; });
  }
};

TEST_CASE("a tracked thing is compiled where the tracker sees it, through both offsets; an edit wins as ever") {
  Stand stand;
  stand.tracker->see({at(0.05, 0.2)});
  stand.begin(tracked_project());
  REQUIRE(stand.answers->wait_compiled(1));
  CHECK(read_live_frame(stand.answers->compiled.back())->codes == sample::images_of(standing(0.06, -0.8)).codes);
  REQUIRE(stand.client->play());
  REQUIRE(stand.answers->wait_appeared(1));

  stand.tracker->see({at(-0.07, 0.1)});
  // A newer pose is not said to the editor. After an edit, the thing is where it went meanwhile.
  std::this_thread::sleep_for(milliseconds(200));
  REQUIRE(stand.link->send(2, {{Edit::Kind::set, "", "", "name", Value(std::string("renamed"))}}));
  REQUIRE(stand.answers->wait_appeared(2));
  CHECK(stand.answers->compiled.size() == 2);
  CHECK(stand.answers->appeared.size() == 2);
  CHECK(read_live_frame(stand.answers->compiled.back())->codes == sample::images_of(standing(-0.06, -0.9)).codes);
  CHECK(stand.answers->wait([&] { return stand.answers->state.pose_to_light_ms > 0.0; }));
  CHECK(stand.answers->refused.empty());
  CHECK(stand.client->state()->state == "playing");
}

TEST_CASE("a tracker that stops, or a body that is covered, is darkness that stays, with the fault's name") {
  for (const bool covered : {false, true}) {
    Stand stand;
    stand.tracker->see({at(0.0, 0.2)});
    stand.begin(tracked_project());
    REQUIRE(stand.answers->wait_compiled(1));
    REQUIRE(stand.client->play());
    REQUIRE(stand.answers->wait_appeared(1));
    std::this_thread::sleep_for(milliseconds(200));
    CHECK(stand.client->state()->state == "playing");

    if (covered) {
      stand.tracker->see({at(0.0, 0.2, false)});
    } else {
      stand.tracker->stream(false);
    }
    REQUIRE(stand.comes_to_be("dark"));
    CHECK(stand.answers->state.fault.find("rig.tracker") != std::string::npos);
    CHECK(stand.answers->state.fault.find(covered ? "not seen" : "the plug is out") != std::string::npos);
    CHECK(stand.answers->state.fault.find("Card") != std::string::npos);

    stand.tracker->see({at(0.0, 0.2)});
    stand.tracker->stream(true);
    std::this_thread::sleep_for(milliseconds(150));
    CHECK(stand.client->state()->state == "dark");  // latched
    REQUIRE(stand.client->go());
    REQUIRE(stand.client->play());
    std::this_thread::sleep_for(milliseconds(150));
    const auto after = stand.client->state();
    CHECK_MESSAGE(after->state == "playing", after->fault);
  }
}

TEST_CASE("what plays without tracked things does not care for the tracker") {
  Stand stand;
  stand.begin(sample::live_project());
  REQUIRE(stand.answers->wait_compiled(1));
  REQUIRE(stand.client->play());
  REQUIRE(stand.answers->wait_appeared(1));
  stand.tracker->stream(false);
  std::this_thread::sleep_for(milliseconds(300));
  CHECK(stand.client->state()->state == "playing");
  CHECK(stand.client->state()->pose_to_light_ms == 0.0);
}

TEST_CASE("a body that nobody knows, or sees, is refused once by name, and taken when it comes") {
  Stand stand;
  stand.tracker->see({{8, "Box", true, {}, 0.0}});
  stand.begin(tracked_project());
  REQUIRE(stand.answers->wait_refused(1));
  std::this_thread::sleep_for(milliseconds(150));
  CHECK(stand.answers->refused.size() == 1);
  CHECK(stand.answers->refused[0].fault.code == "track.unknown");
  CHECK(stand.answers->refused[0].fault.where == "/objects/0/track");
  CHECK(stand.answers->refused[0].fault.message.find("Card") != std::string::npos);
  stand.tracker->see({at(0.0, 0.3)});
  CHECK(stand.answers->wait_compiled(1));
}

TEST_CASE("without a tracker a tracked project is refused, by name") {
  Stand stand(false);
  stand.begin(tracked_project());
  REQUIRE(stand.answers->wait_refused(1));
  CHECK(stand.answers->refused[0].fault.code == "rig.tracker");
}

}  // namespace
}  // namespace focalstage
