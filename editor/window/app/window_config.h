#pragma once

#include <filesystem>

#include "core/base/result.h"
#include "editor/tools/motion_steer.h"
#include "editor/window/app/layout.h"

namespace focalstage {

/// What the window remembers from one start to the next: CONFIG/window.json.
struct WindowConfig {
  Splits splits;
  glm::ivec2 size_px{1600, 900};
  SteerSettings steer;

  bool operator==(const WindowConfig&) const = default;
};

/// The defaults for whatever is missing, unreadable or out of range: a spoilt file never keeps the window shut.
WindowConfig load_window_config(const std::filesystem::path& folder);

Status save_window_config(const WindowConfig& config, const std::filesystem::path& folder);

}  // namespace focalstage
