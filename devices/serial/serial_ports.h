#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace focalstage {

/// A serial port as the system lists it; nothing is opened.
struct SerialPortId {
  std::string path;           ///< "/dev/ttyACM0"
  std::uint16_t vendor = 0;   ///< of USB; 0 with `product` 0: not known, as of a path that was only given
  std::uint16_t product = 0;  ///< of USB
  std::string serial;         ///< as USB tells it; empty: none
  std::string name;           ///< the product's own name; empty: none

  bool operator==(const SerialPortId&) const = default;
};

/// Where to look.
struct SerialSearch {
  std::string sysfs = "/sys";
  std::string devices = "/dev";
  std::vector<std::string> paths;  ///< beside what is plugged in: a port of another kind, an emulator's pty
};

/// All ttyACM and ttyUSB ports in the order of their numbers, then those of `search.paths` that exist and were not
/// among them.
std::vector<SerialPortId> serial_ports(const SerialSearch& search = {});

}  // namespace focalstage
