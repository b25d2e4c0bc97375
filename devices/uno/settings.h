#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/base/sides.h"
#include "devices/serial/serial_ports.h"

namespace focalstage {

/// What a USB device says it is.
struct UsbKind {
  std::uint16_t vendor = 0;
  std::uint16_t product = 0;

  bool operator==(const UsbKind&) const = default;
};

/// A trigger board, and what may differ between two.
struct UnoSettings {
  std::string path;    ///< this port and no other; a link is followed anew at each opening; empty: looked for
  std::string serial;  ///< the board's USB serial, where there are several; empty: the one that is plugged in
  /// What is taken for an Uno when it is looked for: those of the Arduino core's boards.txt. Boards with another USB
  /// chip (1A86:7523 is a common one, but not of Unos alone) are added here.
  std::vector<UsbKind> kinds{{0x2341, 0x0043}, {0x2341, 0x0001}, {0x2A03, 0x0043}, {0x2341, 0x0243}, {0x2341, 0x006A}};
  PerEye<bool> opens_high{false, false};  ///< the level that opens a shutter; a liquid crystal is clear without voltage
  double boot_s = 2.5;                    ///< how long the board may take to answer, as opening may reset it
  SerialSearch search;
};

}  // namespace focalstage
