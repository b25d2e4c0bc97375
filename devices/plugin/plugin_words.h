#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "core/base/result.h"
#include "devices/plugin/focalstage_plugin.h"
#include "devices/roles/device.h"

namespace focalstage {

/// Where a plugin's call writes what it has to say.
using PluginWords = std::array<char, FOCALSTAGE_ERROR_BYTES>;

/// What a plugin's code means, as a Fault at `where`; `unable` is the code of what it cannot do.
Fault plugin_fault(std::int32_t code, const PluginWords& words, const std::string& where, const char* unable);

/// Which device a plugin says that it opened.
DeviceId plugin_id(const focalstage_identity& identity);

}  // namespace focalstage
