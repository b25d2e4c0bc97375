#include "core/mesh/circle.h"

#include <cmath>

namespace focalstage {
namespace {

// Taylor's series for |x| <= pi/4: the first term left out is below 1e-18.
SinCos series(double x) {
  const double x2 = x * x;
  double sine = 1.0;
  double cosine = 1.0;
  for (int n = 9; n >= 1; --n) {
    sine = 1.0 - x2 / (2.0 * n * (2.0 * n + 1.0)) * sine;
    cosine = 1.0 - x2 / ((2.0 * n - 1.0) * 2.0 * n) * cosine;
  }
  return {x * sine, cosine};
}

SinCos turned(const SinCos& a, double quarters) {
  const int quarter = static_cast<int>(quarters - 4.0 * std::floor(quarters / 4.0));
  switch (quarter) {
    case 1:
      return {a.cos, -a.sin};
    case 2:
      return {-a.sin, -a.cos};
    case 3:
      return {-a.cos, a.sin};
    default:
      return a;
  }
}

}  // namespace

SinCos sin_cos(double angle_rad) {
  // pi/2 in two parts, the first with its low 20 bits zero, so that quarters * the first is exact.
  constexpr double half_pi_high = 1.57079632673412561417e+00;
  constexpr double half_pi_low = 6.07710050650619224932e-11;
  const double quarters = std::floor(angle_rad / (pi / 2) + 0.5);
  return turned(series((angle_rad - quarters * half_pi_high) - quarters * half_pi_low), quarters);
}

SinCos sin_cos_deg(double angle_deg) {
  const double quarters = std::floor(angle_deg / 90.0 + 0.5);
  return turned(series((angle_deg - quarters * 90.0) * (pi / 180.0)), quarters);
}

double angle_of(double sine, double cosine) {
  const double length = std::sqrt(sine * sine + cosine * cosine);
  if (!(length > 0.0)) return 0.0;
  const double s = sine / length;
  const double c = cosine / length;
  // The sine of what is left is a cubically converging correction: sin(a - x) = sin a cos x - cos a sin x.
  double angle = c >= 0.0 ? s : (s >= 0.0 ? pi - s : -pi - s);
  for (int step = 0; step < 6; ++step) {
    const SinCos at = sin_cos(angle);
    angle += s * at.cos - c * at.sin;
  }
  return angle;
}

}  // namespace focalstage
