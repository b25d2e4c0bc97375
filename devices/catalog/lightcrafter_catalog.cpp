#include "devices/catalog/lightcrafter_catalog.h"

#include <utility>

#include "devices/catalog/settings_reader.h"
#include "devices/display_kms/kms_display.h"
#include "devices/lightcrafter/lightcrafter.h"

namespace focalstage {

namespace {

void take_plan(SettingsReader& reader, lightcrafter::PlanRules& plan) {
  using lightcrafter::Gap;
  reader.take("shown_bits", plan.shown_bits, 1, 8);
  reader.choose("gap", plan.gap, {{"spare_time", Gap::spare_time}, {"dark_entry", Gap::dark_entry}});
  reader.take("black_after", plan.black_after);
  int leds = plan.leds;
  reader.take("leds", leds, 1, 7);
  plan.leds = static_cast<std::uint8_t>(leds);
}

void take_unit(SettingsReader& reader, LightCrafterSettings& settings) {
  reader.take("brightness", settings.brightness, 0.0, 1.0);
  reader.take("most_brightness", settings.most_brightness, 0.0, 1.0);
  reader.take("poll_s", settings.poll_s, 0.02, 0.4);
  reader.take("warnings_are_faults", settings.warnings_are_faults);
  std::optional<int> source;
  reader.take("input_source", source, 0, 255);
  if (source) settings.input_source = static_cast<std::uint8_t>(*source);
  reader.take("check_signal", settings.check_signal);
  reader.take("light_after_vblank_s", settings.light_after_vblank_s, -0.1, 0.1);
}

void take_output(SettingsReader& reader, KmsSettings& output) {
  reader.take("display_maker", output.maker);
  reader.take("display_name", output.name);
  reader.take("display_serial", output.serial);
  reader.take("rate_hz", output.rate_hz, 20.0, 240.0);
  reader.take("rate_tolerance", output.rate_tolerance, 1e-6, 0.1);
}

}  // namespace

Result<std::shared_ptr<ProjectorDevice>> make_lightcrafter_projector(const DeviceConfig& device) {
  SettingsReader reader(device, "/devices/projector");
  LightCrafterSettings settings;
  settings.serial = device.serial;
  settings.address = device.address;
  KmsSettings output;
  take_unit(reader, settings);
  take_plan(reader, settings.plan);
  take_output(reader, output);
  if (Status read = reader.done(); !read) return read.fault();
  return std::shared_ptr<ProjectorDevice>(make_lightcrafter(settings, make_kms_display(output)));
}

}  // namespace focalstage
