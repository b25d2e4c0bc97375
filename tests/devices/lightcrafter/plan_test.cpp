#include "devices/lightcrafter/plan.h"

#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "devices/lightcrafter/timing.h"

namespace focalstage::lightcrafter {
namespace {

constexpr double period_s = 1.0 / 60.0;

Exposures exposures_of(std::vector<double> start_ms, double exposure_ms, int bits = 8, int channels = 1) {
  Exposures exposures;
  exposures.period_s = period_s;
  exposures.form.channels = channels;
  exposures.form.bits = bits;
  for (const double ms : start_ms) exposures.start_s.push_back(1e-3 * ms);
  exposures.exposure_s = 1e-3 * exposure_ms;
  return exposures;
}

std::string refusal(const Exposures& exposures, const PlanRules& rules = {}) {
  const auto plan = plan_patterns(exposures, period_s, rules);
  REQUIRE_FALSE(plan.ok());
  CHECK(plan.fault().code == "projector.unable");
  return plan.fault().message + "; " + plan.fault().remedy;
}

bool says(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// When each lit entry begins and ends, in us from the vsync, as a device that adds up periods has it.
std::vector<std::pair<double, double>> lit(const PatternPlan& plan) {
  std::vector<std::pair<double, double>> times;
  double at = 0.0;
  for (const PlanEntry& entry : plan.entries) {
    if (entry.lut.leds != 0) times.emplace_back(at, at + entry.exposure_us);
    at += entry.period_us;
  }
  return times;
}

TEST_CASE("exposures stand where they were asked for, within a microsecond") {
  const std::vector<double> starts{1.1111, 3.2345, 5.5, 9.87654, 12.3333};
  for (const Gap gap : {Gap::spare_time, Gap::dark_entry}) {
    PlanRules rules;
    rules.gap = gap;
    const auto plan = plan_patterns(exposures_of(starts, 1.75, 4), period_s, rules);
    REQUIRE(plan.ok());
    CHECK(plan->lead_s == doctest::Approx(1.1111e-3));
    const auto times = lit(*plan);
    REQUIRE(times.size() == starts.size());
    for (std::size_t i = 0; i < starts.size(); ++i) {
      CHECK(std::abs(plan->lead_s * 1e6 + times[i].first - 1e3 * starts[i]) <= 1.0);
      CHECK(std::abs(times[i].second - times[i].first - 1750.0) <= 1.0);
    }
    CHECK(plan->entries.size() == (gap == Gap::spare_time ? 5 : 9));
    for (const PlanEntry& entry : plan->entries) {
      CHECK((entry.exposure_us == entry.period_us || entry.exposure_us + dark_us <= entry.period_us));
      CHECK(entry.exposure_us >= least_exposure_us(entry.lut.bits));
      CHECK(entry.lut.trigger ==
            (&entry == plan->entries.data() ? LutEntry::Trigger::external_positive : LutEntry::Trigger::none));
    }
    CHECK(plan->entries.back().lut.black_after);
  }
}

TEST_CASE("exposures that touch do not drift") {
  std::vector<double> starts;
  for (int i = 0; i < 23; ++i) starts.push_back(0.5 + i * 0.6943333);
  const auto plan = plan_patterns(exposures_of(starts, 0.6943333, 1), period_s);
  REQUIRE(plan.ok());
  const auto times = lit(*plan);
  REQUIRE(times.size() == 23);
  for (std::size_t i = 0; i < 23; ++i) CHECK(std::abs(times[i].first + 500.0 - 1e3 * starts[i]) <= 1.0);
  CHECK(plan->entries.size() == 23);
  for (std::size_t i = 0; i < 22; ++i) CHECK_FALSE(plan->entries[i].lut.black_after);
}

TEST_CASE("patterns are numbered in time order, and packed as they are shown") {
  PlanRules rules;
  rules.shown_bits = 2;
  const auto plan = plan_patterns(exposures_of({1, 3, 5}, 2.0), period_s, rules);
  REQUIRE(plan.ok());
  CHECK(plan->pack == PackPlan{912, 1140, 3, 1, 8, 2});
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(plan->entries[i].lut.pattern == i);
    CHECK(plan->entries[i].lut.bits == 2);
    CHECK(plan->entries[i].lut.leds == 7);
  }
}

TEST_CASE("an rgb picture is three patterns, red, green, blue") {
  PlanRules rules;
  rules.shown_bits = 1;
  const auto plan = plan_patterns(exposures_of({1, 4}, 2.5, 8, 3), period_s, rules);
  REQUIRE(plan.ok());
  REQUIRE(plan->entries.size() == 6);
  for (std::size_t i = 0; i < 6; ++i) {
    CHECK(plan->entries[i].lut.leds == 1 << (i % 3));
    CHECK(plan->entries[i].lut.pattern == i);
    CHECK(std::abs(plan->entries[i].exposure_us - 2500.0 / 3.0) <= 1.0);
  }
  CHECK(says(refusal(exposures_of({1, 4}, 0.6, 1, 3)), "200 us is shorter than the least at 1 bits, 235 us"));
}

TEST_CASE("a period without pictures is one dark entry") {
  const auto plan = plan_patterns(exposures_of({}, 1.0), period_s);
  REQUIRE(plan.ok());
  REQUIRE(plan->entries.size() == 1);
  CHECK(plan->entries[0].lut.leds == 0);
  CHECK(plan->pack.pictures == 0);
}

TEST_CASE("each limit is named, with what would do") {
  CHECK(says(refusal(exposures_of({1}, 8.332)), "least at 8 bits, 8333 us"));
  CHECK(says(refusal(exposures_of({1}, 8.332)), "show 7 bits or fewer"));
  CHECK(says(refusal(exposures_of({1, 2, 3, 4}, 0.5, 2)), "least at 2 bits, 700 us"));
  CHECK(says(refusal(exposures_of({1, 2, 3, 4}, 0.5, 2)), "show 1 bit or fewer"));
  CHECK(says(refusal(exposures_of({1, 6, 11}, 0.2, 1)), "show fewer pictures, each for longer"));
  std::vector<double> many;
  for (int i = 0; i < 13; ++i) many.push_back(i * 1.2);
  CHECK(says(refusal(exposures_of(many, 1.1, 2)), "13 patterns of 2 bits need more planes than the 12"));
  CHECK(says(refusal(exposures_of({1, 3}, 2.2, 4)), "exposures 0 and 1 overlap by 200 us"));
  CHECK(says(refusal(exposures_of({3, 1}, 1.0, 1)), "overlap"));
  CHECK(says(refusal(exposures_of({1, 3.2}, 2.0, 4)), "200 us apart, and the least time in the dark is 230 us"));
  PlanRules entries;
  entries.gap = Gap::dark_entry;
  CHECK(says(refusal(exposures_of({1, 3.232}, 2.0, 4), entries), "is 235 us"));
  CHECK(plan_patterns(exposures_of({1, 3.232}, 2.0, 4), period_s).ok());
  CHECK(says(refusal(exposures_of({0, 8.3334}, 8.3333)), "230 us must be left before the next vsync"));
  CHECK(says(refusal(exposures_of({0, 14.44}, 2.0, 4)), "must be left"));
  CHECK(plan_patterns(exposures_of({0, 14.43}, 2.0, 4), period_s).ok());
}

TEST_CASE("the display's period must be the sweep's") {
  Exposures exposures = exposures_of({1}, 2.0, 4);
  exposures.period_s = 1.0 / 50.0;
  CHECK(says(refusal(exposures), "period of 20000 us was asked for and the display gives one of 16667 us"));
  exposures.period_s = 1.001 / 60.0;
  CHECK(plan_patterns(exposures, period_s).ok());
}

TEST_CASE("numbers that are none are refused") {
  CHECK_FALSE(refusal(exposures_of({1}, 2.0, 9)).empty());
  CHECK_FALSE(refusal(exposures_of({1}, 2.0, 0)).empty());
  CHECK_FALSE(refusal(exposures_of({1}, 2.0, 4, 2)).empty());
  CHECK_FALSE(refusal(exposures_of({std::nan("")}, 2.0, 4)).empty());
  CHECK_FALSE(refusal(exposures_of({1}, std::nan(""), 4)).empty());
  CHECK_FALSE(refusal(exposures_of({1}, -2.0, 4)).empty());
  CHECK_FALSE(refusal(exposures_of({1e12}, 2.0, 4)).empty());
  PlanRules deeper;
  deeper.shown_bits = 5;
  CHECK_FALSE(refusal(exposures_of({1}, 3.0, 4), deeper).empty());
}

}  // namespace
}  // namespace focalstage::lightcrafter
