#include <chrono>
#include <functional>
#include <thread>

#include <doctest/doctest.h>
#include <lo/lo.h>
#include <spdlog/spdlog.h>

#include "devices/runtime/configured_rig.h"
#include "devices/service/service.h"
#include "io/protocol/client.h"
#include "tests/devices/runtime/sample_project.h"

namespace focalstage {
namespace {

using std::chrono::milliseconds;

bool eventually(const std::function<bool()>& holds) {
  for (int n = 0; n < 300; ++n) {
    if (holds()) return true;
    std::this_thread::sleep_for(milliseconds(10));
  }
  return false;
}

/// A service with a show of four frames and cues at 1 and 3, and a desk that speaks to it through liblo.
struct Stand {
  sample::Folder folder;
  std::unique_ptr<Service> service;
  lo_address desk = nullptr;

  explicit Stand(bool despite_lease = false) {
    spdlog::set_level(spdlog::level::off);
    RigConfig config;
    config.listen = "127.0.0.1:0";
    config.store = folder.path() / "store";
    config.osc = OscConfig{"127.0.0.1:0", "/focalstage", {}, despite_lease};
    auto options = runtime_options(config);
    REQUIRE(options);
    options->rig.rig = simulated_rig(sample::sim());
    options->rig.clock = RigClock::virtual_time;
    auto started = Service::start(config, *options);
    REQUIRE(started);
    service = std::move(*started);
    Project project = sample::project();
    project.frames.count = 4;
    project.cues = {{"first", 0.017, {}}, {"bow", 0.05, {}}};
    const auto show = folder.path() / "show.h5";
    REQUIRE(sample::write_show(show, project));
    RigClient pusher = client();
    REQUIRE(pusher.push(show, true, {}));
    const std::string port = std::to_string(host_port(service->osc_address())->port);
    desk = lo_address_new("127.0.0.1", port.c_str());
  }
  ~Stand() { lo_address_free(desk); }

  RigClient client() const {
    auto connected = RigClient::connect(service->runtime().address(), milliseconds(3000));
    REQUIRE(connected);
    return std::move(*connected);
  }
  RigState state() const { return service->runtime().figures().state; }
  bool becomes(const std::string& name) const {
    return eventually([&] { return state().state == name; });
  }
  bool shows(int frame) const {
    return eventually([&] { return state().frame == frame; });
  }
  std::uint64_t refusals(const std::string& code) const {
    const auto faults = service->runtime().figures().faults;
    return faults.contains(code) ? faults.at(code) : 0;
  }
};

TEST_CASE("a desk drives the show by OSC") {
  const Stand stand;
  lo_send(stand.desk, "/focalstage/next", "");
  CHECK(stand.shows(1));
  lo_send(stand.desk, "/focalstage/next", "f", 1.0);
  CHECK(stand.shows(3));
  lo_send(stand.desk, "/focalstage/back", "i", 1);
  CHECK(stand.shows(1));
  lo_send(stand.desk, "/focalstage/cue", "s", "bow");
  CHECK(stand.shows(3));
  lo_send(stand.desk, "/focalstage/hold", "");
  CHECK(stand.becomes("holding"));
  lo_send(stand.desk, "/focalstage/play", "");
  CHECK(stand.becomes("playing"));
  CHECK(eventually([&] { return stand.state().sweeps > 20; }));
  lo_send(stand.desk, "/focalstage/blackout", "");
  CHECK(stand.becomes("dark"));
  lo_send(stand.desk, "/focalstage/play", "");  // dark it stays
  CHECK(eventually([&] { return stand.refusals("rig.refused") == 1; }));
  CHECK(stand.state().state == "dark");
  lo_send(stand.desk, "/focalstage/go", "");
  CHECK(stand.becomes("ready"));
}

TEST_CASE("while an editor holds the rig a desk may black it out and nothing else") {
  const Stand stand;
  RigClient editor = stand.client();
  REQUIRE(editor.play());
  lo_send(stand.desk, "/focalstage/hold", "");
  CHECK(eventually([&] { return stand.refusals("rig.held") == 1; }));
  CHECK(stand.state().state == "playing");
  lo_send(stand.desk, "/focalstage/blackout", "");
  CHECK(stand.becomes("dark"));
  lo_send(stand.desk, "/focalstage/go", "");
  CHECK(eventually([&] { return stand.refusals("rig.held") == 2; }));
  CHECK(stand.state().state == "dark");
}

TEST_CASE("a desk that the configuration trusts commands beside an editor") {
  const Stand stand(true);
  RigClient editor = stand.client();
  REQUIRE(editor.play());
  lo_send(stand.desk, "/focalstage/hold", "");
  CHECK(stand.becomes("holding"));
  CHECK_FALSE(stand.state().holder.empty());
}

TEST_CASE("a flood of commands is bounded; a blackout comes through it") {
  const Stand stand;
  for (int n = 0; n < 400; ++n) lo_send(stand.desk, "/focalstage/cue", "s", "none");
  // UDP loses what the system cannot keep: one of a few comes through.
  CHECK(eventually([&] {
    lo_send(stand.desk, "/focalstage/blackout", "");
    return stand.state().state == "dark";
  }));
  CHECK(stand.refusals("rig.refused") >= 100);
  CHECK(stand.refusals("rig.refused") <= 250);
}

TEST_CASE("an address that can't be had is a fault of the start") {
  const Stand stand;
  RigConfig config;
  config.listen = "127.0.0.1:0";
  config.store = stand.folder.path() / "other";
  config.osc = OscConfig{stand.service->osc_address(), "/focalstage", {}, false};
  const auto service = Service::start(config, *runtime_options(config));
  REQUIRE_FALSE(service);
  CHECK(service.fault().code == "runtime.address-in-use");
}

}  // namespace
}  // namespace focalstage
