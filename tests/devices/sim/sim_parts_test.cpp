#include <doctest/doctest.h>

#include "devices/sim/sim_projector.h"
#include "devices/sim/sim_shutter.h"

namespace focalstage {
namespace {

Picture picture(std::uint8_t code) {
  auto bytes = std::make_shared<const std::vector<std::uint8_t>>(4, code);
  return {bytes, *bytes};
}

int code_of(const std::optional<StartedExposure>& exposure) {
  if (!exposure) return -1;
  return exposure->picture.codes.empty() ? 0 : exposure->picture.codes[0];
}

TEST_CASE("a shutter opens in 3 ms, closes in 0.1 ms, and turns back where it is") {
  SimShutter shutter({0.003, 0.0001});
  CHECK(shutter.at(-5.0) == 1.0);
  shutter.command(ShutterLevel::closed, 1.0);
  CHECK(shutter.at(1.00005) == doctest::Approx(0.5));
  CHECK(shutter.at(1.0001) == doctest::Approx(0.0));
  shutter.command(ShutterLevel::open, 2.0);
  CHECK(shutter.at(2.0015) == doctest::Approx(0.5));
  shutter.command(ShutterLevel::closed, 2.0015);
  CHECK(shutter.at(2.0015 + 0.00005) == doctest::Approx(0.0));
  shutter.command(ShutterLevel::open, 3.0);
  CHECK(shutter.during(2.9, 3.1).least == 0.0);
  CHECK(shutter.during(2.9, 3.1).most == 1.0);
  CHECK(shutter.during(3.0031, 3.1).least == doctest::Approx(1.0));
}

TEST_CASE("what a shutter did between two instants is not missed") {
  SimShutter shutter({0.003, 0.0001});
  shutter.command(ShutterLevel::closed, 1.0);
  shutter.command(ShutterLevel::open, 1.001);
  CHECK(shutter.during(0.5, 1.5).least == doctest::Approx(0.0));
}

TEST_CASE("a shutter 2 ms late does everything 2 ms later") {
  SimShutter shutter({0.003, 0.0001});
  shutter.set_late(0.002);
  shutter.command(ShutterLevel::closed, 1.0);
  CHECK(shutter.at(1.0019) == 1.0);
  CHECK(shutter.at(1.0022) == doctest::Approx(0.0));
}

TEST_CASE("triggers show the posted images in order, after the latency") {
  SimProjector projector({0.00015, 1.0 / 2840});
  projector.set_exposure(0.0005);
  projector.post({picture(1), picture(2)});
  projector.sync_edge();
  const auto first = projector.trigger(0.001);
  REQUIRE(first);
  CHECK(first->start_s == doctest::Approx(0.00115));
  CHECK(first->duration_s == 0.0005);
  CHECK(code_of(first) == 1);
  CHECK(code_of(projector.trigger(0.002)) == 2);
  CHECK(code_of(projector.trigger(0.003)) == 0);
}

TEST_CASE("a trigger within the frame time of the last is lost") {
  SimProjector projector({0.00015, 0.0005});
  projector.post({picture(1), picture(2)});
  projector.sync_edge();
  CHECK(code_of(projector.trigger(0.0010)) == 1);
  CHECK(code_of(projector.trigger(0.0014)) == -1);
  CHECK(code_of(projector.trigger(0.0015)) == 2);
}

TEST_CASE("a lost trigger misplaces the rest of one sweep and no more") {
  SimProjector projector({});
  projector.drop_trigger_after(1);
  projector.post({picture(1), picture(2), picture(3)});
  projector.post({picture(4), picture(5), picture(6)});
  projector.sync_edge();
  CHECK(code_of(projector.trigger(0.001)) == 1);
  CHECK(code_of(projector.trigger(0.002)) == -1);
  CHECK(code_of(projector.trigger(0.003)) == 2);
  projector.sync_edge();
  CHECK(code_of(projector.trigger(0.011)) == 4);
}

TEST_CASE("a trigger may lead its sweep's edge by the latency") {
  SimProjector projector({});
  for (const std::uint8_t base : {10, 20, 30}) {
    projector.post({picture(base), picture(static_cast<std::uint8_t>(base + 1))});
  }
  CHECK(code_of(projector.trigger(0.999)) == 10);
  projector.sync_edge();
  CHECK(code_of(projector.trigger(1.005)) == 11);
  CHECK(code_of(projector.trigger(1.019)) == 20);
  projector.sync_edge();
  CHECK(code_of(projector.trigger(1.025)) == 21);
  projector.sync_edge();
  CHECK(code_of(projector.trigger(1.040)) == 30);
}

}  // namespace
}  // namespace focalstage
