#include <future>

#include <doctest/doctest.h>
#include <spdlog/spdlog.h>

#include "devices/runtime/runtime.h"
#include "io/protocol/client.h"
#include "tests/devices/runtime/sample_project.h"

namespace focalstage {
namespace {

using std::chrono::milliseconds;

struct Stand {
  sample::Folder folder;
  std::string identified;
  std::promise<void> let_go;
  std::unique_ptr<Runtime> runtime;

  Stand() {
    spdlog::set_level(spdlog::level::off);
    RuntimeOptions options;
    options.listen = "127.0.0.1:0";
    options.store = folder.path() / "store";
    options.rig.rig = simulated_rig(sample::sim());
    options.rig.clock = RigClock::virtual_time;
    options.drivers["uno"] = {[] {
                                return std::vector<DeviceId>{{"uno", "Arduino Uno", "A1", "/dev/ttyACM0"},
                                                             {"uno", "Arduino Uno", "\xff", ""}};
                              },
                              [this](const std::string& serial) -> Status {
                                if (serial != "A1")
                                  return Fault{"device.missing", serial, "is not plugged in", "plug it in"};
                                identified = serial;
                                return {};
                              }};
    options.drivers["mcc1208"] = {
        []() -> Result<std::vector<DeviceId>> {
          return Fault{"device.permission", "usb", "may not be opened", "install the udev rule"};
        },
        [this](const std::string&) -> Status {
          let_go.get_future().wait();
          return {};
        }};
    auto started = Runtime::start(options);
    REQUIRE(started);
    runtime = std::make_unique<Runtime>(std::move(*started));
  }

  RigClient client() const { return std::move(*RigClient::connect(runtime->address(), milliseconds(3000))); }
};

TEST_CASE("devices are listed as each driver finds them, and who could not look says why") {
  const Stand stand;
  const auto listing = stand.client().devices();
  REQUIRE(listing);
  REQUIRE(listing->devices.size() == 2);
  CHECK(listing->devices[0] == DeviceReport{"uno", "Arduino Uno", "A1", "/dev/ttyACM0"});
  CHECK(listing->devices[1].serial != "\xff");  // of it, what can be said in UTF-8
  REQUIRE(listing->failures.size() == 1);
  CHECK(listing->failures[0].driver == "mcc1208");
  CHECK(listing->failures[0].fault.remedy == "install the udev rule");
}

TEST_CASE("one device is made to show itself; not one that is not there, and not while the rig plays") {
  const Stand stand;
  RigClient client = stand.client();
  REQUIRE(client.identify("uno", "A1"));
  CHECK(stand.identified == "A1");
  CHECK(client.identify("uno", "B2").fault().code == "device.missing");
  CHECK(client.identify("none", "A1").fault().code == "rig.request");
  const auto show = stand.folder.path() / "show.h5";
  REQUIRE(sample::write_show(show, sample::project()));
  REQUIRE(client.push(show, true, {}));
  REQUIRE(client.play());
  CHECK(client.identify("uno", "A1").fault().code == "rig.refused");
  CHECK(stand.client().identify("uno", "A1").fault().code == "rig.held");
}

TEST_CASE("a driver that takes its time keeps nobody but who asks drivers") {
  Stand stand;
  RigClient client = stand.client();
  auto slow = std::async(std::launch::async, [&] { return client.identify("mcc1208", ""); });
  RigClient other = stand.client();
  Result<DeviceListing> listing = other.devices();
  for (int n = 0; n < 300 && listing; ++n) {
    std::this_thread::sleep_for(milliseconds(5));
    listing = other.devices();
  }
  REQUIRE_FALSE(listing);
  CHECK(listing.fault().code == "rig.busy");
  CHECK(other.state().ok());
  CHECK(other.blackout().ok());
  stand.let_go.set_value();
  CHECK(slow.get().ok());
  CHECK(other.devices().ok());
}

TEST_CASE("a rig's state names its parts") {
  const Stand stand;
  const auto state = stand.client().state();
  REQUIRE(state);
  REQUIRE(state->parts.size() == 2);
  CHECK(state->parts[0] == PartReport{{"sim", "simulated rig", "", "in this program"}, "running", ""});
  CHECK(state->parts[1] == PartReport{{"sim", "simulated light sensor", "", "in this program"}, "ready", ""});
}

}  // namespace
}  // namespace focalstage
