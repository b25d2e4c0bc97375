#pragma once

#include <cstdint>

#include "devices/mcc1208/settings.h"
#include "devices/mcc1208/unit.h"

namespace focalstage {

/// The amplifier's enable line as an output, not enabled. Nothing where there is none.
Status prepare_enable(MccUnit& unit, const Mcc1208Settings& settings);
Status set_enable(MccUnit& unit, const Mcc1208Settings& settings, bool enabled);

/// The scan being stopped: channel 0 from where it stands to the zero-current code in the settings' ramp, channel 1
/// low, then the amplifier's enable line away. A request that fails does not keep the next from being tried, except
/// that an unplugged device is asked nothing more. Where the amplifier is not told, no output is touched.
Status bring_to_zero(MccUnit& unit, const Mcc1208Settings& settings);

}  // namespace focalstage
