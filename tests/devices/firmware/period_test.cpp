#include "devices/firmware/period.h"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <set>

namespace {

/// The ticks between edges `period_ticks` apart, as a counter of whole ticks sees them.
class Edges {
 public:
  Edges(double period_ticks, double phase) : period_ticks_(period_ticks), at_(phase) {}
  std::uint16_t next() {
    const double before = std::floor(at_);
    at_ += period_ticks_;
    return static_cast<std::uint16_t>(std::floor(at_) - before);
  }

 private:
  double period_ticks_;
  double at_;
};

}  // namespace

TEST_CASE("a steady signal locks after three periods and is then scaled by one figure, a quarter tick true") {
  for (const double ticks : {33333.333, 33166.667, 33500.02, 33333.0, 16000.5, 44999.4}) {
    CAPTURE(ticks);
    Edges edges(ticks, 0.37);
    fs_period period{};
    fs_period_measured(&period, edges.next());
    fs_period_measured(&period, edges.next());
    CHECK_FALSE(fs_period_locked(&period));
    fs_period_measured(&period, edges.next());
    CHECK(fs_period_locked(&period));
    for (int i = 0; i < 200; ++i) fs_period_measured(&period, edges.next());
    std::set<std::uint32_t> used;
    for (int i = 0; i < 10'000; ++i) {
      fs_period_measured(&period, edges.next());
      used.insert(period.used_q8);
    }
    CHECK(used.size() <= 1);
    CHECK(std::abs(*used.begin() / 256.0 - ticks) < 0.4);
  }
}

TEST_CASE("a step is followed at once, a period that cannot be ends the lock") {
  fs_period period{};
  for (int i = 0; i < 10; ++i) fs_period_measured(&period, 33333);
  fs_period_measured(&period, 33400);
  CHECK(fs_period_locked(&period));
  CHECK(period.used_q8 == 33400U * 256U);
  fs_period_measured(&period, 34200);
  CHECK_FALSE(fs_period_locked(&period));
  for (int i = 0; i < 3; ++i) fs_period_measured(&period, 34200);
  CHECK(fs_period_locked(&period));
  fs_period_measured(&period, FS_PERIOD_MAX + 1);
  CHECK_FALSE(fs_period_locked(&period));
}

TEST_CASE("bounds are 2 % either side") {
  fs_period period{};
  fs_period_measured(&period, 30000);
  std::uint16_t low = 0;
  std::uint16_t high = 0;
  fs_period_bounds(&period, &low, &high);
  CHECK(low == 29400);
  CHECK(high == 30600);
}

TEST_CASE("scaled times are the true quotient to within a tick's half and a little") {
  for (const unsigned nominal : {FS_PERIOD_MIN + 0U, 33333U, FS_PERIOD_MAX + 0U}) {
    for (double off = -0.029; off < 0.0295; off += 0.0007) {
      fs_period period{};
      period.used_q8 = static_cast<std::uint32_t>(std::lround(nominal * (1 + off) * 256));
      std::int16_t ratio = 0;
      REQUIRE(fs_period_ratio(&period, static_cast<std::uint16_t>(nominal), &ratio));
      for (unsigned ticks = 0; ticks < nominal; ticks += 97) {
        const double truth = ticks * (period.used_q8 / 256.0) / nominal;
        CHECK(std::abs(fs_scale(static_cast<std::uint16_t>(ticks), ratio) - truth) < 0.55);
      }
    }
  }
}

TEST_CASE("a period over 3 % off the nominal one is refused") {
  fs_period period{};
  std::int16_t ratio = 0;
  for (const double off : {-0.5, -0.031, 0.031, 1.0}) {
    period.used_q8 = static_cast<std::uint32_t>(30000 * (1 + off) * 256);
    CHECK_FALSE(fs_period_ratio(&period, 30000, &ratio));
  }
}
