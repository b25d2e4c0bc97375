#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/optics/image_plan.h"
#include "core/scene/project.h"
#include "core/schedule/schedule.h"
#include "core/stage/stage.h"
#include "io/assets/assets.h"

namespace focalstage {

/// Position and quaternion x y z w.
using PoseRow = std::array<double, 7>;

PoseRow pose_row(const Rigid& world_from_thing);

/// Where everything stands in one frame; surfaces and objects in the project's order, hidden ones included.
struct FramePoses {
  PoseRow viewer{};
  std::vector<PoseRow> surfaces;
  std::vector<PoseRow> objects;

  bool operator==(const FramePoses&) const = default;
};

struct ShowCue {
  std::string name;
  std::int32_t frame = 0;

  bool operator==(const ShowCue&) const = default;
};

/// Everything in a show file but the images of its frames (design section 7).
struct ShowHeader {
  std::string project_text;
  std::vector<AssetFile> assets;
  double frequency_hz = 60.0;
  double frames_per_second = 2000.0;
  double rate_hz = 60.0;
  int frames = 1;
  int width_px = 0;
  int height_px = 0;
  int channels = 1;
  std::vector<ImageSpec> images;
  Schedule schedule;
  std::vector<FramePoses> poses;
  std::vector<ShowCue> cues;
};

}  // namespace focalstage
