#pragma once

#include <filesystem>

#include "core/base/result.h"
#include "devices/plugin/focalstage_lens_drive.h"
#include "devices/plugin/focalstage_projector.h"

namespace focalstage {

/// Opens a plugin, checks that it was built for this version and has every call, and hands out its table. What was
/// opened stays loaded until the process ends: a thread of a vendor's library may outlive any device.
///
/// Faults: "plugin.path" (not absolute), "plugin.library" (cannot be loaded, with the loader's words), "plugin.symbol"
/// (exports no such plugin), "plugin.abi" (another version), "plugin.size" (a table that is too small, or that states
/// another version than was asked for), "plugin.calls" (a call is missing).
Result<const focalstage_projector*> load_projector_plugin(const std::filesystem::path& library);
Result<const focalstage_lens_drive*> load_lens_drive_plugin(const std::filesystem::path& library);

}  // namespace focalstage
