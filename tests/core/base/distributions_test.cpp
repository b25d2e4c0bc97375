#include "core/base/distributions.h"

#include <cmath>
#include <initializer_list>
#include <numbers>

#include <doctest/doctest.h>

using namespace focalstage;
using doctest::Approx;

TEST_CASE("F with 2 degrees above has a closed form: (1 + 2f/d)^(-d/2)") {
  for (const double d : {1.0, 4.0, 54.0, 90.0}) {
    for (const double f : {0.0, 0.1, 1.0, 4.107, 92.0}) {
      CHECK(f_upper_tail(f, 2.0, d) == Approx(std::pow(1.0 + 2.0 * f / d, -d / 2.0)).epsilon(1e-10));
    }
  }
}

TEST_CASE("t of 1 and of 2 degrees has closed forms, and F(1, d) is t squared") {
  for (const double t : {0.0, 0.3, -1.7, 12.0}) {
    CHECK(t_two_sided(t, 1.0) == Approx(1.0 - 2.0 / std::numbers::pi * std::atan(std::abs(t))).epsilon(1e-10));
    CHECK(t_two_sided(t, 2.0) == Approx(1.0 - std::abs(t) / std::sqrt(2.0 + t * t)).epsilon(1e-10));
    CHECK(f_upper_tail(t * t, 1.0, 96.0) == Approx(t_two_sided(t, 96.0)).epsilon(1e-10));
  }
}

TEST_CASE("the paper's own F values have the p values it prints") {
  CHECK(f_upper_tail(0.218, 1, 96) == Approx(0.64).epsilon(0.005));
  CHECK(f_upper_tail(19.552, 1, 97) < 0.01);
  CHECK(f_upper_tail(18.234, 1, 90) < 0.01);
  CHECK(f_upper_tail(0.861, 4, 90) == Approx(0.49).epsilon(0.005));
  CHECK(f_upper_tail(0.088, 4, 90) == Approx(0.99).epsilon(0.005));
}

TEST_CASE("quantiles of t, from printed tables") {
  CHECK(t_quantile(0.975, 9) == Approx(2.262157).epsilon(1e-6));
  CHECK(t_quantile(0.975, 1) == Approx(12.706205).epsilon(1e-6));
  CHECK(t_quantile(0.5, 9) == Approx(0.0));
}

TEST_CASE("outside their domain the tails are no number, and nothing is thrown") {
  CHECK(std::isnan(f_upper_tail(1.0, 0.0, 5.0)));
  CHECK(std::isnan(f_upper_tail(-1.0, 1.0, 5.0)));
  CHECK(std::isnan(t_two_sided(1.0, -1.0)));
}
