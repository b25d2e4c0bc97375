#include "devices/input/probe.h"

#include <hidapi/hidapi.h>

#include <algorithm>
#include <array>
#include <mutex>
#include <string>

namespace focalstage {

namespace {

struct Model {
  std::uint16_t vendor;
  std::uint16_t product;
  std::string_view name;
};

constexpr std::uint16_t logitech = 0x046d;
constexpr std::uint16_t connexion = 0x256f;

constexpr std::array<Model, 22> models{{{logitech, 0xc603, "SpaceMouse Plus XT"},
                                        {logitech, 0xc605, "CadMan"},
                                        {logitech, 0xc606, "SpaceMouse Classic"},
                                        {logitech, 0xc621, "SpaceBall 5000"},
                                        {logitech, 0xc623, "SpaceTraveler"},
                                        {logitech, 0xc625, "SpacePilot"},
                                        {logitech, 0xc626, "SpaceNavigator"},
                                        {logitech, 0xc627, "SpaceExplorer"},
                                        {logitech, 0xc628, "SpaceNavigator for Notebooks"},
                                        {logitech, 0xc629, "SpacePilot Pro"},
                                        {logitech, 0xc62b, "SpaceMouse Pro"},
                                        {connexion, 0xc62e, "SpaceMouse Wireless (cable)"},
                                        {connexion, 0xc62f, "SpaceMouse Wireless"},
                                        {connexion, 0xc631, "SpaceMouse Pro Wireless (cable)"},
                                        {connexion, 0xc632, "SpaceMouse Pro Wireless"},
                                        {connexion, 0xc633, "SpaceMouse Enterprise"},
                                        {connexion, 0xc635, "SpaceMouse Compact"},
                                        {connexion, 0xc636, "SpaceMouse Module"},
                                        {connexion, 0xc638, "SpaceMouse Pro Wireless (Bluetooth)"},
                                        {connexion, 0xc63a, "SpaceMouse Wireless (Bluetooth)"},
                                        {connexion, 0xc641, "SpaceMouse"},
                                        {connexion, 0xc652, "SpaceMouse (universal receiver)"}}};

constexpr unsigned short generic_desktop = 0x01;
constexpr unsigned short multi_axis_controller = 0x08;

std::string narrow(const wchar_t* text) {
  std::string bytes;
  for (; text != nullptr && *text != 0; ++text) bytes += *text < 128 ? static_cast<char>(*text) : '?';
  return bytes;
}

void take(unsigned short vendor, std::vector<DeviceId>& found) {
  hid_device_info* all = hid_enumerate(vendor, 0);
  for (const hid_device_info* info = all; info != nullptr; info = info->next) {
    const auto model = spacemouse_model(info->vendor_id, info->product_id);
    // Receivers have other interfaces too; where the system cannot say what this one is, it is taken.
    const bool told = info->usage_page != 0;
    const bool motion = info->usage_page == generic_desktop && info->usage == multi_axis_controller;
    if (!model || (told && !motion)) continue;
    DeviceId id{"input", std::string(*model), narrow(info->serial_number), info->path};
    const bool known = std::ranges::any_of(found, [&](const DeviceId& other) { return other.address == id.address; });
    if (!known) found.push_back(std::move(id));
  }
  hid_free_enumeration(all);
}

}  // namespace

std::optional<std::string_view> spacemouse_model(std::uint16_t vendor, std::uint16_t product) {
  const auto found =
      std::ranges::find_if(models, [&](const Model& m) { return m.vendor == vendor && m.product == product; });
  if (found == models.end()) return std::nullopt;
  return found->name;
}

std::vector<DeviceId> probe_spacemouse() {
  static std::mutex mutex;  // hidapi's enumeration is for one thread at a time
  const std::lock_guard lock(mutex);
  std::vector<DeviceId> found;
  take(logitech, found);
  take(connexion, found);
  return found;
}

}  // namespace focalstage
