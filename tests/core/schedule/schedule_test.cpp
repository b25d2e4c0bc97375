#include "core/schedule/schedule.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "core/schedule/slots.h"

using namespace focalstage;

namespace {

using Kind = SlotTrouble::Kind;

constexpr double period_s = 1.0 / 60.0;

/// The rig of the paper: sine of +-1.5 D at 60 Hz, 2000 images a second, 0.15 ms latency, shutters 3 ms and 0.1 ms.
Project rig(std::vector<double> powers_d) {
  Project project;
  Projector projector;
  projector.name = "main";
  projector.latency_ms = 0.15;
  project.projectors = {projector};
  project.slices.powers_d = std::move(powers_d);
  return project;
}

Project lit(Project project) {
  Surface screen;
  screen.name = "screen";
  screen.illumination = 0.5;
  project.surfaces = {screen};
  return project;
}

ScheduleResult schedule(const Project& project) { return make_schedule(project, image_plan(project)); }

std::vector<Kind> kinds(const ScheduleResult& result) {
  std::vector<Kind> all;
  for (const SlotTrouble& trouble : result.troubles) all.push_back(trouble.kind);
  return all;
}

}  // namespace

TEST_CASE("three rabbits: six exposures, rising for the left eye, falling for the right") {
  const ScheduleResult result = schedule(rig({-1.0, 0.0, 1.0}));
  CHECK(result.troubles.empty());
  const std::vector<Slot>& slots = result.schedule.slots;
  REQUIRE(slots.size() == 6);
  // -1.5 cos(2 pi 60 t) = p: acos(2/3) = 0.8410687, pi/2, acos(-2/3) = 2.3005240 over 2 pi 60, then mirrored.
  const std::vector<double> centre_ms{2.2310070, 4.1666667, 6.1023264, 10.5643403, 12.5, 14.4356597};
  const std::vector<double> power_d{-1.0, 0.0, 1.0, 1.0, 0.0, -1.0};
  const std::vector<int> image{0, 1, 2, 5, 4, 3};
  for (std::size_t i = 0; i < slots.size(); ++i) {
    CAPTURE(i);
    CHECK(slots[i].image == image[i]);
    CHECK(slots[i].eye == (i < 3 ? Side::left : Side::right));
    CHECK(slots[i].exposure_s == doctest::Approx(0.0005));
    CHECK(slots[i].start_s == doctest::Approx(centre_ms[i] / 1000.0 - 0.00025).epsilon(1e-7));
    CHECK(slots[i].trigger_s == doctest::Approx(slots[i].start_s - 0.00015));
    CHECK(slots[i].power_d == doctest::Approx(power_d[i]).epsilon(1e-12));
  }
  // At zero the change is 2 * 1.5 * sin(2 pi 60 * 0.25 ms) = 3 sin(0.0942478).
  CHECK(slots[1].smear_d == doctest::Approx(0.2823249).epsilon(1e-6));
  // At 1 D it is that times sin(2.3005240) = sqrt(5)/3.
  CHECK(slots[2].smear_d == doctest::Approx(0.2823249 * std::sqrt(5.0) / 3.0).epsilon(1e-6));
}

TEST_CASE("powers nearer to the extrema than the dead window allows are hidden") {
  // 1.5 cos(2 pi 60 (1.5 ms + 0.25 ms)) = 1.5 cos(0.6597345) = 1.185233 is the last power that clears the window.
  CHECK(schedule(rig({-1.1852, 1.1852})).troubles.empty());
  const ScheduleResult result = schedule(rig({-1.1853, 0.0, 1.1853}));
  CHECK(kinds(result) == std::vector<Kind>(4, Kind::hidden_by_shutter));
  CHECK(result.schedule.slots.size() == 2);  // the rest is timed all the same
  for (const SlotTrouble& trouble : result.troubles) {
    CHECK(trouble.amount > 0.0);
    CHECK(trouble.amount < 1e-6);
  }
}

TEST_CASE("an exposure at the very extremum is hidden even from ideal shutters, by half its length") {
  Project project = rig({1.5});
  project.glasses.shutter_open_ms = project.glasses.shutter_close_ms = 0.0;
  const ScheduleResult result = schedule(project);
  REQUIRE(kinds(result) == std::vector<Kind>(2, Kind::hidden_by_shutter));
  CHECK(result.troubles[0].amount == doctest::Approx(0.00025));
}

TEST_CASE("a power that the sweep never reaches is left out and named with the extreme") {
  const ScheduleResult result = schedule(rig({0.0, 2.0}));
  REQUIRE(kinds(result) == std::vector<Kind>(2, Kind::outside_sweep));
  CHECK(result.troubles[0] == SlotTrouble{Kind::outside_sweep, 1, -1, Side::left, 2.0, 1.5});
  CHECK(result.troubles[1] == SlotTrouble{Kind::outside_sweep, 3, -1, Side::right, 2.0, 1.5});
  CHECK(result.schedule.slots.size() == 2);
}

TEST_CASE("a light image is shown once per eye at zero power") {
  const Project project = lit(rig({-0.5, 0.5}));
  const ScheduleResult result = schedule(project);
  CHECK(result.troubles.empty());
  REQUIRE(result.schedule.slots.size() == 6);
  CHECK(result.schedule.slots[1].image == 4);
  CHECK(result.schedule.slots[1].eye == Side::left);
  CHECK(result.schedule.slots[1].start_s == doctest::Approx(period_s / 4.0 - 0.00025));
  CHECK(result.schedule.slots[4].image == 4);
  CHECK(result.schedule.slots[4].eye == Side::right);
}

TEST_CASE("a slice at zero power carries the light in its own exposure") {
  const ScheduleResult result = schedule(lit(rig({-0.5, 0.0, 0.5})));
  CHECK(result.troubles.empty());
  CHECK(result.schedule.slots.size() == 6);
}

TEST_CASE("light without a zero crossing has nowhere to go") {
  Project project = lit(rig({1.5}));
  project.sweep.min_power_d = 0.25;
  project.sweep.max_power_d = 3.0;
  const ScheduleResult apart = schedule(project);
  CHECK(kinds(apart) == std::vector<Kind>(2, Kind::no_zero_crossing));
  CHECK(apart.troubles[0].amount == 0.25);
  project.slices.powers_d = {0.0, 1.5};  // the slice that would carry it is out of reach, too
  CHECK(kinds(schedule(project)) ==
        std::vector<Kind>{Kind::outside_sweep, Kind::no_zero_crossing, Kind::outside_sweep, Kind::no_zero_crossing});
}

TEST_CASE("light and a slice near zero collide") {
  // 0.1 D is asin(0.1/1.5) / (2 pi 60) = 0.17697 ms after zero; the projector needs 0.5 ms.
  const ScheduleResult result = schedule(lit(rig({0.1})));
  REQUIRE(kinds(result) == std::vector<Kind>(2, Kind::overlap));
  CHECK(result.schedule.slots.size() == 4);  // both stay
  CHECK(result.troubles[0].image == 2);
  CHECK(result.troubles[0].other_image == 0);
  CHECK(result.troubles[0].amount == doctest::Approx(0.00017697).epsilon(1e-4));
  CHECK(result.troubles[0].limit == doctest::Approx(0.0005));
}

TEST_CASE("short exposures do not make the projector faster") {
  Project project = rig({0.0, 0.1});
  project.projectors[0].exposure_ms = 0.1;
  CHECK(kinds(schedule(project)) == std::vector<Kind>(2, Kind::overlap));
  project.projectors[0].frames_per_second = 6000.0;  // 0.167 ms
  CHECK(schedule(project).troubles.empty());
  CHECK(schedule(project).schedule.slots[0].exposure_s == doctest::Approx(0.0001));
}

TEST_CASE("long exposures need more room than the rate says") {
  Project project = rig({0.0, 0.4});  // asin(0.4/1.5) / (2 pi 60) = 0.716 ms apart
  CHECK(schedule(project).troubles.empty());
  project.projectors[0].exposure_ms = 0.72;
  const std::vector<Kind> all = kinds(schedule(project));
  CHECK(std::count(all.begin(), all.end(), Kind::overlap) == 2);
}

TEST_CASE("the last exposure of a period keeps its distance from the first of the next") {
  Project project = rig({-1.49});
  project.glasses.shutter_open_ms = project.glasses.shutter_close_ms = 0.0;
  project.projectors[0].exposure_ms = 0.1;
  // acos(1.49/1.5) / (2 pi 60) = 0.3064 ms on either side of the minimum: 0.6128 ms from start to start.
  project.projectors[0].frames_per_second = 1600.0;  // 0.625 ms
  const ScheduleResult result = schedule(project);
  REQUIRE(kinds(result) == std::vector<Kind>{Kind::overlap});
  CHECK(result.troubles[0].image == 1);
  CHECK(result.troubles[0].other_image == 0);
  CHECK(result.troubles[0].eye == Side::right);
  CHECK(result.troubles[0].amount == doctest::Approx(0.00061276).epsilon(1e-4));
  project.projectors[0].frames_per_second = 1700.0;  // 0.588 ms
  CHECK(schedule(project).troubles.empty());
}

TEST_CASE("smear over 0.3 D is named and stays") {
  Project project = rig({0.0});
  project.projectors[0].exposure_ms = 0.532;  // 3 sin(2 pi 60 * 0.266 ms) = 3 sin(0.1002796) = 0.300335
  const ScheduleResult result = schedule(project);
  REQUIRE(kinds(result) == std::vector<Kind>(2, Kind::smear));
  CHECK(result.troubles[0].amount == doctest::Approx(0.300335).epsilon(1e-5));
  CHECK(result.troubles[0].limit == 0.3);
  CHECK(result.schedule.slots.size() == 2);
  project.projectors[0].exposure_ms = 0.531;
  CHECK(schedule(project).troubles.empty());
}

TEST_CASE("the exposures follow each eye's own waveform, the shutters change between their maxima") {
  Project project = rig({0.0});
  project.glasses.shutter_open_ms = 1.0;
  // Left peaks at 0.4 of the period, right at 0.6; both triangles of +-1 D.
  MeasuredWaveform left;
  MeasuredWaveform right;
  for (int i = 0; i < 10; ++i) {
    left.power_d.push_back(i <= 4 ? -1.0 + i / 2.0 : 1.0 - (i - 4) / 3.0);
    right.power_d.push_back(i <= 6 ? -1.0 + i / 3.0 : 1.0 - (i - 6) / 2.0);
  }
  project.sweep.waveform = {left, right};
  const ScheduleResult result = schedule(project);
  CHECK(result.troubles.empty());
  REQUIRE(result.schedule.slots.size() == 2);
  CHECK(result.schedule.slots[0].start_s == doctest::Approx(0.2 * period_s - 0.00025));
  CHECK(result.schedule.slots[1].start_s == doctest::Approx(0.8 * period_s - 0.00025));
  CHECK(result.schedule.slots[0].smear_d == doctest::Approx(2.0 * 0.0005 / (0.4 * period_s)));
  CHECK(result.schedule.shutter.left.close_s == doctest::Approx(0.5 * period_s - 0.0005));
  CHECK(result.schedule.shutter.right.open_s == doctest::Approx(0.5 * period_s - 0.0005));
}

TEST_CASE("a waveform that is no curve leaves its eye dark and its lens at rest") {
  Project project = rig({0.0});
  project.sweep.waveform.right = MeasuredWaveform{{0.0, 1.0, 1.0}, {}, {}};
  const ScheduleResult result = schedule(project);
  REQUIRE(kinds(result) == std::vector<Kind>{Kind::bad_waveform});
  CHECK(result.troubles[0].eye == Side::right);
  CHECK(result.schedule.slots.size() == 1);
  CHECK(result.schedule.lens_power_d.left.size() == result.schedule.lens_power_d.right.size());
  for (const double drive_a : result.schedule.lens_drive_a.right) CHECK(drive_a == 0.0);
}

TEST_CASE("nothing to show and nobody to show it is no trouble") {
  Project project = rig({});
  CHECK(schedule(project).schedule.slots.empty());
  CHECK(schedule(project).troubles.empty());
  project.projectors.clear();
  project.slices.powers_d = {0.0};
  CHECK(schedule(project).schedule.slots.empty());
  project.sweep.frequency_hz = 0.0;
  CHECK(kinds(schedule(project)) == std::vector<Kind>(2, Kind::bad_waveform));
}
