#include "editor/viewer/thread_sights.h"

#include <doctest/doctest.h>

#include <cmath>
#include <utility>

#include "tests/editor/viewer/viewer_room.h"
#include "tests/support/temporary_folder.h"

using namespace focalstage;

namespace {

constexpr double thread_m = 0.25;

struct ReadySights {
  ThreadSights sights;
  TwoChoiceTest test;
  ShowReader show;
};

ReadySights ready(const Source& source, Side eye, const TemporaryFolder& folder) {
  auto sights = thread_sights(source, eye, thread_m);
  if (!sights) FAIL(describe(sights.fault()));
  auto test = thread_test(*sights, folder.path() / "lines.h5", no_progress, {});
  if (!test) FAIL(describe(test.fault()));
  auto show = ShowReader::open(folder.path() / "lines.h5");
  if (!show) FAIL(describe(show.fault()));
  return {*sights, *test, *std::move(show)};
}

std::map<std::size_t, double> seen_by(const ReadySights& ready, double eye_x_mm) {
  return all_seen(ready.test.levels.size(),
                  [&](std::size_t level) { return seen_thread_difference(ready.show, level, ready.sights, eye_x_mm); });
}

}  // namespace

TEST_CASE("the line lies behind the thread for the eye it was made for, whatever the project says") {
  const TemporaryFolder folder;
  for (const auto& [nominal_mm, eye] : {std::pair{63.0, Side::left}, std::pair{56.0, Side::right}}) {
    Source source = viewer_room(0.5);
    source.project.viewer.interpupillary_mm = nominal_mm;
    const ReadySights lines = ready(source, eye, folder);
    CHECK(lines.sights.surface_m == doctest::Approx(0.5).epsilon(1e-5));
    for (const double x_mm : {25.0, 33.0}) {
      const double true_mm = eye == Side::left ? -x_mm : x_mm;
      for (std::size_t level = 0; level < lines.test.levels.size(); level += 6) {
        const auto seen = seen_thread_difference(lines.show, level, lines.sights, true_mm);
        if (!seen) FAIL(describe(seen.fault()));
        // The eye turns about a point 10.5 mm behind z = 0 until its pupil, 10.5 mm before that point, lies on the
        // way to the thread. Similar triangles give the line made for an eye at l, and where both are seen.
        const double r = 0.0105, x = true_mm * 1e-3, l = lines.test.levels[level] * 1e-3;
        const double line_x = l * (1.0 - (0.5 + r) / (thread_m + r));
        const double way = std::hypot(x, thread_m + r);
        const double pupil_x = x * (1.0 - r / way), pupil_z = r - r * (thread_m + r) / way;
        const double expected = -pupil_x / (thread_m + pupil_z) - (line_x - pupil_x) / (0.5 + pupil_z);
        if (std::abs(l - x) > 1e-6) CHECK((expected > 0.0) == (l > x));
        CAPTURE(true_mm);
        CAPTURE(lines.test.levels[level]);
        CHECK(std::abs(*seen - expected) < 2e-4 + 0.002 * std::abs(expected));  // a sixth of a pixel is 0.2e-3
      }
    }
  }
}

TEST_CASE("lines lie where the surface is, also where it is not square to the gaze") {
  const TemporaryFolder folder;
  Source source = viewer_room(0.5);
  const double angle = 0.25;
  source.project.surfaces[0].placement.pose.rotation = {std::cos(angle / 2.0), 0.0, std::sin(angle / 2.0), 0.0};
  const ReadySights lines = ready(source, Side::right, folder);
  const std::vector<Keyframe>& keys = lines.sights.source.project.objects[1].placement.keys;
  REQUIRE(keys.size() == lines.test.levels.size());
  for (std::size_t k = 0; k < keys.size(); ++k) {
    // The way from (x, 0, r) through the thread meets the wall z = -0.5 - x tan(angle).
    const double x_m = lines.test.levels[k] * 1e-3, r = 0.0105, rise = x_m * std::tan(angle);
    const double t = (0.5 + r + rise) / (thread_m + r + rise);
    CHECK(keys[k].pose.position_m.x == doctest::Approx(x_m * (1.0 - t)).epsilon(1e-4));
    CHECK(keys[k].pose.position_m.z == doctest::Approx(r - (thread_m + r) * t).epsilon(1e-4));
  }
}

TEST_CASE("eyes are found apart as they are, also where the head stands aside") {
  const TemporaryFolder folder;
  PerEye<std::map<std::size_t, double>> seen;
  PerEye<TwoChoiceTest> tests;
  std::optional<ThreadSights> sights;
  for (const Side eye : both_sides) {
    const ReadySights lines = ready(viewer_room(0.5), eye, folder);
    seen[eye] = seen_by(lines, eye == Side::left ? -26.4 : 31.8);  // 58.2 apart, their middle 2.7 to the right
    tests[eye] = lines.test;
    sights = lines.sights;
  }
  for (const double noise : {0.0003, 0.001}) {  // one and three and a half minutes of arc
    constexpr int people = 30;
    int within_two = 0;
    double bias_mm = 0.0;
    for (std::uint64_t seed = 0; seed < people; ++seed) {
      PerEye<EqualityEstimate> pupils;
      for (const Side eye : both_sides) {
        PaperRig rig;
        ScriptedObserver observer = person(seen[eye], noise, 2 * seed + index_of(eye));
        const auto found = run_two_choice(rig, tests[eye], observer, {});
        REQUIRE(found);
        REQUIRE(*found);
        CHECK((*found)->inside);
        pupils[eye] = **found;
      }
      const InterpupillaryDistance found = interpupillary_distance(pupils, *sights, 0.0);
      within_two += std::abs(found.mm - 58.2) <= 2.0 * found.uncertainty_mm + 0.05 ? 1 : 0;
      CHECK(std::abs(found.middle_mm - 2.7) < 4.0 * found.uncertainty_mm);
      bias_mm += (found.mm - 58.2) / people;
    }
    CAPTURE(noise);
    CHECK(within_two >= people * 90 / 100);
    CHECK(std::abs(bias_mm) < 0.15);
  }
}

TEST_CASE("what the thread's distance is worth") {
  ThreadSights sights;
  sights.thread_m = 0.25;
  sights.surface_m = 0.5;
  EqualityEstimate left, right;
  left.value = -31.0;
  right.value = 32.0;
  left.uncertainty = 0.3;
  right.uncertainty = 0.4;
  const InterpupillaryDistance found = interpupillary_distance({left, right}, sights, 3.0);
  CHECK(found.mm == doctest::Approx(63.0));
  CHECK(found.middle_mm == doctest::Approx(0.5));
  CHECK(found.answers_mm == doctest::Approx(0.5));
  // A thread sqrt(3^2 + 1^2) mm farther from where the eyes turn: the same lines belong to eyes farther apart.
  const auto eyes_mm = [](double thread_mm) { return 63.0 * 250.0 / 260.5 * thread_mm / (510.5 - thread_mm); };
  CHECK(eyes_mm(260.5) == doctest::Approx(63.0));
  CHECK(found.thread_mm == doctest::Approx(eyes_mm(260.5 + std::sqrt(10.0)) - 63.0).epsilon(0.03));
  CHECK(found.uncertainty_mm == doctest::Approx(std::hypot(found.answers_mm, found.thread_mm)));
}

TEST_CASE("without a thread before a surface nothing is shown") {
  CHECK(thread_sights(viewer_room(0.5), Side::left, 0.48).fault().code == "viewer.thread");
  CHECK(thread_sights(viewer_room(0.5), Side::left, 0.7).fault().code == "viewer.thread");
  Source nothing = viewer_room();
  nothing.project.surfaces[0].hidden = true;
  CHECK(thread_sights(nothing, Side::left, 0.25).fault().code == "viewer.surface");
  const TemporaryFolder folder;
  Source narrow = viewer_room();
  narrow.project.projectors[0].fx_px = narrow.project.projectors[0].fy_px = 9000.0;
  const auto sights = thread_sights(narrow, Side::left, 0.25);
  REQUIRE(sights);
  CHECK(thread_test(*sights, folder.path() / "narrow.h5", no_progress, {}).fault().code == "viewer.refused");
}
