#pragma once

#include <memory>
#include <string>

#include "core/base/result.h"
#include "devices/rig/leader.h"
#include "devices/roles/projector.h"
#include "devices/roles/trigger_board.h"
#include "io/rig_config/rig_config.h"

namespace focalstage {

/// The drivers of this program, by the names that a rig.json gives them. "rig.config" names the place in it: a driver
/// that is not known for that role, or a setting that is wrong. Nothing is opened yet.
Result<std::shared_ptr<ProjectorDevice>> make_projector(const DeviceConfig& device);
Result<std::shared_ptr<LensDrive>> make_lens_drive(const DeviceConfig& device);
Result<std::shared_ptr<TriggerBoard>> make_trigger_board(const DeviceConfig& device);

/// All three; "rig.config" where one is not named.
Result<RigDevices> make_rig_devices(const DevicesConfig& devices);

}  // namespace focalstage
