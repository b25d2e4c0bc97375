#include "devices/display_kms/kms_display.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <string>
#include <thread>

#include "tests/devices/display_kms/fake_drm.h"
#include "tests/devices/display_kms/fake_edid.h"

namespace focalstage {
namespace {

drmModeModeInfo mode_of(int width, int height, double hz, std::uint32_t flags = 0) {
  drmModeModeInfo mode{};
  mode.hdisplay = static_cast<std::uint16_t>(width);
  mode.vdisplay = static_cast<std::uint16_t>(height);
  mode.htotal = static_cast<std::uint16_t>(width + 100);
  mode.vtotal = static_cast<std::uint16_t>(height + 20);
  mode.clock = static_cast<std::uint32_t>(hz * mode.htotal * mode.vtotal / 1e3 + 0.5);
  mode.flags = flags;
  return mode;
}

KmsSettings small() {
  KmsSettings settings;
  settings.name = "DLP4500";
  settings.width_px = 8;
  settings.height_px = 4;
  settings.rate_tolerance = 0.01;  // clocks are whole kHz
  return settings;
}

void plug_in(FakeDrm& drm) {
  drm.connectors = {{31, true, edid_of("DEL", 7, 9, "U2412M", "D1"), {mode_of(1920, 1200, 60)}},
                    {35, false, {}, {}},
                    {37, true, edid_of("TXN", 0x4500, 17, "DLP4500", ""), {mode_of(1280, 800, 60), mode_of(8, 4, 60)}}};
}

VideoFrame frame_of(std::uint32_t pixel) { return std::make_shared<const std::vector<std::uint32_t>>(32, pixel); }

bool all(const std::vector<std::uint32_t>& pixels, std::uint32_t pixel) {
  return pixels.size() == 32 && std::ranges::all_of(pixels, [&](std::uint32_t p) { return p == pixel; });
}

bool within(double seconds, const auto& condition) {
  const auto until = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  while (!condition()) {
    if (std::chrono::steady_clock::now() > until) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return true;
}

/// Lets the vblanks of a display that ends come.
class Beam {
 public:
  explicit Beam(FakeDrm& drm)
      : thread_([&drm](const std::stop_token& stop) {
          while (!stop.stop_requested()) {
            drm.vblank();
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
          }
        }) {}

 private:
  std::jthread thread_;
};

TEST_CASE("black first, then each frame at its vblank, and black again when the feeder is silent for one") {
  FakeDrm drm;
  plug_in(drm);
  const auto display = make_kms_display(small(), drm);
  CHECK_FALSE(display->post(frame_of(1)).ok());
  REQUIRE(display->open().ok());
  CHECK(drm.lit_connector() == 37);
  CHECK(all(drm.on_cable(), 0));
  CHECK(display->mode().width_px == 8);
  CHECK(display->mode().interval_s == doctest::Approx(1.0 / 60.0).epsilon(0.01));

  REQUIRE(drm.wait_for_flip());  // black is on its way
  REQUIRE(display->post(frame_of(0xABCDEF)).ok());
  REQUIRE(display->post(frame_of(0x123456)).ok());
  CHECK(display->post(frame_of(0x777777)).fault().code == "display.full");
  drm.vblank();
  CHECK(all(drm.on_cable(), 0));
  REQUIRE(drm.flip_and_vblank());
  CHECK(all(drm.on_cable(), 0xABCDEF));
  REQUIRE(drm.flip_and_vblank());
  CHECK(all(drm.on_cable(), 0x123456));
  REQUIRE(drm.flip_and_vblank());
  CHECK(all(drm.on_cable(), 0));
  REQUIRE(drm.wait_for_flip());
  const DisplayReport report = display->report();
  CHECK(report.vblanks == 4);
  CHECK(report.shown == 2);
  CHECK(report.silent == 2);
  CHECK(report.repeated == 0);
  CHECK(*report.newest_vblank_s == doctest::Approx(drm.time_s()));
  CHECK_FALSE(drm.torn());
  const Beam beam(drm);
  display->close();
  CHECK(drm.left_over() == 0);
  CHECK(drm.on_cable().empty());
  display->close();
}

TEST_CASE("black at once forgets what waits") {
  FakeDrm drm;
  plug_in(drm);
  const auto display = make_kms_display(small(), drm);
  REQUIRE(display->open().ok());
  REQUIRE(drm.wait_for_flip());
  REQUIRE(display->post(frame_of(5)).ok());
  REQUIRE(display->post(frame_of(6)).ok());
  drm.vblank();
  REQUIRE(drm.wait_for_flip());  // frame 5 is on its way
  display->black();
  drm.vblank();
  CHECK(all(drm.on_cable(), 5));
  REQUIRE(drm.flip_and_vblank());
  CHECK(all(drm.on_cable(), 0));
  const Beam beam(drm);
  display->close();
}

TEST_CASE("vblanks that this program missed are counted") {
  FakeDrm drm;
  plug_in(drm);
  const auto display = make_kms_display(small(), drm);
  REQUIRE(display->open().ok());
  for (int i = 0; i < 3; ++i) REQUIRE(drm.flip_and_vblank());
  REQUIRE(drm.flip_and_vblank(3));
  REQUIRE(drm.wait_for_flip());
  CHECK(display->report().vblanks == 6);
  CHECK(display->report().repeated == 2);
  const Beam beam(drm);
  display->close();
}

TEST_CASE("many frames, none torn, none lost") {
  FakeDrm drm;
  plug_in(drm);
  const auto display = make_kms_display(small(), drm);
  REQUIRE(display->open().ok());
  REQUIRE(drm.wait_for_flip());
  for (std::uint32_t i = 1; i <= 500; ++i) {
    REQUIRE(display->post(frame_of(i)).ok());
    REQUIRE(drm.flip_and_vblank());
    if (i > 1) CHECK(all(drm.on_cable(), i - 1));
    REQUIRE(drm.wait_for_flip());
  }
  CHECK(display->report().silent == 1);
  CHECK_FALSE(drm.torn());
  const Beam beam(drm);
  display->close();
}

TEST_CASE("unplugged: lost, and found again by its identity wherever it then is") {
  FakeDrm drm;
  plug_in(drm);
  const auto display = make_kms_display(small(), drm);
  REQUIRE(display->open().ok());
  {
    const Beam beam(drm);
    drm.unplug(2);
    CHECK(within(1.0, [&] { return display->report().fault.has_value(); }));
  }
  CHECK(display->report().fault->code == "display.lost");
  CHECK(display->post(frame_of(1)).fault().code == "display.lost");
  CHECK(display->open().fault().code == "display.absent");
  drm.connectors[1] = {35, true, edid_of("TXN", 0x4500, 17, "DLP4500", ""), {mode_of(8, 4, 60)}};
  REQUIRE(display->open().ok());
  CHECK(drm.lit_connector() == 35);
  CHECK_FALSE(display->report().fault);
  const Beam beam(drm);
  display->close();
  CHECK(drm.left_over() == 0);
}

TEST_CASE("a card that no longer flips, or no longer says so, is lost") {
  FakeDrm refusing;
  plug_in(refusing);
  const auto display = make_kms_display(small(), refusing);
  REQUIRE(display->open().ok());
  REQUIRE(refusing.wait_for_flip());
  refusing.flip_error = -EACCES;
  refusing.vblank();
  CHECK(within(1.0, [&] { return display->report().fault.has_value(); }));
  CHECK(refusing.on_cable().empty());

  FakeDrm silent;
  plug_in(silent);
  const auto other = make_kms_display(small(), silent);
  REQUIRE(other->open().ok());
  CHECK(within(1.0, [&] { return other->report().fault.has_value(); }));
  CHECK(other->report().fault->message.find("no vblank") != std::string::npos);
}

TEST_CASE("bits arrive as they are: full range, eight bits, a straight ramp") {
  FakeDrm drm;
  plug_in(drm);
  const auto display = make_kms_display(small(), drm);
  REQUIRE(display->open().ok());
  CHECK(drm.properties["Broadcast RGB"] == "Full");
  CHECK(drm.properties["max bpc"] == "8");
  CHECK(drm.gamma_size() == 256);
  const Beam beam(drm);
  display->close();
}

TEST_CASE("which display, and which mode") {
  FakeDrm drm;
  plug_in(drm);
  const auto all_of_them = list_connectors(drm);
  REQUIRE(all_of_them.size() == 2);
  KmsSettings settings = small();
  CHECK(choose_connector(all_of_them, settings)->id == 37);
  settings.name.clear();
  CHECK(choose_connector(all_of_them, settings).fault().code == "display.which");
  settings.serial = "17";
  CHECK(choose_connector(all_of_them, settings)->id == 37);
  settings.maker = "DEL";
  const auto absent = choose_connector(all_of_them, settings);
  REQUIRE_FALSE(absent.ok());
  CHECK(absent.fault().code == "display.absent");
  CHECK(absent.fault().message.find("TXN 17664 'DLP4500' 17") != std::string::npos);

  KmsConnector connector;
  settings = KmsSettings{};
  connector.modes = {mode_of(912, 1140, 59.94), mode_of(912, 1140, 120), mode_of(1280, 800, 60),
                     mode_of(912, 1140, 60, DRM_MODE_FLAG_INTERLACE)};
  CHECK(choose_mode(connector, settings).ok());
  settings.rate_tolerance = 0.0005;
  const auto none = choose_mode(connector, settings);
  REQUIRE_FALSE(none.ok());
  CHECK(none.fault().code == "display.mode");
  CHECK(none.fault().message.find("912x1140@59.94") != std::string::npos);
  connector.modes.push_back(mode_of(912, 1140, 60));
  CHECK(1.0 / interval_s(*choose_mode(connector, settings)) == doctest::Approx(60.0).epsilon(1e-4));
  settings.rate_hz = 120;
  CHECK(1.0 / interval_s(*choose_mode(connector, settings)) == doctest::Approx(120.0).epsilon(1e-4));
  CHECK(interval_s(drmModeModeInfo{}) == 0.0);
}

TEST_CASE("every refusal is named and leaves nothing behind") {
  const auto refused = [](const auto& spoil) {
    FakeDrm drm;
    plug_in(drm);
    spoil(drm);
    const auto display = make_kms_display(small(), drm);
    const Status opened = display->open();
    REQUIRE_FALSE(opened.ok());
    CHECK(drm.left_over() == 0);
    return opened.fault().code;
  };
  CHECK(refused([](FakeDrm& drm) { drm.master_error = -EACCES; }) == "display.busy");
  CHECK(refused([](FakeDrm& drm) { drm.open_error = -EACCES; }) == "display.absent");
  CHECK(refused([](FakeDrm& drm) { drm.mode_error = -EINVAL; }) == "display.refused");
  CHECK(refused([](FakeDrm& drm) { drm.memory_error = -ENOMEM; }) == "display.refused");
  CHECK(refused([](FakeDrm& drm) { drm.tells_monotonic = false; }) == "display.refused");
  CHECK(refused([](FakeDrm& drm) { drm.connectors.clear(); }) == "display.absent");
  CHECK(refused([](FakeDrm& drm) { drm.connectors[2].modes.pop_back(); }) == "display.mode");
  // A crtc that lights another display is left to it.
  FakeDrm drm;
  plug_in(drm);
  drm.crtc_of_other = 200;
  const auto display = make_kms_display(small(), drm);
  REQUIRE(display->open().ok());
  const Beam beam(drm);
  display->close();
}

TEST_CASE("on this machine's own cards" * doctest::skip(!std::filesystem::exists("/dev/dri/card0"))) {
  // vkms, or a display of 1024 x 768; without the right to hold the card's outputs this only looks.
  KmsSettings settings;
  settings.width_px = 1024;
  settings.height_px = 768;
  const auto all_of_them = list_connectors(kernel_drm());
  MESSAGE(all_of_them.size() << " displays");
  const auto display = make_kms_display(settings);
  const Status opened = display->open();
  if (!opened) {
    MESSAGE(opened.fault().message);
    return;
  }
  CHECK(within(2.0, [&] { return display->report().vblanks > 30; }));
  display->close();
}

}  // namespace
}  // namespace focalstage
