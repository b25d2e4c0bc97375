#include "devices/display_glfw/glfw_display.h"

#include <doctest/doctest.h>

#include <chrono>
#include <thread>

// Its macros are for what comes last.
#include <X11/Xlib.h>
#include <X11/Xutil.h>
#undef Status

namespace focalstage {
namespace {

/// The pixel of the screen there.
unsigned long on_screen(int x, int y) {
  ::Display* server = XOpenDisplay(nullptr);
  REQUIRE(server != nullptr);
  XImage* image = XGetImage(server, DefaultRootWindow(server), x, y, 1, 1, AllPlanes, ZPixmap);
  REQUIRE(image != nullptr);
  const unsigned long pixel = XGetPixel(image, 0, 0) & 0xFFFFFF;
  XDestroyImage(image);
  XCloseDisplay(server);
  return pixel;
}

bool within(double seconds, const auto& condition) {
  const auto until = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  while (!condition()) {
    if (std::chrono::steady_clock::now() > until) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return true;
}

TEST_CASE("frames reach the screen bit by bit, and black when nobody posts") {
  GlfwSettings settings;
  settings.width_px = 3840;  // the test's screen has this one mode
  settings.height_px = 2160;
  settings.rate_hz = 10;
  const auto display = make_glfw_display(settings);
  const Status opened = display->open();
  if (!opened) MESSAGE(opened.fault().message);
  REQUIRE(opened.ok());
  CHECK(display->open().ok());
  auto pixels = std::make_shared<std::vector<std::uint32_t>>(3840 * 2160, 0x00FF00U);
  pixels->at(0) = 0x010203;
  pixels->at(1) = 0xFEFDFC;
  pixels->at(3840 * 2159 + 3839) = 0x804020;
  // Posted often enough that it is seen.
  const bool shown = within(10.0, [&] {
    (void)display->post(pixels);
    return on_screen(0, 0) == 0x010203 && on_screen(1, 0) == 0xFEFDFC && on_screen(3839, 2159) == 0x804020 &&
           on_screen(1000, 1000) == 0x00FF00;
  });
  CHECK(shown);
  CHECK(within(10.0, [&] { return on_screen(0, 0) == 0 && on_screen(1000, 1000) == 0; }));
  const DisplayReport report = display->report();
  CHECK(report.shown > 0);
  CHECK(report.silent > 0);
  CHECK(report.newest_vblank_s);
  display->close();
  CHECK_FALSE(display->post(pixels).ok());
}

TEST_CASE("a display that is not there is named") {
  GlfwSettings settings;
  settings.monitor = "HDMI-9";
  CHECK(make_glfw_display(settings)->open().fault().code == "display.mode");
  settings.monitor.clear();
  const Status opened = make_glfw_display(settings)->open();
  REQUIRE_FALSE(opened.ok());
  CHECK(opened.fault().message.find("912 x 1140") != std::string::npos);
}

}  // namespace
}  // namespace focalstage
