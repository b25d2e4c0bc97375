#include "devices/plugin/drive_samples.h"

#include <doctest/doctest.h>

namespace focalstage {
namespace {

TEST_CASE("more samples than it takes are sampled again along straight lines, over the same period") {
  DriveAbilities able;
  able.most_a = 1.0;
  able.most_samples = 4;
  DrivePeriod period;
  period.period_s = 0.016;
  period.drive_a.left = {0.0, 0.1, 0.2, 0.3, 0.4, 0.3, 0.2, 0.1};
  period.drive_a.right = period.drive_a.left;
  const auto samples = drive_samples(period, able, "here");
  REQUIRE(samples.ok());
  CHECK(samples->period_ns == doctest::Approx(16e6));
  CHECK(samples->drive_a.left == std::vector<double>{0.0, 0.2, 0.4, 0.2});
  CHECK(samples->told().count == 4);
  able.most_samples = 3;  // 8/3 apart: at 0, 2.667 and 5.333 of the old ones
  const auto three = drive_samples(period, able, "here");
  CHECK(three->drive_a.right[1] == doctest::Approx(0.2 + 0.1 * 2.0 / 3.0));
  CHECK(three->drive_a.right[2] == doctest::Approx(0.3 - 0.1 / 3.0));
}

TEST_CASE("no period, and a place that is named") {
  const auto none = drive_samples({}, {}, "here");
  CHECK(none.fault().code == "drive.unable");
  CHECK(none.fault().where == "here");
  DrivePeriod period;
  period.period_s = 0.016;
  period.drive_a.left = {0.1, 0.2};
  period.drive_a.right = {0.1};
  CHECK_FALSE(drive_samples(period, {}, "here").ok());
}

}  // namespace
}  // namespace focalstage
