#include <hidapi/hidapi.h>

#include <algorithm>
#include <array>
#include <mutex>
#include <set>
#include <utility>

#include "devices/lightcrafter/link.h"
#include "devices/lightcrafter/probe.h"

namespace focalstage {

namespace lightcrafter {

namespace {

/// The units that this program has open. The system lets a node be opened twice, and each would read what the other was
/// answered.
class OpenUnits {
 public:
  bool take(const std::string& path) {
    const std::lock_guard lock(mutex_);
    return paths_.insert(path).second;
  }
  void give_back(const std::string& path) {
    const std::lock_guard lock(mutex_);
    paths_.erase(path);
  }

 private:
  std::mutex mutex_;
  std::set<std::string> paths_;
};

OpenUnits& open_units() {
  static OpenUnits units;
  return units;
}

class HidReports final : public Reports {
 public:
  HidReports(hid_device* device, std::string path) : device_(device), path_(std::move(path)) {}
  ~HidReports() override {
    hid_close(device_);
    open_units().give_back(path_);
  }

  bool write(const Report& report) override {
    std::array<unsigned char, 65> bytes{};  // a report number that is none goes first
    std::ranges::copy(report, bytes.begin() + 1);
    return hid_write(device_, bytes.data(), bytes.size()) == static_cast<int>(bytes.size());
  }

  Got read(Report& report, int timeout_ms) override {
    const int got = hid_read_timeout(device_, report.data(), report.size(), timeout_ms);
    if (got < 0) return Got::gone;
    return got == static_cast<int>(report.size()) ? Got::report : Got::nothing;
  }

 private:
  hid_device* device_;
  std::string path_;
};

std::string narrow(const wchar_t* text) {
  std::string bytes;
  for (; text != nullptr && *text != 0; ++text) bytes += *text < 128 ? static_cast<char>(*text) : '?';
  return bytes;
}

std::vector<DeviceId> enumerate() {
  static std::mutex mutex;  // hidapi's enumeration is for one thread at a time
  const std::lock_guard lock(mutex);
  std::vector<DeviceId> found;
  hid_device_info* all = hid_enumerate(vendor_id, product_id);
  for (const hid_device_info* info = all; info != nullptr; info = info->next) {
    const DeviceId id{"lightcrafter", "LightCrafter 4500", narrow(info->serial_number), info->path};
    // A unit may have several interfaces; the first one is the controller's.
    const bool known = std::ranges::any_of(found, [&](const DeviceId& other) { return other.address == id.address; });
    if (info->interface_number <= 0 && !known) found.push_back(id);
  }
  hid_free_enumeration(all);
  return found;
}

}  // namespace

Result<std::unique_ptr<Reports>> open_hid(const std::string& serial, const std::string& address) {
  const std::vector<DeviceId> all = enumerate();
  const auto found = std::ranges::find_if(all, [&](const DeviceId& id) {
    return (serial.empty() || id.serial == serial) && (address.empty() || id.address == address);
  });
  if (found == all.end()) {
    return Fault{"projector.absent", "LightCrafter 4500",
                 all.empty() ? "none is plugged in" : "the one that is plugged in is another one",
                 "plug it in and switch it on, or change its serial in the settings"};
  }
  if (!open_units().take(found->address)) {
    return Fault{"projector.busy", found->address, "this rig has it open", "wait until the rig no longer uses it"};
  }
  hid_device* device = hid_open_path(found->address.c_str());
  if (device == nullptr) {
    open_units().give_back(found->address);
    return Fault{"projector.permission", found->address, "it cannot be opened",
                 "install the udev rule of devices/lightcrafter/README.md and plug it in again"};
  }
  return std::unique_ptr<Reports>(std::make_unique<HidReports>(device, found->address));
}

}  // namespace lightcrafter

std::vector<DeviceId> probe_lightcrafter() { return lightcrafter::enumerate(); }

}  // namespace focalstage
