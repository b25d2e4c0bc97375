#include "devices/camera/v4l2_camera.h"

#include <functional>

#include <doctest/doctest.h>

#include "devices/roles/clock.h"
#include "tests/devices/camera/fake_v4l2.h"

namespace focalstage {
namespace {

using sample::FakeCamera;
using sample::FakeV4l2;

bool within(double seconds, const std::function<bool()>& holds) {
  for (const double end_s = monotonic_s() + seconds; monotonic_s() < end_s;) {
    if (holds()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return holds();
}

std::shared_ptr<const CameraFrame> next_frame(const V4l2Camera& camera, std::uint64_t number) {
  REQUIRE(within(10.0, [&] {
    const auto frame = camera.newest();
    return frame && frame->number == number;
  }));
  return camera.newest();
}

struct Plugged {
  std::shared_ptr<FakeV4l2> machine = std::make_shared<FakeV4l2>();
  V4l2Camera camera;

  explicit Plugged(const FakeCamera& fake = {}, V4l2Settings settings = {}) : camera(std::move(settings), machine) {
    machine->plug("/dev/video0", fake);
  }
};

void check_picture(const CameraFrame& frame, int code) {
  REQUIRE(frame.width_px == 8);
  REQUIRE(frame.height_px == 4);
  REQUIRE(frame.gray.size() == 32);
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 8; ++x) CHECK(frame.gray[static_cast<std::size_t>(8 * y + x)] == x + 10 * y + code);
  }
}

TEST_CASE("gray, and the brightness of YUYV, come whole, with padded rows too, and buffers go back") {
  for (const bool gray : {true, false}) {
    for (const std::uint32_t padding : {0u, 6u}) {
      FakeCamera fake;
      fake.can_gray = gray;
      fake.row_padding = padding;
      Plugged rig(fake);
      REQUIRE(rig.camera.open().ok());
      REQUIRE(rig.camera.open().ok());
      CHECK(rig.machine->opened() == 1);
      CHECK(rig.camera.newest() == nullptr);
      for (std::uint8_t n = 1; n < 20; ++n) {
        rig.machine->expose(n, n, monotonic_s());
        check_picture(*next_frame(rig.camera, n), n);
      }
      CHECK(within(5.0, [&] { return rig.machine->queued() == 4; }));
      CHECK(rig.camera.state().phase == DevicePhase::running);
      rig.camera.close();
      CHECK(rig.machine->mapped() == 0);
      CHECK(rig.machine->opened() == 0);
      CHECK_FALSE(rig.machine->streaming());
      CHECK(rig.camera.state().phase == DevicePhase::off);
    }
  }
}

TEST_CASE("stamps: half an exposure after its start, before its end; what is no time of ours is not believed") {
  V4l2Settings settings;
  settings.exposure_s = 0.01;
  Plugged rig({}, settings);
  REQUIRE(rig.camera.open().ok());
  const double then_s = monotonic_s() - 0.02;
  rig.machine->expose(0, 1, then_s);
  CHECK(next_frame(rig.camera, 1)->time_s == doctest::Approx(then_s - 0.005).epsilon(1e-9));
  rig.machine->expose(0, 2, then_s, FakeV4l2::monotonic | V4L2_BUF_FLAG_TSTAMP_SRC_SOE);
  CHECK(next_frame(rig.camera, 2)->time_s == doctest::Approx(then_s + 0.005).epsilon(1e-9));
  rig.machine->expose(0, 3, 5.0e8);
  CHECK(std::abs(next_frame(rig.camera, 3)->time_s - monotonic_s()) < 5.0);
  rig.machine->expose(0, 4, then_s, V4L2_BUF_FLAG_TIMESTAMP_UNKNOWN);
  CHECK(next_frame(rig.camera, 4)->time_s > then_s);
}

TEST_CASE("damaged pictures are passed over") {
  Plugged rig;
  REQUIRE(rig.camera.open().ok());
  rig.machine->expose(1, 1, monotonic_s(), FakeV4l2::monotonic | V4L2_BUF_FLAG_ERROR);
  rig.machine->cut(5);
  rig.machine->expose(2, 2, monotonic_s());
  rig.machine->cut(0);
  rig.machine->expose(3, 3, monotonic_s());
  check_picture(*next_frame(rig.camera, 3), 3);
  CHECK(rig.camera.state().phase == DevicePhase::running);
}

TEST_CASE("unplugged: lost, and found again at another address by its bus") {
  V4l2Settings settings;
  settings.bus = "usb-fake-1";
  Plugged rig({}, settings);
  REQUIRE(rig.camera.open().ok());
  rig.machine->expose(1, 1, monotonic_s());
  (void)next_frame(rig.camera, 1);
  rig.machine->unplug("/dev/video0");
  REQUIRE(within(5.0, [&] { return rig.camera.state().phase == DevicePhase::lost; }));
  CHECK(rig.camera.state().fault->code == "camera.unplugged");
  CHECK(rig.camera.newest() == nullptr);
  CHECK(rig.camera.open().fault().code == "camera.absent");
  rig.machine->plug("/dev/video5", {});
  REQUIRE(rig.camera.open().ok());
  CHECK(rig.camera.id().address == "/dev/video5");
  rig.machine->expose(9, 1, monotonic_s());
  check_picture(*next_frame(rig.camera, 1), 9);
  CHECK(rig.machine->opened() == 1);
}

TEST_CASE("silence of a second is a loss") {
  Plugged rig;
  REQUIRE(rig.camera.open().ok());
  REQUIRE(within(20.0, [&] { return rig.camera.state().phase == DevicePhase::lost; }));
  CHECK(rig.camera.state().fault->code == "camera.silent");
  REQUIRE(rig.camera.open().ok());
  CHECK(rig.camera.state().phase == DevicePhase::running);
}

TEST_CASE("what cannot be used is refused by name, and nothing stays open") {
  const auto code_of = [](const FakeCamera& fake) {
    Plugged rig(fake);
    const Status opened = rig.camera.open();
    CHECK(rig.machine->opened() == 0);
    CHECK(rig.machine->mapped() == 0);
    return opened ? std::string() : opened.fault().code;
  };
  FakeCamera colored;
  colored.can_gray = colored.can_yuyv = false;
  CHECK(code_of(colored) == "camera.format");
  FakeCamera busy;
  busy.busy = true;
  CHECK(code_of(busy) == "camera.busy");
  FakeCamera radio;
  radio.capabilities = V4L2_CAP_TUNER;
  CHECK(code_of(radio) == "camera.absent");
  FakeCamera small;
  small.buffer_shrink = 3;
  CHECK(code_of(small) == "camera.refused");
  V4l2Camera none({}, std::make_shared<FakeV4l2>());
  CHECK(none.open().fault().code == "camera.absent");
  CHECK(none.identify().fault().code == "camera.identify");
}

TEST_CASE("probing finds cameras and disturbs none") {
  FakeV4l2 machine;
  machine.plug("/dev/video0", {});
  FakeCamera radio;
  radio.capabilities = V4L2_CAP_TUNER;
  machine.plug("/dev/video1", radio);
  machine.plug("/dev/video12", {"Other", "usb-fake-2"});
  const auto found = probe_v4l2(machine);
  REQUIRE(found.size() == 2);
  CHECK(found[0] == DeviceId{"camera", "Fake Camera", "usb-fake-1", "/dev/video0"});
  CHECK(found[1] == DeviceId{"camera", "Other", "usb-fake-2", "/dev/video12"});
  CHECK(machine.opened() == 0);
  CHECK_FALSE(machine.streaming());
}

}  // namespace
}  // namespace focalstage
