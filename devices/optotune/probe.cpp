#include "devices/optotune/probe.h"

namespace focalstage {

namespace {

constexpr std::uint16_t vendor = 0x03eb;
constexpr std::uint16_t product = 0x2018;

}  // namespace

std::vector<DeviceId> probe_optotune(const SerialSearch& search) {
  std::vector<DeviceId> found;
  for (const SerialPortId& port : serial_ports(search)) {
    const bool told = port.vendor == 0 && port.product == 0;
    if (!told && (port.vendor != vendor || port.product != product)) continue;
    found.push_back({"optotune", "Lens Driver 4", port.serial, port.path});
  }
  return found;
}

Result<DeviceId> find_optotune(const std::string& serial, const SerialSearch& search) {
  const auto found = probe_optotune(search);
  if (found.empty()) {
    return Fault{"optotune.missing", "optotune", "no lens driver is plugged in", "see its cable and power"};
  }
  if (serial.empty() && found.size() > 1) {
    return Fault{"optotune.which", "optotune", std::to_string(found.size()) + " lens drivers are plugged in",
                 "name the serial number of the one to use"};
  }
  for (const DeviceId& one : found) {
    if (serial.empty() || one.serial == serial) return one;
  }
  return Fault{"optotune.missing", "optotune", "no lens driver with the serial number " + serial + " is plugged in",
               "plug it in, or name one of those that are"};
}

}  // namespace focalstage
