#include "devices/player/sweep_plan.h"

#include <cmath>
#include <functional>

#include <doctest/doctest.h>

#include "tests/devices/sample_show.h"

namespace focalstage {
namespace {

TEST_CASE("the plan of a show: drive step, triggers, shutters in time order, sweeps of a frame") {
  const auto plan = sweep_plan(sample::header(3, 30.0), 8);
  REQUIRE(plan);
  CHECK(plan->sweeps_per_frame == 2);
  CHECK(plan->exposure_s == 0.0005);
  CHECK(plan->drive_step_s == doctest::Approx(1.0 / 960.0));
  CHECK(plan->image == std::vector{0, 1, 2, 3});
  CHECK(plan->trigger_s[1] == doctest::Approx(0.00635));
  CHECK(plan->form == PictureForm{1, 8});
  REQUIRE(plan->shutters.size() == 4);
  // At 6.83 ms left closes and right opens, at 15.17 ms the reverse.
  CHECK(plan->shutters[0].time_s == doctest::Approx(0.5 / 60.0 - 0.0015));
  CHECK(plan->shutters[0].eye == Side::left);
  CHECK(plan->shutters[0].level == ShutterLevel::closed);
  CHECK(plan->shutters[1].eye == Side::right);
  CHECK(plan->shutters[1].level == ShutterLevel::open);
  CHECK(plan->shutters[2].eye == Side::left);
  CHECK(plan->shutters[2].level == ShutterLevel::open);
}

TEST_CASE("two plans move alike unless drive, period or shutters differ") {
  const auto plan = *sweep_plan(sample::header(1), 8);
  CHECK(plan.moves_as(*sweep_plan(sample::header(9, 20.0), 8)));
  const auto differs = [&](const std::function<void(ShowHeader&)>& change) {
    ShowHeader header = sample::header(1);
    change(header);
    return !plan.moves_as(*sweep_plan(header, 8));
  };
  CHECK(differs([](ShowHeader& show) { show.schedule.lens_drive_a.right[0] += 1e-9; }));
  CHECK(differs([](ShowHeader& show) { show.schedule.period_s *= 1.01; }));
  CHECK(differs([](ShowHeader& show) { show.schedule.shutter.left.open_s += 1e-6; }));
}

TEST_CASE("two plans fire alike unless times or the form of the pictures differ") {
  ShowHeader header = sample::header(1);
  const auto plan = *sweep_plan(header, 8);
  CHECK(plan.fires_as(*sweep_plan(sample::header(9), 8)));
  CHECK(!plan.fires_as(*sweep_plan(header, 4)));
  header.channels = 3;
  CHECK(!plan.fires_as(*sweep_plan(header, 8)));
  header.channels = 1;
  header.schedule.slots[2].trigger_s += 1e-6;
  CHECK(!plan.fires_as(*sweep_plan(header, 8)));
}

TEST_CASE("a schedule that no rig could follow is refused with its place") {
  const auto where = [](const std::function<void(ShowHeader&)>& change) {
    ShowHeader header = sample::header(1);
    change(header);
    const auto plan = sweep_plan(header, 8);
    return plan ? std::string() : plan.fault().code + " " + plan.fault().where;
  };
  const std::string slot_2 = "show.schedule /projector/0/slot 2";
  CHECK(where([](ShowHeader& show) { show.schedule.slots[2].image = 4; }) == slot_2);
  CHECK(where([](ShowHeader& show) { show.schedule.slots[2].image = -1; }) == slot_2);
  CHECK(where([](ShowHeader& show) { show.schedule.slots[2].trigger_s = NAN; }) == slot_2);
  CHECK(where([](ShowHeader& show) { show.schedule.slots[2].trigger_s = 0.004; }) == slot_2);
  CHECK(where([](ShowHeader& show) { show.schedule.slots[2].exposure_s = 0.0006; }) == slot_2);
  CHECK(where([](ShowHeader& show) { show.schedule.slots[2].start_s = 1e9; }) == slot_2);
  CHECK(where([](ShowHeader& show) { show.schedule.lens_drive_a.left.clear(); }) == "show.schedule /lens/drive_a");
  CHECK(where([](ShowHeader& show) { show.schedule.shutter.right.open_s = NAN; }) == "show.schedule /shutter/right_s");
  CHECK(where([](ShowHeader& show) { show.schedule.period_s = NAN; }) == "show.schedule /");
  CHECK(where([](ShowHeader& show) { show.rate_hz = 0.0; }) == "show.schedule /");
}

}  // namespace
}  // namespace focalstage
