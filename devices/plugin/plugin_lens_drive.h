#pragma once

#include <memory>

#include "devices/plugin/settings.h"
#include "devices/roles/lens_drive.h"

namespace focalstage {

/// A waveform generator behind a plugin (focalstage_lens_drive.h). Currents beyond the limit are cut before the plugin
/// sees them. Beside what all lens drives say, `open` has the faults of load_lens_drive_plugin, "plugin.absent",
/// "plugin.settings" and "plugin.hung"; a gap ("drive.underrun"), silence, or counts that cannot be take the current
/// away.
std::unique_ptr<LensDrive> make_plugin_lens_drive(const PluginDriveSettings& settings);

}  // namespace focalstage
