#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <stop_token>
#include <vector>

#include "core/base/result.h"
#include "editor/preview/preview_values.h"

namespace focalstage {

/// What a client should see: pictures of the eye's view at full size.
struct ViewExport {
  std::shared_ptr<const Project> project;
  std::shared_ptr<const Stage> stage;
  EyeWish eye;  ///< focus, pupil, size, field of view
  std::filesystem::path folder;
};

/// Left eye, right eye, both side by side and red-cyan as PNG: stereo-left.png and so on. Returns what was written.
Result<std::vector<std::filesystem::path>> export_stereo(const ViewExport& wanted, std::stop_token stop);

/// A pull of focus from `from_d` to `to_d` and back in `frames` pictures focal-pull-0000.png ..., and, where an encoder
/// (ffmpeg) is installed, focal-pull.mp4. `progress`: 0..1.
Result<std::vector<std::filesystem::path>> export_focal_pull(const ViewExport& wanted, double from_d, double to_d,
                                                             int frames, const std::function<void(double)>& progress,
                                                             std::stop_token stop);

}  // namespace focalstage
