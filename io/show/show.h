#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/compile/frame.h"
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

/// What this program signs its shows with: "focalstage 0.1.0".
std::string this_compiler();

/// What a show holds of one projector, apart from its images.
struct ShowProjector {
  double frames_per_second = 2000.0;
  int width_px = 0;
  int height_px = 0;
  int channels = 1;
  std::vector<ImageSpec> images;
  std::vector<Slot> slots;

  bool operator==(const ShowProjector&) const = default;
};

/// Everything in a show file but the images of its frames (design section 7).
struct ShowHeader {
  std::string compiler = this_compiler();
  std::string project_text;
  std::vector<AssetFile> assets;
  double frequency_hz = 60.0;
  double frames_per_second = 2000.0;
  double rate_hz = 60.0;
  int first_frame = 0;  ///< the project's frame that the show's frame 0 is
  int frames = 1;
  int width_px = 0;
  int height_px = 0;
  int channels = 1;
  std::vector<ImageSpec> images;
  Schedule schedule;
  std::vector<FramePoses> poses;
  std::vector<ShowCue> cues;
  std::vector<ShowProjector> others{};  ///< projectors 1 and up; the first one's are the fields above

  std::size_t projectors() const { return 1 + others.size(); }
  ShowProjector projector(std::size_t i) const;

  bool operator==(const ShowHeader&) const = default;
};

/// The group of a show file that holds projector number `i`: "/projector/0".
std::string projector_group(std::size_t i);

/// A half-open range of the project's frames.
struct FrameRange {
  int begin = 0;
  int end = 1;
};

/// The header of the frames `range` of a project: frame k shows time k/rate_hz. Cues outside the range are left out,
/// cues after the project's end fall on its last frame. `text`: the project's file as read.
ShowHeader make_show_header(const Project& project, std::string text, const LoadedAssets& assets,
                            const Schedule& schedule, const CompileSettings& settings, FrameRange range);

/// What the show holds of projector number `i`, compiled by `settings` and timed by `schedule`.
ShowProjector show_projector(const Project& project, std::size_t i, const CompileSettings& settings,
                             const Schedule& schedule);

/// What keeps a header from being a show's (sizes, ranges, order), as a Fault "show.invalid" that names the dataset in
/// `source`. The writer and the reader hold every header against it.
Status check_header(const ShowHeader& header, const std::string& source);

}  // namespace focalstage
