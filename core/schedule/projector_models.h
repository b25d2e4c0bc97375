#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/scene/project.h"

namespace focalstage {

/// Who says when the next image appears.
enum class ClockMaster {
  rig,    ///< the projector follows a trigger per image
  video,  ///< the video signal's frames, which pack several images; the rig follows them
};

/// How fast a model shows gray images of some depth.
struct DepthRate {
  int bits = 8;
  double frames_per_second = 0.0;

  bool operator==(const DepthRate&) const = default;
};

/// What a projector model can do: data, not code.
struct ProjectorModelData {
  std::string name;
  int width_px = 0;
  int height_px = 0;
  ClockMaster clock = ClockMaster::rig;
  PixelLayout layout = PixelLayout::square;
  std::vector<DepthRate> rates;  ///< by rising depth

  bool operator==(const ProjectorModelData&) const = default;
};

/// The models that come with the program.
std::span<const ProjectorModelData> projector_models();

/// The model named so among `models`; null if none is.
const ProjectorModelData* find_model(std::span<const ProjectorModelData> models, std::string_view name);

/// How fast `model` shows images of `bits` and `color`: the rate of the lowest given depth that holds that many bits, a
/// third of it for rgb, which takes three exposures. Nothing where no given depth does.
std::optional<double> fastest_rate(const ProjectorModelData& model, int bits, ColorMode color);

}  // namespace focalstage
