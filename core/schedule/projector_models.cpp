#include "core/schedule/projector_models.h"

#include <algorithm>
#include <array>

namespace focalstage {
namespace {

/// A rate is given for the shortest exposure, in microseconds, of that depth.
constexpr double shortest(double exposure_us) { return 1e6 / exposure_us; }

const std::array<ProjectorModelData, 2>& table() {
  static const std::array<ProjectorModelData, 2> models{
      ProjectorModelData{"dynaflash", 1024, 768, ClockMaster::rig, PixelLayout::square, {{1, 22000.0}, {8, 2840.0}}},
      // TI's shortest exposures per depth; from video it packs the images of a frame into 24 bit planes.
      ProjectorModelData{"lightcrafter4500",
                         912,
                         1140,
                         ClockMaster::video,
                         PixelLayout::diamond,
                         {{1, shortest(235)},
                          {2, shortest(700)},
                          {3, shortest(1570)},
                          {4, shortest(1700)},
                          {5, shortest(2000)},
                          {6, shortest(2500)},
                          {7, shortest(4500)},
                          {8, shortest(8333)}}},
  };
  return models;
}

}  // namespace

std::span<const ProjectorModelData> projector_models() { return table(); }

const ProjectorModelData* find_model(std::span<const ProjectorModelData> models, std::string_view name) {
  const auto found = std::find_if(models.begin(), models.end(), [&](const auto& model) { return model.name == name; });
  return found == models.end() ? nullptr : &*found;
}

std::optional<double> fastest_rate(const ProjectorModelData& model, int bits, ColorMode color) {
  const auto deep_enough = [&](const DepthRate& rate) { return rate.bits >= bits; };
  const auto found = std::find_if(model.rates.begin(), model.rates.end(), deep_enough);
  if (found == model.rates.end()) return std::nullopt;
  return color == ColorMode::rgb ? found->frames_per_second / 3.0 : found->frames_per_second;
}

}  // namespace focalstage
