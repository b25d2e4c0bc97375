#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>

#include "editor/cli/command_list.h"
#include "editor/cli/output.h"
#include "editor/cli/rig_link.h"

namespace focalstage {
namespace {

struct Options {
  std::string identify;
  std::string rig;
  bool json = false;
};

Value value_of(const DeviceListing& listing) {
  Value::Array devices;
  for (const DeviceReport& device : listing.devices) devices.push_back(value_of(device));
  Value::Array failures;
  for (const DriverFailure& failure : listing.failures) {
    Value value;
    value.set("driver", failure.driver);
    value.set("fault", describe(failure.fault));
    failures.push_back(std::move(value));
  }
  Value value;
  value.set("devices", std::move(devices));
  value.set("failures", std::move(failures));
  return value;
}

std::string text_of(const DeviceListing& listing) {
  std::vector<std::vector<std::string>> rows;
  for (const DeviceReport& device : listing.devices) {
    rows.push_back({device.driver, device.model, device.serial, device.address});
  }
  std::string text = rows.empty() ? "no devices\n" : table_text({{"driver"}, {"model"}, {"serial"}, {"address"}}, rows);
  for (const DriverFailure& failure : listing.failures) {
    text += failure.driver + ": " + describe(failure.fault) + "\n";
  }
  return text;
}

ExitStatus identify(RigClient& rig, const std::string& device) {
  const std::size_t colon = device.find(':');
  const std::string driver = device.substr(0, colon);
  const std::string serial = colon == std::string::npos ? "" : device.substr(colon + 1);
  if (const Status shown = rig.identify(driver, serial); !shown) return report(shown.fault());
  std::printf("%s: it shows itself now\n", device.c_str());
  return ExitStatus::done;
}

ExitStatus run(const Options& options) {
  auto rig = connect_to_rig(options.rig);
  if (!rig) return report(rig.fault());
  if (!options.identify.empty()) return identify(*rig, options.identify);
  const auto listing = rig->devices();
  if (!listing) return report(listing.fault());
  if (options.json) {
    print_json(value_of(*listing));
  } else {
    std::fputs(text_of(*listing).c_str(), stdout);
  }
  return ExitStatus::done;
}

}  // namespace

Command::Run declare_devices(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  app.add_option("--identify", options->identify,
                 "make this one do something that can be seen; without :SERIAL the only one")
      ->type_name("DRIVER:SERIAL");
  add_rig_option(app, options->rig);
  app.add_flag("--json", options->json, "print the devices as one JSON object");
  return [options] { return run(*options); };
}

}  // namespace focalstage
