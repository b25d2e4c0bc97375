#include "devices/mcc1208/probe.h"

#include <utility>

namespace focalstage {

namespace {

constexpr UsbIds ids{mcc_vendor, mcc_usb1208fs_plus};
constexpr double probe_answer_s = 0.1;

// All that answer; where none does, why.
Result<std::vector<FoundMcc1208>> all_that_answer(double answer_s) {
  auto opened = open_usb(ids);
  if (!opened) return opened.fault();
  std::vector<FoundMcc1208> found;
  std::optional<Fault> why;
  for (auto& device : *opened) {
    auto unit = std::make_unique<MccUnit>(std::move(device), answer_s);
    const auto serial = unit->serial();
    if (!serial) {
      why = serial.fault();
      continue;
    }
    found.push_back({{"mcc1208", "USB-1208FS-Plus", *serial, unit->address()}, std::move(unit)});
  }
  if (found.empty()) return *why;
  return found;
}

}  // namespace

std::vector<DeviceId> probe_mcc1208() {
  std::vector<DeviceId> found;
  const auto all = all_that_answer(probe_answer_s);
  if (!all) return found;
  for (const auto& one : *all) found.push_back(one.id);
  return found;
}

Result<FoundMcc1208> find_mcc1208(const std::string& serial, double answer_s) {
  auto all = all_that_answer(answer_s);
  if (!all) return all.fault();
  if (serial.empty() && all->size() > 1) {
    return Fault{"usb.which", "mcc1208", std::to_string(all->size()) + " USB-1208FS-Plus are plugged in",
                 "name the serial number of the one to use"};
  }
  for (auto& one : *all) {
    if (!serial.empty() && one.id.serial != serial) continue;
    if (const Status claimed = one.unit->device().claim(0); !claimed) return claimed.fault();
    return std::move(one);
  }
  return Fault{"usb.missing", "mcc1208", "no USB-1208FS-Plus with the serial number " + serial + " is plugged in",
               "plug it in, or name one of those that are"};
}

}  // namespace focalstage
