#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/scene/project.h"

namespace focalstage {

/// Who says when the next image appears.
enum class ProjectorClock {
  triggered,  ///< the projector follows a trigger per image
  master,     ///< the projector's own video frames; the rig follows them
};

/// How fast a model shows gray images of some depth.
struct DepthRate {
  int bits = 8;
  double frames_per_second = 0.0;
  double least_exposure_ms = 0.0;  ///< 0: what the rate leaves an image

  bool operator==(const DepthRate&) const = default;
};

/// What a projector model can do: data, not code. io/models reads them from files.
struct ProjectorModelData {
  std::string name;
  int width_px = 0;
  int height_px = 0;
  ProjectorClock clock = ProjectorClock::triggered;
  PixelLayout layout = PixelLayout::square;
  std::vector<DepthRate> rates;  ///< by rising depth
  /// How many bit planes one video frame carries, where images are packed into video; an image takes one per bit.
  std::optional<int> planes_per_frame;

  bool operator==(const ProjectorModelData&) const = default;
};

/// The models somebody knows of, each name once.
using ProjectorModels = std::vector<ProjectorModelData>;

/// The model named so among `models`; null if none is.
const ProjectorModelData* find_model(std::span<const ProjectorModelData> models, std::string_view name);

/// How fast `model` shows images of `bits` and `color`: the rate of the lowest given depth that holds that many bits, a
/// third of it for rgb, which takes three exposures. Nothing where no given depth does.
std::optional<double> fastest_rate(const ProjectorModelData& model, int bits, ColorMode color);

/// The shortest exposure of such an image, in milliseconds; three times one colour's for rgb.
std::optional<double> least_exposure_ms(const ProjectorModelData& model, int bits, ColorMode color);

}  // namespace focalstage
