#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "core/retina/blur.h"
#include "core/retina/retina.h"

namespace focalstage {

/// How a view turns vergences at the pupil into blur: a disc whose radius in the tangent plane is half the pupil times
/// the distance in dioptres, and what diffraction adds. With the eye's colours each of red, green and blue has a focus
/// of its own.
class Focus {
 public:
  Focus(const RetinaInput& input, const RetinaView& view);

  int channels() const { return channels_; }  ///< 1: all colours alike
  float least_px() const { return least_px_; }

  float radius_px(float vergence_d, int channel) const {
    const float disc_px = px_per_d_ * std::abs(vergence_d - at_pupil_d_[static_cast<std::size_t>(channel)]);
    const float radius_px = least_px_ > 0.0f ? std::sqrt(disc_px * disc_px + least_px_ * least_px_) : disc_px;
    return std::min(BlurLayers::most_radius_px, radius_px);
  }

  bool between(float low_d, float high_d, int channel) const {
    const float own_d = at_pupil_d_[static_cast<std::size_t>(channel)];
    return low_d <= own_d && own_d <= high_d;
  }

 private:
  int channels_ = 1;
  std::array<float, 3> at_pupil_d_{};
  float px_per_d_ = 0.0f;
  float least_px_ = 0.0f;  ///< by diffraction
};

/// The focus of red, green and blue about that of 550 nm, in dioptres: the refraction of the chromatic eye, 1.68524 -
/// 633.46 / (nm - 214.102) (Thibos, Ye, Zhang and Bradley, Applied Optics 31, 1992), at 610, 550 and 465 nm. Blue
/// focuses nearer to the lens of the eye, so that what is sharp in blue lies nearer: a higher vergence.
std::array<double, 3> chromatic_offsets_d();

/// The radius, in the tangent plane, of the disc that spreads light as much as diffraction at the pupil's edge does:
/// twice sigma of the Gaussian next to the Airy pattern, 0.42 wavelengths over the diameter, at 550 nm. None for a
/// pinhole, which stands for an ideal.
double diffraction_radius(double pupil_m);

}  // namespace focalstage
