#include "devices/plugin/plugin_projector.h"

#include <doctest/doctest.h>

#include "tests/devices/plugin/conformance.h"
#include "tests/devices/plugin/emulator/optics.h"
#include "tests/support/temporary_folder.h"

namespace focalstage {
namespace {

using test::four_in_100_ms;
using test::period_of;
using test::within;
using wire_emulator::Optics;
using wire_emulator::OpticsFaults;

PluginProjectorSettings settings_for(const std::string& name) {
  PluginProjectorSettings settings;
  settings.plugin.library = std::string(FOCALSTAGE_BINARY_DIR) + "/plugins/" + name + ".so";
  settings.eye_safe = true;
  return settings;
}

/// The wire plugin and its optics, opened and started.
struct Wired {
  explicit Wired(wire_emulator::OpticsOptions options = {}) {
    options.socket = (folder / "optics").string();
    optics = Optics::start(options);
    REQUIRE(optics);
    PluginProjectorSettings settings = settings_for("focalstage-wire");
    settings.plugin.options = {{"socket", options.socket}};
    projector = make_plugin_projector(settings);
  }

  void begin() {
    if (const Status opened = projector->open(); !opened) FAIL(describe(opened.fault()));
    REQUIRE(projector->arm(four_in_100_ms()).ok());
    REQUIRE(projector->start().ok());
  }

  bool lost() const { return projector->state().phase == DevicePhase::lost; }

  TemporaryFolder folder;
  std::unique_ptr<Optics> optics;
  std::unique_ptr<ProjectorDevice> projector;
};

TEST_CASE("a plugin that nobody vouches for is not as much as loaded") {
  PluginProjectorSettings settings = settings_for("focalstage-null");
  settings.eye_safe = false;
  auto projector = make_plugin_projector(settings);
  CHECK(projector->open().fault().code == "plugin.eye-safety");
  CHECK(projector->state().phase == DevicePhase::refused);
  settings.plugin.library = "/nowhere/at-all.so";  // the flag is asked for before the file
  CHECK(make_plugin_projector(settings)->open().fault().code == "plugin.eye-safety");
}

TEST_CASE("what cannot be opened says why, and nothing can be asked of it") {
  const auto code_of = [](const PluginProjectorSettings& settings) {
    const auto projector = make_plugin_projector(settings);
    const Status opened = projector->open();
    CHECK(projector->state().fault.has_value());
    CHECK_FALSE(projector->arm(four_in_100_ms()).ok());
    CHECK(projector->dark());
    return opened ? "" : opened.fault().code;
  };
  PluginProjectorSettings settings = settings_for("focalstage-null");
  settings.plugin.library = "focalstage-null.so";
  CHECK(code_of(settings) == "plugin.path");
  CHECK(code_of(settings_for("not-there")) == "plugin.library");
  CHECK(code_of(settings_for("focalstage-null_drive")) == "plugin.symbol");
  settings = settings_for("focalstage-null");
  settings.plugin.options = {{"width", "none"}};
  CHECK(code_of(settings) == "plugin.settings");
  settings = settings_for("focalstage-wire");
  settings.plugin.options = {{"socket", "/nowhere/optics"}};
  CHECK(code_of(settings) == "plugin.absent");
}

TEST_CASE("dark within 200 ms while the plugin hangs in a call; then lost, and open waits for nobody") {
  const auto projector = make_plugin_projector(settings_for("plugin_mutant_hang"));
  REQUIRE(projector->open().ok());
  REQUIRE(projector->arm(four_in_100_ms()).ok());
  REQUIRE(projector->start().ok());
  for (int i = 0; i < 3; ++i) REQUIRE(projector->post(period_of(*projector, 1)).ok());
  std::this_thread::sleep_for(std::chrono::milliseconds(250));  // it hangs in the third period
  const double told_s = monotonic_s();
  CHECK(projector->dark());
  CHECK(monotonic_s() - told_s < 0.2);
  CHECK(within(3.0, [&] { return projector->state().phase == DevicePhase::lost; }));
  CHECK(projector->state().fault->code == "plugin.hung");
  const double open_s = monotonic_s();
  CHECK(projector->open().fault().code == "plugin.hung");
  CHECK(monotonic_s() - open_s < 3.0);
}

TEST_CASE("a blank that hangs is no darkness, and is told so in time") {
  const auto projector = make_plugin_projector(settings_for("plugin_mutant_blank_hangs"));
  REQUIRE(projector->open().ok());
  REQUIRE(projector->arm(four_in_100_ms()).ok());
  REQUIRE(projector->start().ok());
  const double told_s = monotonic_s();
  CHECK_FALSE(projector->dark());
  CHECK(monotonic_s() - told_s < 0.2);
}

TEST_CASE("a status that is silent for a second is a lost projector") {
  for (const char* defect : {"silent", "stuck"}) {
    CAPTURE(defect);
    const auto projector = make_plugin_projector(settings_for(std::string("plugin_mutant_") + defect));
    REQUIRE(projector->open().ok());
    REQUIRE(projector->arm(four_in_100_ms()).ok());
    REQUIRE(projector->start().ok());
    const double begun_s = monotonic_s();
    while (projector->post(period_of(*projector, 1)).ok() || monotonic_s() < begun_s + 0.3) {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    CHECK(within(5.0, [&] { return projector->state().phase == DevicePhase::lost; }));
    CHECK(projector->state().fault->code == "plugin.silent");
    const double silence_s = monotonic_s() - projector->state().heard_s;
    CHECK(silence_s > 0.95);
    CHECK(silence_s < 1.5);
  }
}

TEST_CASE("wire: optics that hang up are lost, and found again") {
  Wired wired;
  wired.begin();
  REQUIRE(wired.projector->post(period_of(*wired.projector, 1)).ok());
  OpticsFaults faults;
  faults.hang_up_at_frame = true;
  wired.optics->misbehave(faults);
  (void)wired.projector->post(period_of(*wired.projector, 1));
  CHECK(within(3.0, [&] { return wired.lost(); }));
  CHECK(wired.projector->state().fault->code == "plugin.lost");
  CHECK_FALSE(wired.optics->record().triggers);
  wired.optics->misbehave({});
  wired.begin();
  CHECK(wired.projector->id().serial == "OPTICS-1");
  CHECK(wired.optics->record().connections == 2);
  REQUIRE(wired.projector->post(period_of(*wired.projector, 1)).ok());
  CHECK(within(3.0, [&] { return wired.projector->report().exposures > 0; }));
}

TEST_CASE("wire: optics that take nothing more are dark by the end of the stream") {
  Wired wired({.socket = "", .width_px = 1024, .height_px = 768});
  wired.begin();
  OpticsFaults faults;
  faults.deaf = true;
  wired.optics->misbehave(faults);
  for (int i = 0; i < 2; ++i) (void)wired.projector->post(period_of(*wired.projector, 1));
  std::this_thread::sleep_for(std::chrono::milliseconds(30));
  const double told_s = monotonic_s();
  CHECK_FALSE(wired.projector->dark());  // nobody there says that it is
  CHECK(monotonic_s() - told_s < 0.2);
  CHECK(within(3.0, [&] { return wired.lost(); }));
  wired.optics->misbehave({});
  CHECK(within(3.0, [&] { return !wired.optics->record().triggers; }));
}

TEST_CASE("wire: optics that answer no blank, or tell no counts") {
  Wired wired;
  wired.begin();
  OpticsFaults faults;
  faults.no_answer = true;
  wired.optics->misbehave(faults);
  CHECK_FALSE(wired.projector->dark());
  CHECK(within(3.0, [&] { return !wired.optics->record().triggers; }));
  wired.optics->misbehave({});
  REQUIRE(within(3.0, [&] { return wired.lost() && wired.projector->open().ok(); }));
  wired.begin();
  faults = {};
  faults.mute = true;
  wired.optics->misbehave(faults);
  CHECK(within(5.0, [&] { return wired.lost(); }));
  CHECK(wired.projector->state().fault->code == "plugin.silent");
  CHECK(within(3.0, [&] { return !wired.optics->record().triggers; }));  // made dark by itself
}

TEST_CASE("wire: it shows itself") {
  Wired wired;
  REQUIRE(wired.projector->open().ok());
  CHECK(wired.projector->identify().ok());
  CHECK(within(3.0, [&] { return wired.optics->record().identified == 1; }));
}

}  // namespace
}  // namespace focalstage
