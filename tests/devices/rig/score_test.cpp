#include "devices/rig/score.h"

#include <doctest/doctest.h>

#include "devices/rig/period_pictures.h"
#include "tests/devices/rig/fake_devices.h"

namespace focalstage {
namespace {

constexpr double period_s = 1.0 / 60.0;

void hand(SweepGatherer& gatherer, double start_s, int code) {
  gatherer.set_exposure(0.0005, {3, 4});
  const std::vector<double> triggers{-0.001, 0.004, 0.012};
  gatherer.announce_triggers(triggers);
  const std::vector<double> drive(400, 0.01);
  for (const Side eye : both_sides) gatherer.set_drive(eye, drive, period_s / 400);
  if (code > 0) {
    gatherer.post_images({test::picture(code), test::picture(code + 1), test::picture(code + 2)});
  } else {
    gatherer.post_images({});
  }
  gatherer.sync_edge(start_s);
  gatherer.shutter(Side::left, ShutterLevel::open, start_s + 0.001);
  gatherer.shutter(Side::left, ShutterLevel::closed, start_s + 0.008);
  if (code > 0) {
    for (const double trigger_s : triggers) gatherer.trigger(start_s + trigger_s);
  }
}

TEST_CASE("sweeps that move alike share one score, however large their times are") {
  SweepGatherer gatherer;
  hand(gatherer, 12345.678, 1);
  const auto first = gatherer.take();
  CHECK(!gatherer.take());
  hand(gatherer, 987654.321, 0);
  const auto second = gatherer.take();
  REQUIRE((first && second));
  CHECK(first->score == second->score);
  CHECK(first->pictures.size() == 3);
  CHECK(second->pictures.empty());
  REQUIRE(first->score->shutter.left);
  CHECK(first->score->shutter.left->close_s == doctest::Approx(0.008));
  CHECK(!first->score->shutter.right);
  CHECK(first->score->form == PictureForm{3, 4});
  CHECK(first->score->drive.period_s == doctest::Approx(period_s));
}

TEST_CASE("a trigger before its sweep's edge is the last of the period before") {
  SweepGatherer gatherer;
  hand(gatherer, 1.0, 10);
  std::deque<HandedSweep> sweeps{*gatherer.take()};
  const auto triggers = table_triggers(*sweeps[0].score);
  REQUIRE(triggers.size() == 3);
  CHECK(triggers[2].at_s == doctest::Approx(period_s - 0.001));
  CHECK(!period_pictures(triggers, sweeps));  // the last picture is the next sweep's
  hand(gatherer, 1.0 + period_s, 20);
  sweeps.push_back(*gatherer.take());
  const auto pictures = period_pictures(triggers, sweeps);
  REQUIRE(pictures);
  REQUIRE(pictures->size() == 3);
  CHECK((*pictures)[0].codes[0] == 11);
  CHECK((*pictures)[1].codes[0] == 12);
  CHECK((*pictures)[2].codes[0] == 20);
}

TEST_CASE("the dark half of a period is black, and a dark period has no pictures") {
  SweepGatherer gatherer;
  std::deque<HandedSweep> sweeps;
  for (const int code : {0, 30, 0, 0}) {
    hand(gatherer, 1.0 + static_cast<double>(sweeps.size()) * period_s, code);
    sweeps.push_back(*gatherer.take());
  }
  const auto triggers = table_triggers(*sweeps[0].score);
  const auto before = period_pictures(triggers, sweeps);
  REQUIRE((before && before->size() == 3));
  CHECK((*before)[0].codes[0] == 0);
  CHECK((*before)[0].codes.size() == 32);
  CHECK((*before)[2].codes[0] == 30);
  sweeps.pop_front();
  sweeps.pop_front();
  const auto after = period_pictures(triggers, sweeps);
  REQUIRE(after);
  CHECK(after->empty());
}

}  // namespace
}  // namespace focalstage
