#include "devices/mcc1208/pace.h"

#include <cmath>
#include <random>

#include <doctest/doctest.h>

namespace focalstage {
namespace {

constexpr double period_s = 1.0 / 60.0;

// A device that began at `start_s`, keeps `kept` periods in its memory and whose clock is fast by `ppm`: when it takes
// its periods, each up to `late_s` late as busy hosts see it.
struct Told {
  Mcc1208Pace pace;
  double now_s = 0.0;
};
Told after(int periods, double start_s, double kept, double ppm, double late_s) {
  Told told{Mcc1208Pace(start_s, period_s), start_s};
  std::mt19937 chance(7);
  std::uniform_real_distribution<double> part(0.0, 1.0);
  for (int i = 0; i < periods; ++i) {
    const double room_s = std::max(0.0, i + 1 - kept) * period_s * (1.0 - 1e-6 * ppm);
    told.now_s = std::max(told.now_s, start_s + room_s + late_s * std::pow(part(chance), 4));
    told.pace.taken(told.now_s);
  }
  return told;
}

TEST_CASE("before the first quarter of a second the pacer alone tells") {
  Mcc1208Pace pace(10.0, period_s);
  CHECK(pace.begun(9.99) == 0);
  CHECK(pace.began_s(0) == 0.0);
  CHECK(pace.begun(10.001) == 1);
  CHECK(pace.begun(10.02) == 1);  // no second one has reached the device
  pace.taken(10.001);
  pace.taken(10.002);
  CHECK(pace.begun(10.02) == 2);
  CHECK(pace.began_s(2) == doctest::Approx(10.0 + period_s));
}

TEST_CASE("an hour of a crystal that is 80 ppm fast stays within 2 ms") {
  const int periods = 60 * 3600;
  const Told told = after(periods, 100.0, 2.56, 80.0, 0.003);
  const double truth_s = period_s * (1.0 - 80e-6);  // the drift over the hour is 0.29 s
  const auto begun = told.pace.begun(told.now_s);
  const double really = (told.now_s - 100.0) / truth_s;
  CHECK(std::abs(static_cast<double>(begun) - really) < 1.2);
  CHECK(std::abs(told.pace.began_s(begun) - (100.0 + static_cast<double>(begun - 1) * truth_s)) < 0.002);
}

TEST_CASE("a device that slows down is followed at once: what it did not take it cannot have played") {
  Told told = after(600, 0.0, 2.56, 0.0, 0.0);
  const auto begun = told.pace.begun(told.now_s);
  CHECK(told.pace.begun(told.now_s + 10.0) <= begun + 2);
  told.pace.taken(told.now_s + 10.0);
  CHECK(told.pace.begun(told.now_s + 10.0) <= begun + 2);
  CHECK(told.pace.begun(told.now_s + 10.0) >= begun);
}

}  // namespace
}  // namespace focalstage
