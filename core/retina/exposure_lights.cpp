#include "core/retina/exposure_lights.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <span>
#include <utility>

namespace focalstage {
namespace {

/// Of the codes, eight at a time; each step is a bijection of the sum so far, so that any one changed byte shows.
std::uint64_t hash_of(std::span<const std::uint8_t> codes) {
  constexpr std::uint64_t odd = 0x9e3779b97f4a7c15ull;
  std::uint64_t sum[4] = {odd, odd + 1, odd + 2, odd + 3};
  std::size_t i = 0;
  for (; i + 32 <= codes.size(); i += 32) {
    for (std::size_t lane = 0; lane < 4; ++lane) {
      std::uint64_t word = 0;
      std::memcpy(&word, codes.data() + i + 8 * lane, 8);
      sum[lane] = (sum[lane] ^ word) * odd;
      sum[lane] ^= sum[lane] >> 32;
    }
  }
  std::uint64_t all = codes.size();
  for (; i < codes.size(); ++i) all = (all ^ codes[i]) * odd;
  for (const std::uint64_t lane : sum) {
    all = (all ^ lane) * odd;
    all ^= all >> 29;
  }
  return all;
}

/// In eighths of a pixel: what a step of the head changes is below what can be seen, and the light stays.
glm::dvec2 in_steps(const glm::dvec2& seen_px) {
  return {std::max(1.0, std::round(8.0 * seen_px.x)) / 8.0, std::max(1.0, std::round(8.0 * seen_px.y)) / 8.0};
}

/// Blur of the projector's in steps of a factor of two; between two of them light is mixed by the square of the radius.
ExposureLight light_of(SliceLight sharp, float most_px) {
  ExposureLight light;
  light.levels.push_back(std::move(sharp));
  for (float radius_px = 0.5f; light.any() && light.radii_px.back() < most_px; radius_px *= 2.0f) {
    light.levels.push_back(spread_light(light.levels.front(), radius_px));
    light.radii_px.push_back(radius_px);
  }
  return light;
}

}  // namespace

ExposureLights::Key ExposureLights::key_of(const RetinaInput& input, std::size_t exposure, const SliceMap& map) {
  return {hash_of(input.exposures[exposure].codes),
          in_steps(map.seen_px),
          map.most_spread_px,
          input.projector.width_px,
          input.projector.height_px,
          input.channels,
          input.bits,
          input.gamma,
          input.transfer};
}

std::vector<const ExposureLight*> ExposureLights::of(const RetinaInput& input, const std::vector<Pass>& passes,
                                                     const std::vector<const SliceMap*>& maps,
                                                     const std::stop_token& stop) {
  std::vector<std::shared_ptr<const Kept>> used;
  std::vector<const ExposureLight*> lights(input.exposures.size(), nullptr);
  const auto light_of_code = light_of_codes(input.bits, input.gamma, input.transfer);
  for (std::size_t i = 0; i < passes.size(); ++i) {
    const std::size_t exposure = passes[i].exposure;
    if (passes[i].is_ambient()) continue;
    if (!maps[i]->any || lights[exposure]) continue;
    const Key key = key_of(input, exposure, *maps[i]);
    const auto found = std::find_if(kept_.begin(), kept_.end(), [&](const auto& one) { return one->key == key; });
    if (found != kept_.end()) {
      used.push_back(*found);
    } else {
      SliceLight sharp = slice_light(input.exposures[exposure].codes, key.width_px, key.height_px, key.channels,
                                     key.seen_px, light_of_code, stop);
      if (stop.stop_requested()) return lights;
      used.push_back(std::make_shared<const Kept>(Kept{key, light_of(std::move(sharp), key.most_spread_px)}));
    }
    lights[exposure] = &used.back()->light;
  }
  kept_ = std::move(used);
  return lights;
}

}  // namespace focalstage
