#pragma once

#include <memory>

#include "devices/plugin/settings.h"
#include "devices/roles/projector.h"

namespace focalstage {

/// A projector behind a plugin (focalstage_projector.h). Pictures are copied into the plugin's buffers in a thread of
/// its own. Beside what all projectors say, `open` has the faults "plugin.eye-safety" (nobody has vouched for its
/// light), those of load_projector_plugin, "plugin.absent", "plugin.settings" and "plugin.hung"; a plugin that falls
/// silent, hangs, or whose counts cannot be ("plugin.counts") is made dark and lost.
std::unique_ptr<ProjectorDevice> make_plugin_projector(const PluginProjectorSettings& settings);

}  // namespace focalstage
