#include "core/calibrate/calibration_report.h"

#include <doctest/doctest.h>

using namespace focalstage;
using doctest::Approx;

namespace {

PointResidual residual(glm::dvec2 pixel, glm::dvec2 off_px, std::optional<double> left_out_px = std::nullopt) {
  return {"", pixel, off_px, 0.0, left_out_px};
}

}  // namespace

TEST_CASE("median, 95 % and worst of known residuals") {
  std::vector<PointResidual> residuals;
  for (int i = 0; i <= 20; ++i) residuals.push_back(residual({10.0 * i, 5.0}, {0.0, -0.1 * i}, 0.2 * i));
  const CalibrationReport report = report_of(residuals, 800, 600);
  CHECK(report.median_px == Approx(1.0));
  CHECK(report.p95_px == Approx(1.9));
  CHECK(report.worst_px == Approx(2.0));
  CHECK(report.worst == 20);
  CHECK(*report.left_out_median_px == Approx(2.0));
}

TEST_CASE("coverage: cells, and the hull's share of the picture") {
  // A right triangle over half the picture, with points inside and on its sides.
  const CalibrationReport report = report_of({residual({0, 0}, {}), residual({800, 0}, {}), residual({0, 600}, {}),
                                              residual({100, 100}, {}), residual({400, 0}, {}), residual({50, 50}, {})},
                                             800, 600);
  CHECK(report.coverage.hull_share == Approx(0.5));
  CHECK(report.coverage.counts[0] == 2);
  CHECK(report.coverage.counts[9] == 1);
  CHECK(report.coverage.counts[7] == 1);
  CHECK(report.coverage.counts[4] == 1);
  CHECK(report.coverage.counts[40] == 1);
  CHECK(report.coverage.touched_share == Approx(5.0 / 48.0));
  CHECK(report_of({residual({1, 1}, {}), residual({2, 2}, {}), residual({3, 3}, {})}, 8, 6).coverage.hull_share == 0.0);
}

TEST_CASE("the limit holds for the median, the left-out median and threefold for 95 %") {
  const auto all = [](double off, double left_out) {
    return report_of(std::vector<PointResidual>(10, residual({1, 1}, {off, 0.0}, left_out)), 8, 6);
  };
  CHECK(check_limit(all(0.9, 0.99)).ok());
  CHECK_FALSE(check_limit(all(1.1, 0.9)).ok());
  CHECK_FALSE(check_limit(all(0.9, 1.1)).ok());
  CHECK(check_limit(all(1.1, 0.9), 2.0).ok());
  std::vector<PointResidual> some_bad(10, residual({1, 1}, {0.1, 0.0}));
  for (std::size_t i = 0; i < 3; ++i) some_bad[i].off_px.x = 4.0;
  CHECK_FALSE(check_limit(report_of(some_bad, 8, 6)).ok());
}
