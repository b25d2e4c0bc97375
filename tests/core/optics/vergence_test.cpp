#include "core/optics/vergence.h"

#include <doctest/doctest.h>

using namespace focalstage;

TEST_CASE("the power that is needed puts the image where it was asked for") {
  const double power_d = needed_power_d(0.5, 0.8);
  CHECK(power_d == doctest::Approx(2.0 - 1.25));
  CHECK(1.0 / image_vergence_d(0.5, power_d) == doctest::Approx(0.8));
  CHECK(image_vergence_d(0.5, 2.5) == doctest::Approx(-0.5));  // beyond infinity
}

TEST_CASE("a vergence at the pupil is that of the same point, further off by the lens' distance") {
  CHECK(vergence_at_pupil_d(2.0, 0.015) == doctest::Approx(1.0 / 0.515));
  CHECK(vergence_at_pupil_d(0.0, 0.015) == 0.0);
  CHECK(vergence_at_pupil_d(-1.0, 0.015) == doctest::Approx(1.0 / (-1.0 + 0.015)));
  CHECK(vergence_at_pupil_d(-1.0 / 0.015 - 1.0, 0.015) < -1e5);  // between lens and pupil
}

TEST_CASE("from pupil to lens and back is where it was") {
  for (const double at_lens_d : {-3.0, 0.0, 0.4, 2.0, 9.0}) {
    CHECK(vergence_at_lens_d(vergence_at_pupil_d(at_lens_d, 0.015), 0.015) == doctest::Approx(at_lens_d));
  }
  CHECK(vergence_at_lens_d(1.0 / 0.515, 0.015) == doctest::Approx(2.0));
  CHECK(vergence_at_lens_d(1.0 / 0.010, 0.015) > 1e5);  // between lens and pupil
}

TEST_CASE("a picture is wanted where its thing stands, at a distance of its own, or so much nearer") {
  CHECK(wanted_vergence_d({DepthMode::placed, 3.0}, 0.5) == 2.0);
  CHECK(wanted_vergence_d({DepthMode::fixed, 3.0}, 0.5) == 3.0);
  CHECK(wanted_vergence_d({DepthMode::offset, 3.0}, 0.5) == 5.0);
}
