#include "devices/runtime/self_test.h"

#include <atomic>
#include <cmath>
#include <fstream>
#include <set>
#include <thread>

#include <doctest/doctest.h>
#include <spdlog/spdlog.h>

#include "devices/runtime/runtime.h"
#include "devices/sim/sim_rig.h"
#include "io/protocol/adopt.h"
#include "io/protocol/client.h"
#include "tests/devices/runtime/sample_project.h"
#include "tests/support/forwarding_rig.h"

// A rig that measures itself, over the wire, and is not what it thinks it is.

namespace focalstage {
namespace {

using std::chrono::milliseconds;

/// The rig as it really is; what it says of itself before it measured is SimSettings as they are.
SimSettings truth() {
  SimSettings settings = sample::sim();
  settings.lens.left = {36.0, 0.0008, 0.00015};
  settings.lens.right = {39.0, 0.0005, 0.00012};
  settings.shutter = {0.0024, 0.00018};
  settings.projector.latency_s = 0.00021;
  return settings;
}

struct Stand {
  sample::Folder folder;
  RuntimeOptions options;
  std::unique_ptr<Runtime> runtime;

  explicit Stand(const SimSettings& really = truth(), const SimFaults& faults = {}) {
    spdlog::set_level(spdlog::level::off);
    options.listen = "127.0.0.1:0";
    options.store = folder.path() / "store";
    options.rig.rig = simulated_rig(really, faults);
    SimSettings thought = sample::sim();
    thought.light = really.light;
    options.rig.rig.describe = simulated_rig(thought).describe;
    options.rig.clock = RigClock::virtual_time;
    start();
  }

  void start() {
    runtime.reset();
    Result<Runtime> started = Runtime::start(options);
    REQUIRE(started);
    runtime = std::make_unique<Runtime>(std::move(*started));
  }

  RigClient client() const { return std::move(*RigClient::connect(runtime->address(), milliseconds(3000))); }
  SimLightSensor& sensor() const { return dynamic_cast<SimLightSensor&>(*options.rig.rig.light_sensor); }
};

/// What a rig of devices asks of whoever plays on it, and the simulated one does not (devices/firmware/README.md): how
/// triggers lie in their period, and shutters that are never open together.
class StrictRig final : public support::ForwardingRig {
 public:
  StrictRig(std::unique_ptr<Rig> inner, std::shared_ptr<std::set<std::string>> broken)
      : ForwardingRig(std::move(inner)), broken_(std::move(broken)) {}

  void sync_edge(double time_s) override {
    edge_s_ = time_s;
    triggers_ = 0;
    ForwardingRig::sync_edge(time_s);
  }
  void trigger(double time_s) override {
    const double at_s = time_s - edge_s_;
    if (at_s < 50e-6) broken_->insert("a trigger too soon after the edge");
    if (at_s > 1.0 / 60.0 - 150e-6) broken_->insert("a trigger too near the next edge");
    if (triggers_ > 0 && time_s - trigger_s_ < 150e-6) broken_->insert("triggers too close");
    if (++triggers_ > 32) broken_->insert("more triggers than a board takes");
    trigger_s_ = time_s;
    ForwardingRig::trigger(time_s);
  }
  void shutter(Side eye, ShutterLevel level, double time_s) override {
    if (time_s < edge_s_ || time_s > edge_s_ + 1.9 / 60.0) broken_->insert("a shutter out of its period");
    if (level == ShutterLevel::open) {
      opened_s_[eye] = time_s;
      closed_s_[eye] = 1e300;
      const Side other = eye == Side::left ? Side::right : Side::left;
      if (time_s < closed_s_[other] && opened_s_[other] < time_s) broken_->insert("both shutters open");
    } else {
      closed_s_[eye] = time_s;
    }
    ForwardingRig::shutter(eye, level, time_s);
  }
  void dark(double time_s) override {
    closed_s_ = {-1e300, -1e300};
    ForwardingRig::dark(time_s);
  }

 private:
  std::shared_ptr<std::set<std::string>> broken_;
  double edge_s_ = 0.0;
  double trigger_s_ = 0.0;
  int triggers_ = 0;
  PerEye<double> opened_s_{-1e300, -1e300};
  PerEye<double> closed_s_{-1e300, -1e300};
};

/// Values against what is true. One of many may lie several of its spreads away (a spread of eight groups of traces is
/// itself known to a quarter): what holds each is what it may be wrong by; what holds the spreads is all of them
/// together.
class Comparison {
 public:
  void near(const Estimate& measured, double wanted, double at_most) {
    CAPTURE(measured.value);
    CAPTURE(measured.spread);
    CAPTURE(wanted);
    CHECK(measured.spread > 0.0);
    CHECK(measured.spread < at_most);
    CHECK(std::abs(measured.value - wanted) < at_most);
    const double off = (measured.value - wanted) / measured.spread;
    squares_ += off * off;
    count_ += 1.0;
  }
  double rms_in_spreads() const { return std::sqrt(squares_ / count_); }

 private:
  double squares_ = 0.0;
  double count_ = 0.0;
};

TEST_CASE("a rig that is not what it thought finds out what it is, within the spreads it states") {
  Stand stand;
  RigClient client = stand.client();
  CHECK_FALSE(client.describe()->measurement);
  int steps = 0;
  double share = 0.0;
  const auto measured = client.self_test({}, [&](const std::string& doing, double done) {
    CHECK_FALSE(doing.empty());
    CHECK(done >= share);
    share = done;
    ++steps;
  });
  if (!measured) MESSAGE(describe(measured.fault()));
  REQUIRE(measured);
  CHECK(steps > 20);
  CHECK(share == 1.0);
  const SimSettings really = truth();
  Comparison compared;
  compared.near(measured->latency_ms, 0.21, 0.012);
  for (const Side eye : both_sides) {
    const MeasuredEye& found = measured->eye[eye];
    compared.near(found.shutter_open_ms, 2.4, 0.05);
    compared.near(found.shutter_close_ms, 0.18, 0.02);
    compared.near(found.rest_power_d, 0.0, 0.02);
    REQUIRE(found.lens.size() == 5);
    for (const MeasuredHarmonic& one : found.lens) {
      const LensPoint point = lens_point(really.lens[eye], 60.0 * one.harmonic);
      CAPTURE(one.harmonic);
      compared.near(one.gain_d_per_a, point.gain_d_per_a, 0.03 * point.gain_d_per_a);
      if (one.harmonic > 0) compared.near(one.phase_deg, point.phase_deg, 2.0);
    }
  }
  CHECK(compared.rms_in_spreads() < 1.5);

  SUBCASE("it is dark then, holds no show, and goes on when told") {
    CHECK(client.state()->state == "dark");
    CHECK(client.state()->fault.empty());
    CHECK(client.state()->slots.empty());
    REQUIRE(client.go());
    CHECK(client.state()->state == "empty");
  }
  SUBCASE("it says so from then on, at any frequency as far as it was measured, and after a restart") {
    const auto rig = client.describe();
    REQUIRE(rig);
    REQUIRE(rig->measurement);
    CHECK(*rig->measurement == *measured);
    CHECK(rig->measurement->unix_s > 1'700'000'000);
    CHECK(rig->projectors[0].latency_ms == measured->latency_ms.value);
    CHECK(rig->glasses.shutter_open_ms ==
          std::max(measured->eye.left.shutter_open_ms.value, measured->eye.right.shutter_open_ms.value));
    REQUIRE(rig->glasses.lens_response.left.size() == 5);
    CHECK(rig->glasses.lens_response.left[1].gain_d_per_a == measured->eye.left.lens[1].gain_d_per_a.value);
    const auto slower = client.describe(50.0);
    CHECK(slower->glasses.lens_response.left[1].phase_deg > rig->glasses.lens_response.left[1].phase_deg);
    stand.start();
    CHECK(*stand.client().describe() == *rig);
  }
  SUBCASE("a project takes it over, and what is compiled for it then plays as asked") {
    Project project = sample::project();
    const auto show = stand.folder.path() / "show.h5";
    REQUIRE(sample::write_show(show, project));
    REQUIRE(client.go());
    CHECK(client.push(show, true, {}).fault().code == "rig.differs");
    const auto adopted = apply_all(project, adopt(project, *client.describe()));
    REQUIRE(adopted);
    REQUIRE(sample::write_show(show, *adopted, 2));
    REQUIRE(client.push(show, true, {}));
    REQUIRE(client.play(60));
    for (int n = 0; n < 500 && client.state()->state != "holding"; ++n) std::this_thread::sleep_for(milliseconds(10));
    const auto state = client.state();
    CHECK(state->missed_exposures == 0);
    REQUIRE_FALSE(state->slots.empty());
    for (const SlotReport& slot : state->slots) {
      // Half the tolerance of a rig that knows itself exactly is what measuring may cost.
      CHECK(std::abs(slot.delivered_power_d - slot.asked_power_d) < 0.03);
      CHECK(std::abs(slot.delivered_s - slot.asked_s) < 20e-6);
      CHECK(slot.own_shutter_open);
      CHECK(slot.other_shutter_closed);
    }
  }
}

TEST_CASE("a dry run tells and keeps nothing; fewer harmonics are quicker") {
  const Stand stand;
  RigClient client = stand.client();
  const auto before = client.describe();
  RigClient::SelfTestAsked asked;
  asked.harmonics = 1;
  asked.dry_run = true;
  const auto measured = client.self_test(asked, {});
  REQUIRE(measured);
  CHECK(measured->eye.left.lens.size() == 2);
  CHECK(*client.describe() == *before);
}

TEST_CASE("all that is played meanwhile could be played by devices") {
  Stand stand;
  const auto broken = std::make_shared<std::set<std::string>>();
  stand.options.rig.rig.make = [inner = stand.options.rig.rig.make, broken] {
    return std::make_unique<StrictRig>(inner(), broken);
  };
  stand.start();
  RigClient::SelfTestAsked asked;
  asked.harmonics = 2;
  CHECK(stand.client().self_test(asked, {}));
  stand.runtime.reset();
  std::string told;
  for (const std::string& what : *broken) told += what + "; ";
  CHECK(told == "");
}

TEST_CASE("what keeps a rig from measuring itself is said") {
  SUBCASE("no light sensor") {
    SimSettings blind = sample::sim();
    blind.light.reset();
    const Stand stand(blind);
    const auto measured = stand.client().self_test({}, {});
    REQUIRE_FALSE(measured);
    CHECK(measured.fault().code == "rig.no-light-sensor");
    CHECK(measured.fault().remedy.find("light_sensor") != std::string::npos);
    CHECK(stand.client().state()->state == "empty");
  }
  SUBCASE("a show plays") {
    const Stand stand(sample::sim());
    RigClient client = stand.client();
    const auto show = stand.folder.path() / "show.h5";
    REQUIRE(sample::write_show(show, sample::project()));
    REQUIRE(client.push(show, true, {}));
    REQUIRE(client.play());
    CHECK(client.self_test({}, {}).fault().code == "rig.refused");
    CHECK(client.state()->state == "playing");
    REQUIRE(client.blackout());
    CHECK(client.self_test({}, {}).fault().remedy == "say go first");
  }
  SUBCASE("another holds it, and numbers that no rig has") {
    const Stand stand;
    RigClient holder = stand.client();
    CHECK(holder.go());
    CHECK(stand.client().self_test({}, {}).fault().code == "rig.held");
    CHECK(holder.self_test({10.0, 0, false}, {}).fault().code == "rig.request");
    CHECK(holder.self_test({60.0, 99, false}, {}).fault().code == "rig.request");
  }
  SUBCASE("a limit that leaves the lens too little current") {
    Stand stand;
    stand.options.rig.limits.lens_current_max_a = 0.02;
    stand.start();
    const auto measured = stand.client().self_test({}, {});
    REQUIRE_FALSE(measured);
    CHECK(measured.fault().code == "measure.drive");
    CHECK(stand.client().state()->state == "dark");
  }
  SUBCASE("a kept file that is broken") {
    Stand stand;
    stand.runtime.reset();
    std::ofstream(stand.folder.path() / "store" / "measured.json") << "{\"focalstage_measured\": 1}";
    const auto started = Runtime::start(stand.options);
    REQUIRE_FALSE(started);
    CHECK(started.fault().where.find("measured.json") != std::string::npos);
  }
}

/// The fault of a test on a bench that is not well.
Fault fault_on(const std::function<void(SimLightSettings&)>& spoil) {
  SimSettings really = truth();
  spoil(*really.light);
  const Stand stand(really);
  const auto measured = stand.client().self_test({}, {});
  CHECK(stand.client().state()->state == "dark");
  CHECK_FALSE(stand.client().describe()->measurement);
  REQUIRE_FALSE(measured);
  return measured.fault();
}

TEST_CASE("a signal that supports no answer is refused, dark, and nothing is kept") {
  CHECK(fault_on([](SimLightSettings& light) { light.white = 0.0; }).code == "measure.light");
  CHECK(fault_on([](SimLightSettings& light) { light.ambient = 0.5; }).code == "measure.saturated");
  const Fault hum = fault_on([](SimLightSettings& light) {
    light.hum = 0.1;
    light.hum_hz = 60.0;
    light.ambient = 0.15;
  });
  CHECK(hum.code == "measure.hum");
  CHECK(fault_on([](SimLightSettings& light) { light.line = 0.0; }).code == "measure.light");
  CHECK(fault_on([](SimLightSettings& light) { light.lines[1].off_d = 5.0; }).code.starts_with("measure."));
  CHECK(fault_on([](SimLightSettings& light) { light.swapped = true; }).code == "measure.swapped");
}

TEST_CASE("a sensor that is unplugged while the rig measures leaves it dark, and is named") {
  const Stand stand;
  RigClient client = stand.client();
  std::atomic<int> steps = 0;
  const auto measured = client.self_test({}, [&](const std::string&, double) {
    if (++steps == 9) stand.sensor().unplug();
  });
  REQUIRE_FALSE(measured);
  CHECK(measured.fault().code == "light.gone");
  CHECK(measured.fault().where == "light sensor");
  CHECK(client.state()->state == "dark");
  CHECK_FALSE(client.describe()->measurement);
  bool told = false;
  const auto state = client.state();
  REQUIRE(state);
  for (const PartReport& part : state->parts) told = told || part.fault.find("unplugged") != std::string::npos;
  CHECK(told);
  stand.sensor().plug();
  REQUIRE(client.go());
  RigClient::SelfTestAsked asked;
  asked.harmonics = 1;
  CHECK(client.self_test(asked, {}));
}

TEST_CASE("blackout, and a client that goes, end it in the dark; nothing else gets between") {
  const Stand stand;
  RigClient client = stand.client();
  RigClient other = stand.client();
  SUBCASE("blackout by anybody") {
    std::atomic<int> steps = 0;
    const auto measured = client.self_test({}, [&](const std::string&, double) {
      if (++steps == 5) CHECK(other.blackout());
    });
    REQUIRE_FALSE(measured);
    CHECK(measured.fault().code == "measure.dark");
  }
  SUBCASE("a stop request") {
    std::stop_source stop;
    std::atomic<int> steps = 0;
    const auto measured = client.self_test(
        {},
        [&](const std::string&, double) {
          if (++steps == 5) stop.request_stop();
        },
        stop.get_token());
    REQUIRE_FALSE(measured);
    CHECK(measured.fault().code == "rig.cancelled");
    for (int n = 0; n < 500 && other.state()->state != "dark"; ++n) std::this_thread::sleep_for(milliseconds(10));
  }
  SUBCASE("commands of its own holder are refused meanwhile") {
    std::atomic<int> steps = 0;
    RigClient::SelfTestAsked asked;
    asked.harmonics = 1;
    const auto measured = client.self_test(asked, [&](const std::string&, double) {
      if (++steps == 5) CHECK(client.hold().fault().code == "rig.refused");
    });
    CHECK(measured);
  }
  CHECK(other.state()->state == "dark");
}

}  // namespace
}  // namespace focalstage
