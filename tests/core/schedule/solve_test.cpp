#include "core/schedule/solve.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/optics/image_plan.h"
#include "core/schedule/place_powers.h"
#include "core/schedule/slots.h"
#include "core/schedule/solve_attempt.h"
#include "tests/support/chance.h"
#include "tests/support/models.h"

using namespace focalstage;
using Limit = SolveTrouble::Limit;
using Change = NearestSetting::Change;

namespace {

/// The paper's rig with one object.
Project rig() {
  Project project;
  project.projectors.emplace_back();
  project.slices.powers_d = {-1.0, 0.0, 1.0};
  project.surfaces.emplace_back();
  project.objects.emplace_back();
  return project;
}

Project lit(Project project) {
  project.surfaces[0].illumination = 0.5;
  return project;
}

/// One object that needs all powers from `low_d` to `high_d` alike.
Needs needs_from(double low_d, double high_d) {
  ObjectNeeds object;
  object.looks = 1000;
  for (const Side eye : both_sides) {
    for (int i = static_cast<int>(std::lround(low_d * 100)); i <= static_cast<int>(std::lround(high_d * 100)); ++i) {
      object.powers[eye].add(i / 100.0, 10);
    }
  }
  return {{object}};
}

Needs needs_at(const std::vector<double>& powers_d) {
  ObjectNeeds object;
  object.looks = 1000;
  for (const double power_d : powers_d) object.powers.left.add(power_d, 10);
  return {{object}};
}

SolveResult solved(const Project& project, const Needs& needs, const SolveWishes& wishes = {}) {
  return solve(project, needs, wishes, support::models());
}

/// The proposal as the scheduler sees it.
std::vector<SlotTrouble> troubles(const Project& project, const SolvedRig& found) {
  const Project after = with_rig(project, found);
  return time_slots(after, image_plan(after)).troubles;
}

const SolveTrouble* find(const SolveResult& result, Limit limit) {
  const auto found = std::find_if(result.troubles.begin(), result.troubles.end(),
                                  [&](const SolveTrouble& trouble) { return trouble.limit == limit; });
  return found == result.troubles.end() ? nullptr : &*found;
}

const NearestSetting* find(const SolveResult& result, Change change) {
  const auto found = std::find_if(result.nearest.begin(), result.nearest.end(),
                                  [&](const NearestSetting& setting) { return setting.change == change; });
  return found == result.nearest.end() ? nullptr : &*found;
}

/// Everything that a proposal promises, from the project and the needs alone.
void check_promises(const Project& project, const Needs& needs, const SolvedRig& found, double spacing_d) {
  CHECK(troubles(project, found).empty());
  CHECK(std::is_sorted(found.powers_d.begin(), found.powers_d.end()));
  CHECK(std::adjacent_find(found.powers_d.begin(), found.powers_d.end()) == found.powers_d.end());
  CHECK(found.min_power_d >= project.glasses.lens_range_d[0] - 1e-9);
  CHECK(found.max_power_d <= project.glasses.lens_range_d[1] + 1e-9);
  for (std::size_t n = 1; n < found.powers_d.size(); ++n) {
    CHECK(found.powers_d[n] - found.powers_d[n - 1] <= spacing_d + 1e-6);
  }
  const PowerHistogram all = needs.all();
  if (all.empty()) return;
  CHECK(all.lowest_d() >= found.powers_d.front() - 0.3 - 1e-6);
  CHECK(all.highest_d() <= found.powers_d.back() + 0.3 + 1e-6);
}

}  // namespace

TEST_CASE("a scene of two dioptres: five slices, nothing beyond, a sweep that clears the shutters") {
  const Needs needs = needs_from(-1.0, 1.0);
  const SolveResult result = solved(rig(), needs);
  REQUIRE(result.rig);
  check_promises(rig(), needs, *result.rig, 0.6);
  CHECK(result.rig->powers_d.size() == 5);
  CHECK(result.rig->powers_d.front() == -1.0);
  CHECK(result.rig->powers_d.back() == 1.0);
  CHECK(result.rig->beyond_d == 0.0);
  // 3 ms of shutter and 0.5 ms of exposure: c = cos(2 pi 60 1.75e-3) = 0.79016; 1 / c = 1.2656.
  CHECK(result.rig->min_power_d == doctest::Approx(-1.27));
  CHECK(result.rig->max_power_d == doctest::Approx(1.27));
  CHECK(result.lowest_need_d == -1.0);
  CHECK(result.after.worst_d <= 0.3);
  CHECK(result.after.mean_d < result.before.mean_d);
  CHECK(result.troubles.empty());
  CHECK(result.nearest.empty());
}

TEST_CASE("no smaller sweep serves: every one that lacks 0.02 D at an end hides a slice") {
  for (const auto& [low_d, high_d] : {std::pair{-1.0, 1.0}, {-2.6, -1.6}, {0.3, 1.4}, {-0.4, 0.4}}) {
    const SolveResult result = solved(rig(), needs_from(low_d, high_d));
    REQUIRE(result.rig);
    for (const auto& [less_low_d, less_high_d] : {std::pair{0.02, 0.0}, {0.0, 0.02}, {0.02, 0.02}}) {
      SolvedRig smaller = *result.rig;
      smaller.min_power_d += less_low_d;
      smaller.max_power_d -= less_high_d;
      CHECK_FALSE(troubles(rig(), smaller).empty());
    }
  }
}

TEST_CASE("light wants zero power, whether or not a picture does") {
  const Needs needs = needs_from(-2.6, -1.6);
  const SolveResult dark = solved(rig(), needs);
  const SolveResult light = solved(lit(rig()), needs);
  REQUIRE(dark.rig);
  REQUIRE(light.rig);
  check_promises(lit(rig()), needs, *light.rig, 0.6);
  CHECK(dark.rig->max_power_d < 0.0);
  CHECK(light.rig->max_power_d > 0.0);
  CHECK(light.rig->powers_d.back() < 0.0);  // no slice is spent on it
  const SolveResult around = solved(lit(rig()), needs_from(-0.5, 0.5));
  REQUIRE(around.rig);
  check_promises(lit(rig()), needs_from(-0.5, 0.5), *around.rig, 0.6);
}

TEST_CASE("so many slices: where they lose least, never more than at even steps") {
  support::Chance chance(21);
  int offered = 0;
  for (int round = 0; round < 60; ++round) {
    ObjectNeeds object;
    object.looks = 1;
    for (int cluster = chance.whole(1, 4); cluster > 0; --cluster) {
      const double centre_d = chance.between(-1.2, 1.2);
      const double half_d = chance.between(0.0, 0.3);
      for (int i = 0; i < 40; ++i) {
        object.powers.left.add(chance.between(centre_d - half_d, centre_d + half_d),
                               static_cast<std::uint64_t>(chance.whole(1, 9)));
      }
    }
    const Needs needs{{object}};
    SolveWishes wishes;
    wishes.slices = chance.whole(1, 6);
    const Project project = chance.one_in(2) ? lit(rig()) : rig();
    const SolveResult result = solved(project, needs, wishes);
    if (!result.rig) continue;
    ++offered;
    check_promises(project, needs, *result.rig, 1.0);
    CHECK(static_cast<int>(result.rig->powers_d.size()) == *wishes.slices);
    CHECK(result.medians.mean_d <= result.after.mean_d + 1e-9);
    CHECK(result.medians.mean_d <= result.uniform.mean_d + 1e-9);
    SolvedRig even = *result.rig;  // where even steps can be shown, the proposal is no worse
    even.powers_d = uniform_powers(needs.all(), *wishes.slices);
    const double gap_d = even.powers_d.size() > 1 ? even.powers_d[1] - even.powers_d[0] : 0.0;
    const bool distinct = even.powers_d.size() == 1 || gap_d > 1e-6;
    if (distinct && gap_d <= 1.0 && troubles(project, even).empty()) {
      CHECK(result.after.mean_d <= result.uniform.mean_d + 1e-9);
    }
  }
  CHECK(offered > 25);
}

TEST_CASE("the fewest slices for a wanted error: nothing farther than that, and one fewer would not do") {
  for (const double error_d : {0.1, 0.15, 0.25, 0.5}) {
    SolveWishes wishes;
    wishes.max_error_d = error_d;
    const Needs needs = needs_from(-0.6, 0.6);
    const SolveResult result = solved(rig(), needs, wishes);
    REQUIRE(result.rig);
    check_promises(rig(), needs, *result.rig, 1.0);
    CHECK(result.after.worst_d <= error_d + 1e-9);
    // Each slice serves 2 e of 1.2 D, though at the ends no need lies more than 0.3 D beyond and slices 1 D apart.
    CHECK(result.rig->powers_d.size() == static_cast<std::size_t>(std::ceil(1.2 / (2.0 * error_d) - 1e-9)));
  }
}

TEST_CASE("a gap in the needs takes no slices when an error is wanted, but a spacing is kept") {
  SolveWishes wishes;
  wishes.max_error_d = 0.05;
  const SolveResult result = solved(rig(), needs_at({-0.4, 0.5}), wishes);
  REQUIRE(result.rig);
  CHECK(result.rig->powers_d.size() == 2);
  const SolveResult spaced = solved(rig(), needs_at({-0.4, 0.5}));
  REQUIRE(spaced.rig);
  CHECK(spaced.rig->powers_d.size() == 3);
}

TEST_CASE("one power, one slice, a sweep of a tenth of a dioptre") {
  const SolveResult result = solved(rig(), needs_at({-0.7}));
  REQUIRE(result.rig);
  CHECK(result.rig->powers_d == std::vector<double>{-0.7});
  CHECK(result.rig->max_power_d - result.rig->min_power_d == doctest::Approx(0.1));
  CHECK(troubles(rig(), *result.rig).empty());
}

TEST_CASE("an object pinned to a slice keeps that slice's power") {
  Project project = rig();
  project.slices.powers_d = {0.333, -0.9, 0.0};
  Needs needs = needs_from(-0.5, 0.5);
  ObjectNeeds pinned;
  pinned.index = 1;
  pinned.looks = 10;
  pinned.pinned_slice = 1;
  needs.objects.push_back(pinned);
  pinned.index = 2;
  pinned.pinned_slice = 0;
  needs.objects.push_back(pinned);
  for (const std::optional<int> count : {std::optional<int>{}, std::optional<int>{4}}) {
    SolveWishes wishes;
    wishes.slices = count;
    const SolveResult result = solved(project, needs, wishes);
    REQUIRE(result.rig);
    check_promises(project, needs, *result.rig, 1.0);
    for (const double power_d : {0.333, -0.9}) {
      CHECK(std::count(result.rig->powers_d.begin(), result.rig->powers_d.end(), power_d) == 1);
    }
  }
  needs.objects.back().pinned_slice = 7;
  const SolveResult missing = solved(project, needs);
  CHECK_FALSE(missing.rig);
  CHECK(missing.troubles == std::vector<SolveTrouble>{{Limit::pinned_slice, 7.0, 3.0, 2}});
}

TEST_CASE("powers equal or unsorted are no obstacle") {
  Project project = rig();
  project.slices.powers_d = {1.0, -1.0, 1.0, 0.2, 0.2};
  const SolveResult result = solved(project, needs_from(-1.0, 1.0));
  REQUIRE(result.rig);
  check_promises(project, needs_from(-1.0, 1.0), *result.rig, 0.6);
}

TEST_CASE("random rigs and rooms: what is proposed keeps every promise; what is not says why") {
  support::Chance chance(33);
  int offered = 0;
  int refused = 0;
  for (int round = 0; round < 200; ++round) {
    Project project = chance.one_in(2) ? rig() : lit(rig());
    project.sweep.frequency_hz = chance.between(40, 120);
    project.glasses.shutter_open_ms = chance.between(0.0, 5.0);
    project.glasses.shutter_close_ms = chance.between(0.0, 1.0);
    project.glasses.lens_range_d = {chance.between(-6, -1), chance.between(0.5, 5)};
    project.projectors[0].frames_per_second = chance.between(400, 2840);
    if (chance.one_in(3)) project.projectors[0].exposure_ms = chance.between(0.36, 2.0);
    const double low_d = chance.between(-3, 1);
    const Needs needs = needs_from(low_d, low_d + chance.between(0.0, 3.0));
    SolveWishes wishes;
    if (chance.one_in(3)) wishes.slices = chance.whole(1, 8);
    if (chance.one_in(3)) wishes.spacing_d = chance.between(0.2, 1.0);
    const SolveResult result = solved(project, needs, wishes);
    if (result.rig) {
      ++offered;
      check_promises(project, needs, *result.rig, wishes.spacing_d.value_or(1.0));
      if (wishes.slices) CHECK(static_cast<int>(result.rig->powers_d.size()) == *wishes.slices);
    } else {
      ++refused;
      REQUIRE_FALSE(result.troubles.empty());
      CHECK_FALSE(find(result, Limit::unknown));
      CHECK_FALSE(find(result, Limit::gave_up));
      for (const NearestSetting& setting : result.nearest) {
        CHECK(troubles(project, setting.rig).empty());
      }
    }
  }
  MESSAGE(offered << " solved, " << refused << " refused");
  CHECK(offered > 40);
  CHECK(refused > 40);
}

TEST_CASE("the lens is too weak: by how much, and what of the picture it can show") {
  Project project = rig();
  project.glasses.lens_range_d = {-1.0, 1.0};
  const SolveResult result = solved(project, needs_from(-1.5, 0.5));
  CHECK_FALSE(result.rig);
  const SolveTrouble* trouble = find(result, Limit::lens_range);
  REQUIRE(trouble);
  CHECK(trouble->allowed == -1.0);
  CHECK(trouble->amount < -1.3);  // with 0.3 D left out at either end: -1.2 / 0.79 about a middle of -0.5
  const NearestSetting* narrower = find(result, Change::range);
  REQUIRE(narrower);
  CHECK(narrower->to < 1.0);
  CHECK(narrower->to > 0.5);
  CHECK(narrower->low_d > -1.5);
  CHECK(narrower->high_d == doctest::Approx(0.5));
  CHECK(troubles(project, narrower->rig).empty());
}

TEST_CASE("exposures too long: overlap and smear, and exposures short enough") {
  Project project = rig();
  project.projectors[0].frames_per_second = 1000;
  const SolveResult result = solved(project, needs_from(-1.0, 1.0));
  CHECK_FALSE(result.rig);
  CHECK((find(result, Limit::smear) || find(result, Limit::overlap)));
  const NearestSetting* shorter = find(result, Change::exposure);
  REQUIRE(shorter);
  CHECK(shorter->from == doctest::Approx(1e-3));
  CHECK(shorter->to < 1e-3);
  CHECK(shorter->to > 1.0 / 2840);
  CHECK(troubles(project, shorter->rig).empty());
  SolvedRig longer = shorter->rig;  // 2 % longer would not do
  longer.exposure_ms = *longer.exposure_ms * 1.02;
  longer.frames_per_second = 1000.0 / *longer.exposure_ms;
  Project stretched = with_rig(project, longer);
  CHECK_FALSE(solved(stretched, needs_from(-1.0, 1.0)).rig);
}

TEST_CASE("shutters that fill the half period leave no time") {
  Project project = rig();
  project.glasses.shutter_open_ms = 8.2;
  const SolveResult result = solved(project, needs_from(-0.1, 0.1));
  CHECK_FALSE(result.rig);
  const SolveTrouble* trouble = find(result, Limit::dead_time);
  REQUIRE(trouble);
  CHECK(trouble->amount == doctest::Approx(8.7e-3));
  CHECK(trouble->allowed == doctest::Approx(1.0 / 120));
}

TEST_CASE("too few slices, too many slices: the nearest number that can be had") {
  SolveWishes wishes;
  wishes.slices = 2;
  const SolveResult few = solved(rig(), needs_from(-1.0, 1.0), wishes);
  CHECK_FALSE(few.rig);
  const NearestSetting* more = find(few, Change::slices);
  REQUIRE(more);
  CHECK(more->to == 3.0);
  wishes.slices = 30;
  const SolveResult many = solved(rig(), needs_from(-1.0, 1.0), wishes);
  CHECK_FALSE(many.rig);
  CHECK(find(many, Limit::overlap));
  const NearestSetting* fewer = find(many, Change::slices);
  REQUIRE(fewer);
  CHECK(fewer->to < 12.0);  // 8.33 ms less 3 ms of shutters hold ten exposures of 0.5 ms
  CHECK(fewer->to > 6.0);
}

TEST_CASE("closer than the projector follows: wider apart") {
  SolveWishes wishes;
  wishes.spacing_d = 0.1;
  const SolveResult result = solved(rig(), needs_from(-1.0, 1.0), wishes);
  CHECK_FALSE(result.rig);
  const SolveTrouble* trouble = find(result, Limit::overlap);
  REQUIRE(trouble);
  CHECK(trouble->amount < trouble->allowed);
  CHECK(trouble->allowed == doctest::Approx(0.5e-3));
  const NearestSetting* wider = find(result, Change::spacing);
  REQUIRE(wider);
  CHECK(wider->to > 0.1);
  CHECK(wider->to <= 0.35);
  CHECK(troubles(rig(), wider->rig).empty());
}

TEST_CASE("a measured sweep is kept, slices are placed within it") {
  Project project = rig();
  MeasuredWaveform triangle;
  for (int i = 0; i < 40; ++i) triangle.power_d.push_back(-1.5 + 3.0 * std::min(i, 40 - i) / 20.0);
  project.sweep.waveform = {triangle, triangle};
  project.sweep.min_power_d = -7.0;  // not looked at
  const SolveResult result = solved(project, needs_from(-0.8, 0.6));
  REQUIRE(result.rig);
  check_promises(project, needs_from(-0.8, 0.6), *result.rig, 0.6);
  CHECK(result.rig->min_power_d == -7.0);

  // 1.75 ms of 8.33 ms from either end: 0.21 of 3 D.
  const SolveResult beyond = solved(project, needs_from(-1.9, 0.6));
  CHECK_FALSE(beyond.rig);
  const SolveTrouble* trouble = find(beyond, Limit::fixed_sweep);
  REQUIRE(trouble);
  CHECK(trouble->amount == doctest::Approx(-1.62));
  CHECK(trouble->allowed == doctest::Approx(-0.87));
  const NearestSetting* narrower = find(beyond, Change::range);
  REQUIRE(narrower);
  CHECK(troubles(project, narrower->rig).empty());
}

TEST_CASE("waveforms that are no curve are an answer, not a hang") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const std::vector<double>& power_d :
       std::vector<std::vector<double>>{{nan, 1.0, nan}, {1.0}, {}, {0.0, 1.0, 0.5, 2.0, 1.0}, {2.0, 2.0}}) {
    Project project = rig();
    project.sweep.waveform.left = MeasuredWaveform{power_d, {}, {}};
    const SolveResult result = solved(project, needs_from(-1.0, 1.0));
    CHECK_FALSE(result.rig);
    CHECK(find(result, Limit::bad_waveform));
  }
  Project project = rig();
  project.sweep.frequency_hz = nan;
  CHECK(find(solved(project, needs_from(-1.0, 1.0)), Limit::bad_waveform));
  project.sweep.frequency_hz = 60.0;
  project.sweep.min_power_d = 3.0;  // upside down: the solver says which way round
  CHECK(solved(project, needs_from(-1.0, 1.0)).rig);
  project.sweep.max_power_d = nan;
  CHECK(solved(project, needs_from(-1.0, 1.0)).rig);
}

TEST_CASE("nothing to solve for, nothing that is served, nothing sensible") {
  CHECK(solved(rig(), {}).troubles == std::vector<SolveTrouble>{{Limit::nothing_needed}});
  Needs unserved = needs_at({});
  unserved.objects[0].unlit = 900;
  unserved.objects[0].off_surface = 100;
  CHECK(solved(rig(), unserved).troubles == std::vector<SolveTrouble>{{Limit::unserved, 1.0, 0.0}});

  Project project = rig();
  project.projectors.clear();
  CHECK(find(solved(project, needs_from(-1, 1)), Limit::bad_project));
  project = rig();
  project.glasses.shutter_open_ms = std::numeric_limits<double>::quiet_NaN();
  CHECK(find(solved(project, needs_from(-1, 1)), Limit::bad_project));
  project = rig();
  project.projectors[0].exposure_ms = 0.0;
  CHECK(find(solved(project, needs_from(-1, 1)), Limit::bad_project));
  SolveWishes wishes;
  wishes.slices = 0;
  CHECK(find(solved(rig(), needs_from(-1, 1), wishes), Limit::bad_project));
  wishes = {};
  wishes.spacing_d = -1.0;
  CHECK(find(solved(rig(), needs_from(-1, 1), wishes), Limit::bad_project));
}

TEST_CASE("needs as far as needs go: an answer within the bound") {
  Project project = rig();
  project.glasses.lens_range_d = {-200, 200};
  const SolveResult result = solved(project, needs_from(-100, 100));
  CHECK_FALSE(result.rig);
  CHECK_FALSE(result.troubles.empty());
}

TEST_CASE("a bound that is too small, and a stop, are said") {
  const Needs needs = needs_from(-1.0, 1.0);
  const SolveResult bounded = solve(rig(), needs, {}, support::models(), {100, {}});
  CHECK_FALSE(bounded.rig);
  CHECK(find(bounded, Limit::gave_up));
  std::stop_source stop;
  stop.request_stop();
  const SolveResult stopped = solve(rig(), needs, {}, support::models(), {1'000'000, stop.get_token()});
  CHECK_FALSE(stopped.rig);
  CHECK(find(stopped, Limit::stopped));
}
