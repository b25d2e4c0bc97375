#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <stop_token>
#include <vector>

#include "core/retina/passes.h"
#include "core/retina/slice_light.h"
#include "core/retina/slice_map.h"

namespace focalstage {

/// The light of an exposure, averaged over what a look sees of it, and out of the projector's focus by rising radius;
/// the first is sharp.
struct ExposureLight {
  std::vector<SliceLight> levels;
  std::vector<float> radii_px{0.0f};

  bool any() const { return !levels.empty() && levels.front().any; }
};

/// Makes the lights of exposures and keeps them while their codes and the size at which they are seen stay: a hash of
/// the codes says so, because a frame's memory is used again for the next.
class ExposureLights {
 public:
  /// One per exposure; null where no pass of it reaches the grid. They hold until the next call. Unfinished after a
  /// stop request: then nothing is kept of what was not done.
  std::vector<const ExposureLight*> of(const RetinaInput& input, const std::vector<Pass>& passes,
                                       const std::vector<const SliceMap*>& maps, const std::stop_token& stop);

 private:
  /// What decides a light.
  struct Key {
    std::uint64_t codes_hash = 0;
    glm::dvec2 seen_px{1.0};
    float most_spread_px = 0.0f;
    int width_px = 0;
    int height_px = 0;
    int channels = 1;
    int bits = 8;
    double gamma = 1.0;
    std::vector<double> transfer{};

    bool operator==(const Key&) const = default;
  };
  struct Kept {
    Key key;
    ExposureLight light;
  };
  static Key key_of(const RetinaInput& input, std::size_t exposure, const SliceMap& map);

  std::vector<std::shared_ptr<const Kept>> kept_;
};

}  // namespace focalstage
