#include "devices/serial/serial_ports.h"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <system_error>
#include <utility>

namespace focalstage {

namespace {

namespace fs = std::filesystem;

std::string first_line(const fs::path& file) {
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  return line;
}

std::uint16_t hex_of(const std::string& text) {
  std::uint16_t value = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value, 16);
  return error == std::errc{} && stop == text.data() + text.size() ? value : std::uint16_t{0};
}

/// The USB device that a tty belongs to stands one or two folders above the interface that it points to.
void tell_usb(const fs::path& tty, SerialPortId& port) {
  std::error_code none;
  fs::path folder = fs::canonical(tty / "device", none);
  for (int up = 0; up < 4 && !none && folder.has_relative_path(); ++up, folder = folder.parent_path()) {
    if (!fs::exists(folder / "idVendor", none)) continue;
    port.vendor = hex_of(first_line(folder / "idVendor"));
    port.product = hex_of(first_line(folder / "idProduct"));
    port.serial = first_line(folder / "serial");
    port.name = first_line(folder / "product");
    return;
  }
}

bool is_usb_tty(const std::string& name) { return name.starts_with("ttyACM") || name.starts_with("ttyUSB"); }

/// ttyACM2 before ttyACM10.
bool comes_before(const std::string& a, const std::string& b) {
  return std::pair(a.size(), a) < std::pair(b.size(), b);
}

}  // namespace

std::vector<SerialPortId> serial_ports(const SerialSearch& search) {
  std::error_code none;
  const fs::path ttys = fs::path(search.sysfs) / "class" / "tty";
  std::vector<std::string> names;
  for (fs::directory_iterator entry(ttys, none), end; !none && entry != end; entry.increment(none)) {
    std::string name = entry->path().filename().string();
    if (is_usb_tty(name)) names.push_back(std::move(name));
  }
  std::ranges::sort(names, comes_before);
  std::vector<SerialPortId> ports;
  for (const std::string& name : names) {
    SerialPortId port{(fs::path(search.devices) / name).string(), 0, 0, "", ""};
    tell_usb(ttys / name, port);
    ports.push_back(std::move(port));
  }
  for (const std::string& path : search.paths) {
    const bool known = std::ranges::find(ports, path, &SerialPortId::path) != ports.end();
    if (!known && fs::exists(path, none)) ports.push_back({path, 0, 0, "", ""});
  }
  return ports;
}

}  // namespace focalstage
