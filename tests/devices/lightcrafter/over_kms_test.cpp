#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <thread>

#include "devices/display_kms/kms_display.h"
#include "devices/lightcrafter/lightcrafter.h"
#include "devices/roles/clock.h"
#include "tests/devices/display_kms/fake_drm.h"
#include "tests/devices/display_kms/fake_edid.h"
#include "tests/devices/lightcrafter/board_reports.h"

namespace focalstage {
namespace {

using lightcrafter_emulator::Board;
using lightcrafter_emulator::Light;

drmModeModeInfo mode_of_the_board() {
  drmModeModeInfo mode{};
  mode.hdisplay = 912;
  mode.vdisplay = 1140;
  mode.htotal = 1000;
  mode.vtotal = 1200;
  mode.clock = 72000;
  return mode;
}

/// The kernel's output, whose cable ends in the board.
struct Cable {
  explicit Cable(const LightCrafterSettings& settings) {
    drm.slowness = 100;  // a frame takes the emulated board longer than the output waits for its vblank
    drm.connectors = {{40, true, edid_of("TXN", 0x4500, 1, "DLP4500", ""), {mode_of_the_board()}}};
    projector = make_lightcrafter(settings, make_kms_display({}, drm), [this](const std::string&, const std::string&) {
      return Result<std::unique_ptr<lightcrafter::Reports>>(
          std::make_unique<lightcrafter::BoardReports>(board, std::make_shared<std::atomic<bool>>(true)));
    });
  }

  /// One period: what is on the cable after the vblank arrives at the board.
  void period() {
    REQUIRE(drm.flip_and_vblank());
    board.video_frame(drm.on_cable(), drm.time_s());
    REQUIRE(drm.wait_for_flip());
  }

  FakeDrm drm;
  Board board;
  std::unique_ptr<ProjectorDevice> projector;
};

TEST_CASE(
    "from pictures to light through the kernel's output: each at its time, dithered to what was asked, then black") {
  LightCrafterSettings settings;
  settings.plan.shown_bits = 1;
  Cable cable(settings);
  ProjectorDevice& projector = *cable.projector;
  REQUIRE(projector.open().ok());
  cable.period();
  Exposures exposures;
  exposures.period_s = 1.0 / 60.0;
  exposures.start_s = {0.002, 0.0052, 0.0101, 0.0131};
  exposures.exposure_s = 0.0005;
  REQUIRE(projector.arm(exposures).ok());
  REQUIRE(projector.start().ok());
  cable.board.take_lights();

  std::vector<Picture> pictures;
  for (const int code : {0, 64, 191, 255}) {
    const auto codes = std::make_shared<std::vector<std::uint8_t>>(912 * 1140, static_cast<std::uint8_t>(code));
    pictures.push_back({codes, *codes});
  }
  REQUIRE(projector.post(pictures).ok());
  std::vector<Light> lights;
  double lit_s = 0.0;
  for (int i = 0; i < 100 && lights.empty(); ++i) {  // until it is packed, taken, shown, and passed on by the board
    cable.period();
    lights = cable.board.take_lights();
    std::erase_if(lights, [](const Light& light) { return light.black(); });
    lit_s = cable.drm.time_s();
  }
  REQUIRE(lights.size() == 3);
  const std::vector<double> shares{64 / 255.0, 191 / 255.0, 1.0};
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(std::abs(lights[i].start_s - (lit_s + exposures.start_s[i + 1] - exposures.start_s[0])) < 2e-6);
    const auto levels = lights[i].levels();
    const double share = static_cast<double>(std::ranges::count(levels, 1)) / static_cast<double>(levels.size());
    CHECK(share == doctest::Approx(shares[i]).epsilon(0.003));
  }
  CHECK(*projector.report().newest_period_s == doctest::Approx(lit_s - exposures.start_s[0]));
  cable.period();
  lights = cable.board.take_lights();
  CHECK(std::ranges::all_of(lights, [](const Light& light) { return light.black(); }));

  std::jthread beam([&](const std::stop_token& stop) {  // the last black frame needs its vblank
    while (!stop.stop_requested()) {
      cable.drm.vblank();
      sleep_until(monotonic_s() + 0.001);
    }
  });
  projector.close();
  CHECK(cable.drm.left_over() == 0);
}

}  // namespace
}  // namespace focalstage
