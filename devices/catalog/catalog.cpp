#include "devices/catalog/catalog.h"

#include <utility>

#include "devices/catalog/lightcrafter_catalog.h"
#include "devices/catalog/settings_reader.h"
#include "devices/mcc1208/mcc1208.h"
#include "devices/plugin/plugin_lens_drive.h"
#include "devices/plugin/plugin_projector.h"
#include "devices/uno/uno.h"

namespace focalstage {

namespace {

constexpr const char* projector_place = "/devices/projector";
constexpr const char* lens_place = "/devices/lens_drive";
constexpr const char* board_place = "/devices/trigger_board";

Fault unknown_driver(const char* place, const std::string& driver, const std::string& known) {
  return {"rig.config", std::string(place) + "/driver", "no driver \"" + driver + "\" does this", "choose " + known};
}

Fault missing(const char* place) {
  return {"rig.config", place, "a rig made of devices needs one", "name its driver and settings"};
}

/// What all plugins are told; the rest of the settings is the plugin's own.
Status take_plugin(SettingsReader& reader, const DeviceConfig& device, PluginSettings& plugin) {
  std::string library;
  reader.take("library", library);
  reader.take("silent_s", plugin.silent_s, 0.05, 10.0);
  plugin.library = library;
  reader.rest([&](const std::string& key, const std::string& text) { plugin.options[key] = text; });
  if (!device.serial.empty()) plugin.options["serial"] = device.serial;
  if (!device.address.empty()) plugin.options["address"] = device.address;
  return reader.done();
}

Result<std::shared_ptr<ProjectorDevice>> plugin_projector(const DeviceConfig& device) {
  SettingsReader reader(device, projector_place);
  PluginProjectorSettings settings;
  reader.take("eye_safe", settings.eye_safe);
  if (Status read = take_plugin(reader, device, settings.plugin); !read) return read.fault();
  return std::shared_ptr<ProjectorDevice>(make_plugin_projector(settings));
}

Result<std::shared_ptr<LensDrive>> plugin_lens_drive(const DeviceConfig& device) {
  SettingsReader reader(device, lens_place);
  PluginDriveSettings settings;
  reader.take("most_a", settings.most_a, 0.0, 0.29);
  if (Status read = take_plugin(reader, device, settings.plugin); !read) return read.fault();
  return std::shared_ptr<LensDrive>(make_plugin_lens_drive(settings));
}

Result<std::shared_ptr<LensDrive>> mcc1208(const DeviceConfig& device) {
  SettingsReader reader(device, lens_place);
  Mcc1208Settings settings;
  settings.serial = device.serial;
  reader.take("amperes_per_volt", settings.amperes_per_volt, -10.0, 10.0);
  reader.take("zero_code", settings.zero_code, 0, 4095);
  reader.take("most_a", settings.most_a, 0.0, mcc1208_hard_limit_a);
  reader.take("enable_bit", settings.enable_bit, 0, 15);
  reader.take("enable_high", settings.enable_high);
  reader.take("ramp_s", settings.ramp_s, 0.0, 0.06);
  reader.take("samples", settings.samples, 2, 4000);
  reader.take("most_off_ppm", settings.most_off_ppm, 0.0, 1000.0);
  reader.take("most_scans_per_s", settings.most_scans_per_s, 100.0, 50e3);
  reader.take("sync_pulse_s", settings.sync_pulse_s, 1e-4, 5e-3);
  reader.take("queued_periods", settings.queued_periods, 3, 32);
  if (Status read = reader.done(); !read) return read.fault();
  return std::shared_ptr<LensDrive>(make_mcc1208(settings));
}

Result<std::shared_ptr<TriggerBoard>> uno(const DeviceConfig& device) {
  SettingsReader reader(device, board_place);
  UnoSettings settings;
  settings.path = device.address;
  settings.serial = device.serial;
  reader.take("left_opens_high", settings.opens_high.left);
  reader.take("right_opens_high", settings.opens_high.right);
  reader.take("boot_s", settings.boot_s, 0.0, 10.0);
  if (Status read = reader.done(); !read) return read.fault();
  return std::shared_ptr<TriggerBoard>(make_uno(settings));
}

}  // namespace

Result<std::shared_ptr<ProjectorDevice>> make_projector(const DeviceConfig& device) {
  if (device.driver == "lightcrafter") return make_lightcrafter_projector(device);
  if (device.driver == "plugin") return plugin_projector(device);
  return unknown_driver(projector_place, device.driver, "lightcrafter or plugin");
}

Result<std::shared_ptr<LensDrive>> make_lens_drive(const DeviceConfig& device) {
  if (device.driver == "mcc1208") return mcc1208(device);
  if (device.driver == "plugin") return plugin_lens_drive(device);
  if (device.driver == "optotune") {
    return Fault{"rig.config", std::string(lens_place) + "/driver",
                 "nothing keeps an Optotune Lens Driver in step with a projector",
                 "let it follow a waveform generator at its analogue input, and name that: mcc1208 or plugin"};
  }
  return unknown_driver(lens_place, device.driver, "mcc1208 or plugin");
}

Result<std::shared_ptr<TriggerBoard>> make_trigger_board(const DeviceConfig& device) {
  if (device.driver == "uno") return uno(device);
  return unknown_driver(board_place, device.driver, "uno");
}

Result<RigDevices> make_rig_devices(const DevicesConfig& devices) {
  if (!devices.projector) return missing(projector_place);
  if (!devices.lens_drive) return missing(lens_place);
  if (!devices.trigger_board) return missing(board_place);
  auto projector = make_projector(*devices.projector);
  if (!projector) return projector.fault();
  auto lens = make_lens_drive(*devices.lens_drive);
  if (!lens) return lens.fault();
  auto board = make_trigger_board(*devices.trigger_board);
  if (!board) return board.fault();
  return RigDevices{std::move(*projector), std::move(*lens), std::move(*board)};
}

}  // namespace focalstage
