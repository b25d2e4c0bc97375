#pragma once

#include <memory>

#include "core/base/sides.h"
#include "devices/roles/light_sensor.h"
#include "devices/uno/settings.h"

namespace focalstage {

struct UnoLightSettings {
  UnoSettings board;
  PerEye<int> input{0, 1};  ///< the analogue inputs, A0 to A5
};

/// An Arduino Uno with the firmware of devices/firmware that gives out nothing and looks at two photodiodes: a board of
/// its own beside the trigger board, with the same sync edge at D8. No thread: calls talk with it, and wait 0.2 s at
/// most.
///
/// Faults of `open`: those of `make_uno`; "uno.firmware" where it knows no light. Later "serial.gone", "uno.silent".
std::unique_ptr<LightSensor> make_uno_light(const UnoLightSettings& settings);

}  // namespace focalstage
