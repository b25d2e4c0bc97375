#include "core/schedule/place_powers.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/support/chance.h"

using namespace focalstage;

namespace {

PowerHistogram drawn(support::Chance& chance, int cells, double low_d, double high_d) {
  PowerHistogram needs;
  for (int i = 0; i < cells; ++i) {
    needs.add(chance.between(low_d, high_d), static_cast<std::uint64_t>(chance.whole(1, 9)));
  }
  return needs;
}

/// The least mean error of `count` of the powers given, by trying all.
double least_error_d(const PowerHistogram& needs, const std::vector<double>& among_d, std::size_t count,
                     std::vector<double> chosen_d = {}, std::size_t next = 0) {
  if (chosen_d.size() == count) return mean_error_d(needs, chosen_d);
  double least_d = std::numeric_limits<double>::infinity();
  for (std::size_t i = next; i < among_d.size(); ++i) {
    std::vector<double> more_d = chosen_d;
    more_d.push_back(among_d[i]);
    least_d = std::min(least_d, least_error_d(needs, among_d, count, more_d, i + 1));
  }
  return least_d;
}

PlacementRules free_rules(std::vector<double> candidates_d) {
  return {std::move(candidates_d), 1000.0, [](std::size_t) { return true; }, [](std::size_t) { return true; },
          [](std::size_t, std::size_t) { return true; }};
}

Budget plenty() { return Budget(1'000'000'000); }

}  // namespace

TEST_CASE("k medians: as good as the best of all choices, on small histograms") {
  support::Chance chance(7);
  for (int round = 0; round < 200; ++round) {
    const PowerHistogram needs = drawn(chance, chance.whole(1, 9), -2.0, 2.0);
    std::vector<double> among_d;
    for (const PowerHistogram::Cell& cell : needs.cells()) among_d.push_back(cell.power_d);
    for (int count = 1; count <= 4; ++count) {
      const std::vector<double> powers_d = k_medians(needs, count);
      const std::size_t expected = std::min(among_d.size(), static_cast<std::size_t>(count));
      REQUIRE(powers_d.size() == expected);
      CHECK(std::is_sorted(powers_d.begin(), powers_d.end()));
      CHECK(mean_error_d(needs, powers_d) == doctest::Approx(least_error_d(needs, among_d, expected)).epsilon(1e-9));
    }
  }
}

TEST_CASE("k medians are never worse than uniform powers") {
  support::Chance chance(8);
  for (int round = 0; round < 300; ++round) {
    const PowerHistogram needs = drawn(chance, chance.whole(1, 400), chance.between(-9, 0), chance.between(0, 9));
    const int count = chance.whole(1, 12);
    CHECK(mean_error_d(needs, k_medians(needs, count)) <= mean_error_d(needs, uniform_powers(needs, count)) + 1e-12);
  }
}

TEST_CASE("k medians find clusters, whatever lies between them") {
  PowerHistogram needs;
  needs.add(-1.0, 1000);
  needs.add(0.2, 10);
  needs.add(1.0, 1000);
  CHECK(k_medians(needs, 3) == std::vector<double>{-1.0, 0.2, 1.0});
  CHECK(k_medians(needs, 2) == std::vector<double>{-1.0, 1.0});
  CHECK(k_medians(needs, 9) == std::vector<double>{-1.0, 0.2, 1.0});
  CHECK(k_medians(needs, 0).empty());
  CHECK(k_medians({}, 3).empty());
  CHECK(mean_error_d(needs, {1.0, -1.0}) == doctest::Approx(10 * 0.8 / 2010));
  CHECK(worst_error_d(needs, {1.0, -1.0}) == doctest::Approx(0.8));
  CHECK(mean_error_d({}, {1.0}) == 0.0);
}

TEST_CASE("a histogram over the whole range, 64 powers: no wait") {
  PowerHistogram needs;
  for (int i = -10000; i <= 10000; ++i) needs.add(i / 100.0, static_cast<std::uint64_t>(1 + (i * i) % 97));
  const std::vector<double> powers_d = k_medians(needs, 64);
  CHECK(powers_d.size() == 64);
  CHECK(mean_error_d(needs, powers_d) < 200.0 / 64 / 4 * 1.02);
}

TEST_CASE("placing without rules is k medians") {
  support::Chance chance(9);
  for (int round = 0; round < 60; ++round) {
    const PowerHistogram needs = drawn(chance, chance.whole(4, 60), -2.0, 2.0);
    std::vector<double> candidates_d;
    for (const PowerHistogram::Cell& cell : needs.cells()) candidates_d.push_back(cell.power_d);
    Budget budget = plenty();
    const auto placed = place_powers(needs, free_rules(candidates_d), 3, budget);
    REQUIRE(placed);
    CHECK(mean_error_d(needs, *placed) == doctest::Approx(mean_error_d(needs, k_medians(needs, 3))).epsilon(1e-9));
  }
}

TEST_CASE("placing keeps its rules and is the best that does") {
  support::Chance chance(10);
  for (int round = 0; round < 100; ++round) {
    const PowerHistogram needs = drawn(chance, 8, -1.0, 1.0);
    std::vector<double> candidates_d;
    for (int i = -10; i <= 10; i += 2) candidates_d.push_back(i / 10.0);
    PlacementRules rules = free_rules(candidates_d);
    rules.widest_gap_d = 1.0;
    rules.next = [](std::size_t i, std::size_t j) { return j - i >= 2; };  // 0.4 D apart at least
    rules.first = [&](std::size_t i) { return candidates_d[i] <= -0.4; };
    Budget budget = plenty();
    const auto placed = place_powers(needs, rules, 3, budget);
    REQUIRE(placed);
    double least_d = 1e9;
    for (std::size_t a = 0; a < candidates_d.size(); ++a) {
      for (std::size_t b = a + 2; b < candidates_d.size(); ++b) {
        for (std::size_t c = b + 2; c < candidates_d.size(); ++c) {
          const bool kept = candidates_d[a] <= -0.4 && b - a <= 5 && c - b <= 5;
          if (kept)
            least_d = std::min(least_d, mean_error_d(needs, {candidates_d[a], candidates_d[b], candidates_d[c]}));
        }
      }
    }
    CHECK(mean_error_d(needs, *placed) == doctest::Approx(least_d).epsilon(1e-9));
    const std::vector<double>& p = *placed;
    CHECK(p[1] - p[0] > 0.39);
    CHECK(p[2] - p[1] < 1.01);
    CHECK(p[0] <= -0.4);
  }
}

TEST_CASE("as few as there can be, and of those the best") {
  PowerHistogram needs;
  needs.add(0.0, 10);
  needs.add(0.5, 1000);
  needs.add(1.0, 10);
  std::vector<double> candidates_d;
  for (int i = 0; i <= 100; ++i) candidates_d.push_back(i / 100.0);
  PlacementRules rules = free_rules(candidates_d);
  rules.widest_gap_d = 0.6;
  rules.first = [](std::size_t i) { return i == 0; };
  rules.last = [](std::size_t i) { return i == 100; };
  Budget budget = plenty();
  CHECK(place_powers(needs, rules, std::nullopt, budget) == std::vector<double>{0.0, 0.5, 1.0});
  rules.widest_gap_d = 0.4;
  const auto four = place_powers(needs, rules, std::nullopt, budget);
  REQUIRE(four);
  CHECK(four->size() == 4);
  CHECK(worst_error_d(needs, *four) == doctest::Approx(0.1));  // 0 to 0.4 to 0.6 to 1 at best
}

TEST_CASE("no way, too many, no budget, a stop: nothing, at once") {
  PowerHistogram needs;
  needs.add(0.0, 1);
  PlacementRules rules = free_rules({0.0, 1.0, 2.0});
  Budget budget = plenty();
  CHECK_FALSE(place_powers(needs, rules, 4, budget));
  CHECK_FALSE(place_powers(needs, rules, 0, budget));
  CHECK_FALSE(place_powers(needs, free_rules({}), std::nullopt, budget));
  rules.next = [](std::size_t, std::size_t) { return false; };
  CHECK_FALSE(place_powers(needs, rules, 2, budget));
  Budget none(0);
  CHECK_FALSE(place_powers(needs, free_rules({0.0, 1.0, 2.0}), 2, none));
  std::stop_source stop;
  stop.request_stop();
  Budget stopped(1000, stop.get_token());
  CHECK_FALSE(place_powers(needs, free_rules({0.0, 1.0, 2.0}), 2, stopped));
}
