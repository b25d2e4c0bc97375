#include "editor/viewer/focus_chart.h"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "tests/editor/viewer/viewer_room.h"
#include "tests/support/temporary_folder.h"

using namespace focalstage;

namespace {

constexpr double pupil_m = 0.004;
constexpr double lens_to_pupil_m = 0.015;

FocusCharts charts_of(const Source& source, double focus_m) {
  auto charts = focus_charts(source, Side::left, focus_m);
  if (!charts) FAIL(describe(charts.fault()));
  return *std::move(charts);
}

TwoChoiceTest test_of(const FocusCharts& charts, const TemporaryFolder& folder) {
  auto test = chart_test(charts, folder.path(), no_progress, {});
  if (!test) FAIL(describe(test.fault()));
  return *std::move(test);
}

std::map<std::size_t, double> seen_by(const FocusCharts& charts, const TwoChoiceTest& test, double error_d) {
  return all_seen(test.levels.size(), [&](std::size_t level) -> Result<double> {
    const auto show = ShowReader::open(test.shows[level].show);
    if (!show) return show.fault();
    return seen_chart_difference(*show, eye_at_charts(charts, error_d));
  });
}

/// Contrast of black and white lines under the disc of a defocus: each odd harmonic of the square wave times the disc's
/// transform, 2 J1(x) / x.
double blurred_contrast(double defocus_d, double line_pair_rad) {
  double squares = 0.0;
  for (int n = 1; n < 40; n += 2) {
    const double x = std::numbers::pi * n * pupil_m * std::abs(defocus_d) / line_pair_rad;
    const double left = x < 1e-6 ? 1.0 : 2.0 * std::cyl_bessel_j(1.0, x) / x;
    squares += left * left / n / n;
  }
  return std::sqrt(squares);
}

/// A picture at vergence V from the lens, as it is at the pupil.
double at_pupil_d(double vergence_d) { return vergence_d / (1.0 + vergence_d * lens_to_pupil_m); }

}  // namespace

TEST_CASE("two charts are equally sharp where the lens has the power that the eye's focus asks for") {
  const TemporaryFolder folder;
  for (const double focus_m : {0.4, 0.6}) {
    const FocusCharts charts = charts_of(viewer_room(0.515), focus_m);
    CHECK(charts.power_d == doctest::Approx(2.0 - 1.0 / focus_m).epsilon(1e-4));
    const TwoChoiceTest test = test_of(charts, folder);
    for (const double error_d : {0.15, -0.2}) {
      const auto seen = seen_by(charts, test, error_d);
      CAPTURE(focus_m);
      CAPTURE(error_d);
      CHECK(std::abs(crossing(test.levels, seen) + error_d) < 0.015);
      for (std::size_t k = 0; k < test.levels.size(); ++k) {
        const double between_d = charts.power_d + test.levels[k] + error_d;
        const auto contrast = [&](double power_d) {
          return blurred_contrast(at_pupil_d(2.0 - power_d) - at_pupil_d(1.0 / focus_m), tangent_deg(charts.line_deg));
        };
        const double expected = std::log(contrast(between_d + 0.35) / contrast(between_d - 0.35));
        CAPTURE(test.levels[k]);
        CHECK(std::abs(seen.at(k) - expected) < 0.02 + 0.12 * std::abs(expected));
      }
    }
  }
}

TEST_CASE("a lens that is off is found and an honest one is not accused") {
  const TemporaryFolder folder;
  const FocusCharts charts = charts_of(viewer_room(0.515), 0.5);
  const TwoChoiceTest test = test_of(charts, folder);
  for (const double error_d : {0.0, 0.15}) {
    const auto seen = seen_by(charts, test, error_d);
    constexpr int people = 40;
    int within_two = 0, accused = 0;
    for (std::uint64_t seed = 0; seed < people; ++seed) {
      PaperRig rig;
      ScriptedObserver observer = person(seen, 0.1, seed);
      const auto found = run_two_choice(rig, test, observer, {});
      REQUIRE(found);
      REQUIRE(*found);
      CHECK((*found)->inside);
      CHECK_FALSE(rig.lit);
      // A camera's focus is known; of a person's, 0.15 D at best.
      const LensPowerCheck camera = lens_power_check(charts, **found, 0.02);
      CHECK(camera.uncertainty_d < 0.06);
      within_two += std::abs(camera.error_d - error_d) <= 2.0 * camera.uncertainty_d ? 1 : 0;
      accused += camera.differs ? 1 : 0;
      const LensPowerCheck eye = lens_power_check(charts, **found, 0.15);
      CHECK(eye.uncertainty_d == doctest::Approx(std::sqrt(0.15 * 0.15 + camera.answers_d * camera.answers_d)));
      CHECK_FALSE(eye.differs);
    }
    CAPTURE(error_d);
    CHECK(within_two >= people * 90 / 100);
    if (error_d == 0.0) CHECK(accused <= people * 10 / 100);
    if (error_d != 0.0) CHECK(accused >= people * 95 / 100);
  }
}

TEST_CASE("charts are shown where the sweep, the surface and the projector let them") {
  const TemporaryFolder folder;
  const auto far = chart_test(charts_of(viewer_room(0.515), 1.0), folder.path(), no_progress, {});
  REQUIRE_FALSE(far.ok());
  CHECK(far.fault().code == "viewer.unreachable");
  CHECK(far.fault().message.find("1.00 D") != std::string::npos);
  Source nothing = viewer_room();
  nothing.project.surfaces.clear();
  CHECK(focus_charts(nothing, Side::left, 0.5).fault().code == "viewer.surface");
  Source unlit = viewer_room();
  unlit.project.projectors.clear();
  CHECK(focus_charts(unlit, Side::left, 0.5).fault().code == "viewer.refused");
  Source turned = viewer_room();
  turned.project.projectors[0].pose.rotation = {0.0, 0.0, 1.0, 0.0};  // away from the wall
  CHECK(focus_charts(turned, Side::left, 0.5).fault().code == "viewer.refused");
}
