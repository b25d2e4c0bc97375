#include "editor/viewer/breathing_rings.h"

#include <doctest/doctest.h>

#include <cmath>

#include "tests/editor/viewer/viewer_room.h"
#include "tests/support/temporary_folder.h"

using namespace focalstage;

namespace {

BreathingRings rings_of(const Source& source, Side eye = Side::left) {
  auto rings = breathing_rings(source, eye);
  if (!rings) FAIL(describe(rings.fault()));
  return *std::move(rings);
}

}  // namespace

TEST_CASE("the halves meet for the eye whose distance they were made for, whatever the project says") {
  const TemporaryFolder folder;
  for (const double nominal_mm : {15.0, 22.0}) {
    Source source = viewer_room();
    source.project.glasses.lens_to_pupil_mm = nominal_mm;
    const BreathingRings rings = rings_of(source);
    CHECK(rings.surface_m == doctest::Approx(0.5).epsilon(1e-5));
    const auto test = ring_test(rings, folder.path() / "rings.h5", no_progress, {});
    if (!test) FAIL(describe(test.fault()));
    const auto show = ShowReader::open(folder.path() / "rings.h5");
    REQUIRE(show);
    for (const double true_mm : {11.0, 18.0, 27.0}) {
      // The thin lens by hand: the ratio of the halves falls by 2 dioptres times (D - 2 d) over D a metre of error.
      for (const double error_mm : {-4.0, -1.0, 0.0, 1.0, 4.0}) {
        const auto frame = static_cast<std::size_t>(std::lround((true_mm + error_mm - 5.0) / 0.5));
        REQUIRE(test->levels[frame] == doctest::Approx(true_mm + error_mm));
        const auto difference = seen_ring_difference(*show, frame, eye_at_rings(rings, true_mm));
        if (!difference) FAIL(describe(difference.fault()));
        const double d = true_mm * 1e-3;
        const double expected = -2.0 * error_mm * 1e-3 * (0.5 - 2.0 * d) / 0.5;
        CAPTURE(true_mm);
        CAPTURE(error_mm);
        CHECK(std::abs(*difference - expected) < 4e-4 + 0.06 * std::abs(expected));
      }
    }
  }
}

TEST_CASE("people of many noises are recovered within what is said of them") {
  const TemporaryFolder folder;
  const BreathingRings rings = rings_of(viewer_room(), Side::right);
  const auto test = ring_test(rings, folder.path() / "rings.h5", no_progress, {});
  REQUIRE(test);
  const auto show = ShowReader::open(folder.path() / "rings.h5");
  REQUIRE(show);
  constexpr double true_mm = 18.3;
  const auto seen = all_seen(test->levels.size(), [&](std::size_t level) {
    return seen_ring_difference(*show, level, eye_at_rings(rings, true_mm));
  });
  for (const double noise : {0.001, 0.003}) {  // 25 and 75 seconds of arc
    constexpr int people = 50;
    int within_two = 0;
    double bias_mm = 0.0;
    for (std::uint64_t seed = 0; seed < people; ++seed) {
      PaperRig rig;
      ScriptedObserver observer = person(seen, noise, seed);
      const auto found = run_two_choice(rig, *test, observer, {});
      REQUIRE(found);
      REQUIRE(*found);
      CHECK((*found)->inside);
      CHECK((*found)->uncertainty < 1.0);
      within_two += std::abs((*found)->value - true_mm) <= 2.0 * (*found)->uncertainty + 0.1 ? 1 : 0;
      bias_mm += ((*found)->value - true_mm) / people;
    }
    CAPTURE(noise);
    CHECK(within_two >= people * 90 / 100);
    CHECK(std::abs(bias_mm) < 0.25);
  }
}

TEST_CASE("where rings would say nothing none are shown") {
  Source narrow = viewer_room();
  narrow.project.slices.powers_d = {-0.3, 0.0, 0.3};
  CHECK(breathing_rings(narrow, Side::left).fault().code == "viewer.slices");
  Source nothing = viewer_room();
  nothing.project.surfaces[0].hidden = true;
  CHECK(breathing_rings(nothing, Side::left).fault().code == "viewer.surface");
  Source turned = viewer_room();
  turned.project.surfaces[0].placement.pose.rotation = {std::cos(0.5), 0.0, std::sin(0.5), 0.0};
  CHECK(breathing_rings(turned, Side::left).fault().code == "viewer.surface");
  Source small = viewer_room();
  small.project.surfaces[0].mesh.shape = PlaneMesh{{0.05, 0.05}};
  CHECK(breathing_rings(small, Side::left).fault().code == "viewer.surface");
  const TemporaryFolder folder;
  Source dark = viewer_room();
  dark.project.projectors[0].pose.position_m = {0.4, 0.0, 0.4};  // lights only a part of the rings
  dark.project.projectors[0].fx_px = dark.project.projectors[0].fy_px = 6000.0;
  const auto refused = ring_test(rings_of(dark), folder.path() / "dark.h5", no_progress, {});
  REQUIRE_FALSE(refused.ok());
  CHECK(refused.fault().code == "viewer.refused");
}
