#pragma once

namespace focalstage {

/// The circle made of additions, products and divisions alone. The C library's sine differs in the last bit between
/// processors (with and without fused products); what a project compiles to must not (design section 2).
struct SinCos {
  double sin = 0.0;
  double cos = 1.0;
};

inline constexpr double pi = 3.14159265358979323846;

/// Sine and cosine within 2 ulp of 1 for |angle_rad| up to 1e4.
SinCos sin_cos(double angle_rad);

/// The same for degrees, exact at multiples of 90.
SinCos sin_cos_deg(double angle_deg);

/// The angle in (-pi, pi] of the direction (`cosine`, `sine`), which need not be of unit length; 0 for the zero vector.
double angle_of(double sine, double cosine);

}  // namespace focalstage
