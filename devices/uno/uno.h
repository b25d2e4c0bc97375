#pragma once

#include <memory>

#include "devices/roles/trigger_board.h"
#include "devices/uno/settings.h"

namespace focalstage {

/// An Arduino Uno with the firmware of devices/firmware. It is asked how it stands every 100 ms, armed or not, which is
/// also what tells it that the host lives.
///
/// Faults of `open`: "uno.absent", "uno.several", "uno.silent", "uno.protocol", those of devices/serial. Of a board
/// that is lost: "serial.gone", "uno.silent", "uno.reset". Of one that went dark by itself: "board.sync_lost",
/// "board.host_silent", "board.late".
std::unique_ptr<TriggerBoard> make_uno(const UnoSettings& settings);

}  // namespace focalstage
