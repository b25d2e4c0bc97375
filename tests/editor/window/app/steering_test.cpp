#include "editor/window/app/steering.h"

#include <doctest/doctest.h>

#include <cstdlib>
#include <mutex>

#include "editor/session/palette.h"
#include "tests/support/temporary_folder.h"

using namespace focalstage;

namespace {

struct Home : TemporaryFolder {
  Home() { setenv("XDG_STATE_HOME", (path() / "state").c_str(), 1); }
};

/// A SpaceMouse in a test's hand.
class Puppet final : public MotionInput {
 public:
  struct Strings {
    std::mutex mutex;
    bool plugged = true;
    Deflection deflection;
  };
  explicit Puppet(Strings& strings) : strings_(strings) {}

  Status open() override { return {}; }
  void close() override {}
  DeviceId id() const override { return {"test", "puppet", "", ""}; }
  DeviceState state() const override {
    const std::lock_guard lock(strings_.mutex);
    return {strings_.plugged ? DevicePhase::ready : DevicePhase::lost, {}, 0.0, {}};
  }
  Status identify() override { return {}; }
  Deflection deflection() const override {
    const std::lock_guard lock(strings_.mutex);
    return strings_.plugged ? strings_.deflection : Deflection{};
  }

 private:
  Strings& strings_;
};

struct Bench {
  Bench() : session([] {}), steering(std::make_unique<Puppet>(strings), [] {}) {
    Value from;
    from.set("from", "three-rabbits");
    REQUIRE(session.run("file.new", from).ok());
  }

  /// A hand that holds it so for a while, at 60 frames a second.
  void hold(const Deflection& deflection, double seconds, bool pointer_holds = false) {
    {
      const std::lock_guard lock(strings.mutex);
      strings.deflection = deflection;
    }
    for (double t = 0.0; t < seconds - 1e-9; t += 1.0 / 60.0) {
      now_s += 1.0 / 60.0;
      steering.follow(session, 1.0 / 60.0, now_s, pointer_holds);
    }
  }
  void let_go() { hold({}, 0.4); }

  void plug(bool in) {
    const std::lock_guard lock(strings.mutex);
    strings.plugged = in;
  }

  Home home;
  Session session;
  Puppet::Strings strings;
  Steering steering;
  double now_s = 0.0;
};

const Deflection to_the_right{{1.0, 0.0, 0.0}, {}, 0};

}  // namespace

TEST_CASE("the camera goes with the hand and comes to rest with it; the project stays as it is") {
  Bench bench;
  const std::uint64_t revision = bench.session.revision();
  const RoomCamera before = bench.session.view().camera;
  bench.session.view().look_through = LookThrough::left_eye;
  bench.hold({{}, {0.0, 1.0, 0.0}, 0}, 0.5);
  CHECK(bench.session.view().camera.azimuth_deg == doctest::Approx(before.azimuth_deg + 60.0).epsilon(0.05));
  CHECK(bench.session.view().look_through == LookThrough::nothing);
  bench.let_go();
  const RoomCamera rest = bench.session.view().camera;
  CHECK_FALSE(bench.steering.wants_frame(bench.session));
  bench.hold({}, 0.2);
  CHECK(bench.session.view().camera == rest);
  bench.hold(to_the_right, 0.2, true);  // the pointer holds something: it goes first
  CHECK(bench.session.view().camera == rest);
  CHECK(bench.session.revision() == revision);
}

TEST_CASE("what is selected goes with the hand; a gesture is one step of undo") {
  Bench bench;
  const Object& first = bench.session.project().objects.front();
  const std::string name = first.name;
  const glm::dvec3 before_m = first.placement.pose.position_m;
  bench.session.select({{"objects", name}});
  bench.hold({}, 0.1);
  REQUIRE(bench.session.run("steer.selected").ok());
  bench.session.view().camera.azimuth_deg = 0.0;
  bench.session.view().camera.elevation_deg = 0.0;
  const RoomCamera camera = bench.session.view().camera;

  const auto place_m = [&] { return object_named(bench.session.project(), name)->placement.pose.position_m; };
  bench.hold(to_the_right, 0.2);
  CHECK(bench.steering.drags());
  CHECK(place_m().x > before_m.x + 0.01);
  CHECK(place_m().z == doctest::Approx(before_m.z));
  const glm::dvec3 halfway_m = place_m();
  bench.hold({}, 0.1);  // it eases off, and goes on: still the same gesture
  bench.hold({{0.0, 1.0, 0.0}, {0.0, 0.5, 0.0}, 0}, 0.2);
  CHECK(place_m().y > halfway_m.y + 0.01);
  bench.let_go();
  CHECK_FALSE(bench.steering.drags());
  CHECK_FALSE(bench.session.dragging());
  CHECK(bench.session.view().camera == camera);
  const glm::dvec3 first_m = place_m();

  bench.hold(to_the_right, 0.1);
  bench.let_go();
  CHECK(place_m().x > first_m.x);
  REQUIRE(bench.session.run("edit.undo").ok());
  CHECK(place_m() == first_m);
  REQUIRE(bench.session.run("edit.undo").ok());
  CHECK(place_m() == before_m);
  CHECK_FALSE(bench.session.run("edit.undo").ok());
}

TEST_CASE("unplugged in the middle of a gesture: it ends there") {
  Bench bench;
  bench.session.select({{"objects", bench.session.project().objects.front().name}});
  bench.hold({}, 0.1);
  REQUIRE(bench.session.run("steer.selected").ok());
  bench.hold(to_the_right, 0.1);
  CHECK(bench.session.dragging());
  bench.plug(false);
  bench.hold(to_the_right, 0.4);
  CHECK_FALSE(bench.session.dragging());
  CHECK_FALSE(bench.session.view().steering.present);
}

TEST_CASE("commands are there while it is plugged in") {
  Bench bench;
  const auto found = [&] {
    for (const PaletteEntry& entry : palette_entries(bench.session, "SpaceMouse")) {
      if (entry.command == "steer.selected") return true;
    }
    return false;
  };
  bench.plug(false);
  bench.hold({}, 0.1);
  CHECK_FALSE(found());
  CHECK(bench.session.run("steer.selected").fault().code == "command.unavailable");
  bench.plug(true);
  CHECK(bench.steering.wants_frame(bench.session));
  bench.hold({}, 0.1);
  CHECK(found());
  SteerSettings& how = bench.session.view().steering.how;
  for (int i = 0; i < 40; ++i) REQUIRE(bench.session.run("steer.faster").ok());
  CHECK(how.sensitivity == most_sensitivity);
  for (int i = 0; i < 80; ++i) REQUIRE(bench.session.run("steer.slower").ok());
  CHECK(how.sensitivity == least_sensitivity);
  REQUIRE(bench.session.run("steer.invert-turn").ok());
  REQUIRE(bench.session.run("steer.fly").ok());
  CHECK(how.invert_turn);
  CHECK(how.fly);
}
