#include "core/retina/lens_rim.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace focalstage {
namespace {

constexpr double most_negative_d = -10.0;  ///< no picture's vergence lies below: it would widen the disc further

/// The part of a disc of radius `r`, its centre `apart` from that of one of radius `big`, that lies in the other: two
/// circular segments.
double overlap_share(double r, double big, double apart) {
  if (apart + r <= big) return 1.0;
  if (apart >= big + r) return 0.0;
  if (apart + big <= r) return big * big / (r * r);
  const double own = (apart * apart + r * r - big * big) / (2.0 * apart);  // from either centre to the common chord
  const double other = apart - own;
  const auto segment = [](double radius, double to_chord) {
    const double cosine = std::clamp(to_chord / radius, -1.0, 1.0);
    return radius * radius * std::acos(cosine) -
           to_chord * std::sqrt(std::max(0.0, radius * radius - to_chord * to_chord));
  };
  return (segment(r, own) + segment(big, other)) / (std::numbers::pi * r * r);
}

}  // namespace

LensRim::LensRim(const RetinaInput& input, const RetinaView& view)
    : lens_to_pupil_m_(input.lens_to_pupil_m),
      squared_m_(input.lens_to_pupil_m * input.lens_to_pupil_m),
      lens_radius_m_(input.lens_aperture_m / 2.0),
      pupil_radius_m_(view.pupil_m / 2.0) {
  const double clear_m = lens_radius_m_ - pupil_radius_m_ * (1.0 - most_negative_d * lens_to_pupil_m_);
  whole_squared_m2_ = clear_m > 0.0 ? clear_m * clear_m : -1.0;
}

float LensRim::rim_share(double off_axis_squared_m2, double vergence_d) const {
  const double off_axis_m = std::sqrt(off_axis_squared_m2);
  const double radius_m = pupil_radius_m_ * std::abs(1.0 - std::max(vergence_d, most_negative_d) * lens_to_pupil_m_);
  if (!(radius_m > 0.0)) return off_axis_m <= lens_radius_m_ ? 1.0f : 0.0f;
  return static_cast<float>(overlap_share(radius_m, lens_radius_m_, off_axis_m));
}

}  // namespace focalstage
