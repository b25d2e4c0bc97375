#include "devices/rig/beat_follower.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <random>

#include <doctest/doctest.h>

namespace focalstage {
namespace {

constexpr double projector_s = 1.0 / 59.94;

/// A drive with a crystal of its own, a queue, and edges that come with its scans; a board that looks at them thirty
/// times a second, and now and then stamps one late.
struct Stand {
  double drive_ppm = 60.0;
  double wanted_s = 0.014;
  double noise_s = 1e-6;

  double now_s = 0.0;
  double drive_period_s = projector_s;  ///< by its own clock
  double slew_s = 0.0;
  double edge_s = 0.0061;  ///< the drive's newest
  BeatFollower follower{{projector_s, wanted_s}};
  std::deque<std::pair<double, Steering>> queued;
  std::mt19937 dice{7};
  double worst_s = 0.0;  ///< while it is said to be in step

  double late_s() const {
    const double off_s = edge_s - wanted_s;
    return off_s - projector_s * std::round(off_s / projector_s);
  }

  void run(double seconds) {
    const double end_s = now_s + seconds;
    for (double look_s = now_s; now_s < end_s;) {
      while (!queued.empty() && queued.front().first <= edge_s) {
        drive_period_s = queued.front().second.period_s;
        slew_s += queued.front().second.later_s;
        queued.pop_front();
      }
      const double most_s = 0.01 * drive_period_s;
      const double step_s = std::clamp(slew_s, -most_s, most_s);
      slew_s -= step_s;
      edge_s += (drive_period_s + step_s) * (1.0 + 1e-6 * drive_ppm);
      now_s = edge_s;
      if (follower.in_step()) worst_s = std::max(worst_s, std::abs(late_s()));
      if (now_s < look_s) continue;
      look_s = now_s + 0.03;
      const bool hindered = std::uniform_real_distribution<double>(0, 1)(dice) < 0.05;
      const double scan_s = std::uniform_real_distribution<double>(-21e-6, 21e-6)(dice);  // their mean is known
      const double stamp_s = std::normal_distribution<double>(0.0, noise_s)(dice) + scan_s + (hindered ? 26e-6 : 0.0);
      const auto asked = follower.sees(now_s, std::fmod(edge_s + stamp_s, projector_s));
      if (asked) queued.emplace_back(now_s + 0.15, *asked);
    }
  }
};

TEST_CASE("from any phase a drive comes into step within six seconds, and stays within the bound") {
  for (const double ppm : {-300.0, -60.0, 0.0, 60.0, 300.0}) {
    for (const double from : {0.0, 0.2, 0.49, 0.51, 0.8}) {
      CAPTURE(ppm);
      CAPTURE(from);
      Stand stand;
      stand.drive_ppm = ppm;
      stand.edge_s = from * projector_s + 0.0;
      stand.run(6.0);
      CHECK(stand.follower.in_step());
      stand.run(60.0);
      CHECK(stand.follower.in_step());
      CHECK(stand.worst_s < 20e-6);
      CHECK(std::abs(stand.late_s()) < 10e-6);
    }
  }
}

TEST_CASE("a clock that warms up is followed") {
  Stand stand;
  stand.run(8.0);
  REQUIRE(stand.follower.in_step());
  for (int minute = 0; minute < 5; ++minute) {  // 5 ppm a minute is more than a crystal does
    stand.drive_ppm += 5.0;
    stand.run(60.0);
    CHECK(stand.follower.in_step());
  }
  CHECK(stand.worst_s < 20e-6);
}

TEST_CASE("what slips or was never seen is not in step") {
  Stand stand;
  CHECK_FALSE(stand.follower.in_step());
  stand.run(8.0);
  REQUIRE(stand.follower.in_step());
  stand.edge_s += 0.001;  // a slip, as after a gap
  stand.run(1.2);
  CHECK_FALSE(stand.follower.in_step());
  stand.run(6.0);
  CHECK(stand.follower.in_step());
}

TEST_CASE("one correction at a time, no faster than the drive can show it, and never beyond its bound") {
  BeatFollower follower({projector_s, 0.0});
  int asked = 0;
  for (int look = 0; look < 400; ++look) {
    const auto steering = follower.sees(0.03 * look, 0.0004 * look);  // runs away
    if (!steering) continue;
    ++asked;
    CHECK(std::abs(steering->period_s / projector_s - 1.0) <= 1.001e-3);
    CHECK(std::abs(steering->later_s) <= 0.5 * projector_s + 0.01);
  }
  CHECK(asked >= 5);
  CHECK(asked <= 13);
  CHECK_FALSE(follower.in_step());
}

}  // namespace
}  // namespace focalstage
