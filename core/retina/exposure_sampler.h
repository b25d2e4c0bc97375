#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "core/retina/exposure_lights.h"
#include "core/retina/slice_light.h"
#include "core/retina/slice_map.h"

namespace focalstage {

/// Reads an exposure where the projector is as sharp as a spot says.
template <int channels>
class ExposureSampler {
 public:
  explicit ExposureSampler(const ExposureLight& light) : radii_px_(light.radii_px) {
    for (const SliceLight& level : light.levels) levels_.emplace_back(level);
  }

  std::array<float, channels> at(const SliceSpot& spot) const {
    if (levels_.size() == 1 || spot.spread_px <= 0.0f) return levels_.front().at(spot.x_px, spot.y_px);
    std::size_t upper = 1;
    while (upper + 1 < levels_.size() && radii_px_[upper] < spot.spread_px) ++upper;
    const float low = radii_px_[upper - 1], high = radii_px_[upper];
    const float share = std::min(1.0f, (spot.spread_px * spot.spread_px - low * low) / (high * high - low * low));
    std::array<float, channels> light = levels_[upper - 1].at(spot.x_px, spot.y_px);
    const std::array<float, channels> other = levels_[upper].at(spot.x_px, spot.y_px);
    for (std::size_t c = 0; c < channels; ++c) light[c] += share * (other[c] - light[c]);
    return light;
  }

 private:
  std::vector<LightSampler<channels>> levels_;
  const std::vector<float>& radii_px_;
};

}  // namespace focalstage
