#include "devices/rig/trigger_watch.h"

#include <optional>

#include <doctest/doctest.h>

namespace focalstage {
namespace {

constexpr double period_s = 1.0 / 60.0;
const std::vector<TableTrigger> uneven{{0.004, 1, 0}, {0.012, 2, 0}, {0.0157, 0, 1}};
// Two eyes: the pauses about both extrema are alike.
const std::vector<TableTrigger> even{{0.003, 0, 0},  {0.0042, 1, 0}, {0.0054, 2, 0},
                                     {0.0113, 3, 0}, {0.0125, 4, 0}, {0.0137, 5, 0}};

/// Looks every `step_s` at a count of which the trigger `lost` is missing; when it was found, if it was.
std::optional<double> found_s(const std::vector<TableTrigger>& triggers, std::optional<int> lost, double step_s) {
  TriggerWatch watch(triggers, period_s);
  int n = 0;
  std::uint64_t count = 0;
  double looked_s = 0.0;
  for (int period = 0; period < 40; ++period) {
    for (const TableTrigger& trigger : triggers) {
      const double at_s = period * period_s + trigger.at_s;
      for (; looked_s < at_s; looked_s += step_s) {
        if (!watch.sample(looked_s, count)) return looked_s;
      }
      if (n++ != lost) ++count;
    }
  }
  return std::nullopt;
}

TEST_CASE("no trigger lost: nothing is found, however fast one looks") {
  for (const double step_s : {0.0002, 0.0005, 0.001, 0.002, 0.003}) {
    CHECK(!found_s(uneven, std::nullopt, step_s));
    CHECK(!found_s(even, std::nullopt, step_s));
  }
}

TEST_CASE("whichever trigger is lost, it is found within three periods") {
  for (const auto& triggers : {uneven, even}) {
    for (int lost = 12; lost < 18; ++lost) {
      const auto at_s = found_s(triggers, lost, 0.001);
      REQUIRE(at_s);
      const double lost_s = (lost / static_cast<int>(triggers.size())) * period_s;
      CHECK(*at_s - lost_s < 3.5 * period_s);
    }
  }
}

TEST_CASE("looks that are far apart tell nothing") { CHECK(!found_s(uneven, 12, 0.006)); }

TEST_CASE("no triggers, no doubt") {
  TriggerWatch watch({}, period_s);
  for (int i = 0; i < 100; ++i) CHECK(watch.sample(0.002 * i, 0));
}

}  // namespace
}  // namespace focalstage
