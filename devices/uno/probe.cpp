#include "devices/uno/probe.h"

#include <algorithm>
#include <filesystem>
#include <system_error>

namespace focalstage {

namespace {

bool is_given(const UnoSettings& settings, const SerialPortId& port) {
  return std::ranges::find(settings.search.paths, port.path) != settings.search.paths.end();
}

bool is_uno(const UnoSettings& settings, const SerialPortId& port) {
  return is_given(settings, port) ||
         std::ranges::find(settings.kinds, UsbKind{port.vendor, port.product}) != settings.kinds.end();
}

DeviceId id_of(const SerialPortId& port) { return {"uno", "Arduino Uno", port.serial, port.path}; }

Result<DeviceId> at_path(const UnoSettings& settings) {
  std::error_code none;
  if (!std::filesystem::exists(settings.path, none)) {
    return Fault{"uno.absent", settings.path, "no trigger board is at this port", "plug it in, or correct its path"};
  }
  return DeviceId{"uno", "Arduino Uno", settings.serial, settings.path};
}

}  // namespace

std::vector<DeviceId> probe_uno(const UnoSettings& settings) {
  std::vector<DeviceId> found;
  for (const SerialPortId& port : serial_ports(settings.search)) {
    if (is_uno(settings, port)) found.push_back(id_of(port));
  }
  const bool listed = std::ranges::find(found, settings.path, &DeviceId::address) != found.end();
  if (settings.path.empty() || listed) return found;
  if (auto there = at_path(settings)) found.push_back(std::move(there).value());
  return found;
}

Result<DeviceId> find_uno(const UnoSettings& settings) {
  if (!settings.path.empty()) return at_path(settings);
  std::vector<DeviceId> found = probe_uno(settings);
  if (!settings.serial.empty()) {
    std::erase_if(found, [&](const DeviceId& id) { return id.serial != settings.serial; });
  }
  const std::string name = settings.serial.empty() ? "trigger board" : "trigger board " + settings.serial;
  if (found.empty()) return Fault{"uno.absent", name, "it is not plugged in", "plug the Arduino Uno in"};
  if (found.size() == 1) return found.front();
  std::string which;
  for (const DeviceId& id : found) which += (which.empty() ? "" : ", ") + id.address + " (" + id.serial + ")";
  return Fault{"uno.several", name, "there are several: " + which, "set the serial of the one that is meant"};
}

}  // namespace focalstage
