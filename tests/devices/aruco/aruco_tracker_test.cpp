#include "devices/aruco/aruco_tracker.h"

#include <unistd.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <functional>
#include <numbers>
#include <thread>

#include <doctest/doctest.h>

#include "devices/camera/recorded_camera.h"
#include "devices/roles/clock.h"
#include "tests/devices/aruco/rendered.h"

namespace focalstage {
namespace {

bool within(double seconds, const std::function<bool()>& holds) {
  for (const double end_s = monotonic_s() + seconds; monotonic_s() < end_s;) {
    if (holds()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return holds();
}

TEST_CASE("recorded pictures of a marker that moves are a tracker; at their end it is lost") {
  std::string folder = (std::filesystem::temp_directory_path() / "focalstage-aruco-XXXXXX").string();
  REQUIRE(::mkdtemp(folder.data()) != nullptr);
  ArucoSettings settings;
  settings.camera = {300.0, 300.0, 160.0, 120.0, {}};
  settings.bodies = {{7, "Card", {{3, 0.1, {}}}}};
  const glm::dquat tilt = glm::angleAxis(0.7, glm::dvec3(1, 0, 0));
  const auto x_of = [](std::int64_t n) { return -0.06 + 0.03 * static_cast<double>(n); };
  for (int n = 0; n < 5; ++n) {
    const Rigid pose{{x_of(n), 0.0, -0.35}, tilt};
    const CameraFrame shot = sample::photograph(
        settings.camera, {{pose, sample::marker_pattern(cv::aruco::DICT_4X4_50, 3, 0.1)}}, {320, 240, 2.0, 0.5, 2});
    REQUIRE(write_pgm(folder + "/" + std::to_string(n) + ".pgm", {320, 240, shot.gray}).ok());
  }
  const auto camera = std::make_shared<RecordedCamera>(RecordedCameraSettings{folder, 10.0, false});
  ArucoTracker tracker(camera, settings);
  CHECK(tracker.state().phase == TrackerPhase::off);
  REQUIRE(tracker.start().ok());
  std::int64_t last = -1;
  CHECK(within(20.0, [&] {
    const auto frame = tracker.newest();
    if (!frame || frame->number == last) return last == 4;
    last = frame->number;
    REQUIRE(frame->bodies.size() == 1);
    CHECK(frame->bodies[0].name == "Card");
    REQUIRE(frame->bodies[0].tracked);
    CHECK(std::abs(frame->bodies[0].tracker_from_body.position_m.x - x_of(frame->number)) < 2e-3);
    CHECK(*frame->latency_s == doctest::Approx(frame->arrival_s - frame->time_s));
    CHECK(*frame->latency_s >= 0.0);
    return last == 4;
  }));
  CHECK(within(20.0, [&] { return tracker.state().phase == TrackerPhase::lost; }));
  REQUIRE(tracker.state().fault);
  tracker.stop();
  CHECK(tracker.newest() == nullptr);
  std::filesystem::remove_all(folder);
}

/// One that is plugged in after it was asked for twice.
class LateCamera final : public Camera {
 public:
  Status open() override {
    if (++asked_ < 3) return Fault{"camera.absent", "/dev/video7", "there is no camera", "see that it is plugged in"};
    phase_ = DevicePhase::running;
    return {};
  }
  void close() override { phase_ = DevicePhase::off; }
  DeviceId id() const override { return {"late", "camera", "", "/dev/video7"}; }
  DeviceState state() const override {
    DeviceState state;
    state.phase = phase_;
    return state;
  }
  Status identify() override { return {}; }
  std::shared_ptr<const CameraFrame> newest() const override {
    if (phase_ != DevicePhase::running) return nullptr;
    static const auto black = std::make_shared<const CameraFrame>(
        CameraFrame{32, 32, 1, monotonic_s(), std::vector<std::uint8_t>(std::size_t{32} * 32, 0)});
    return black;
  }

 private:
  std::atomic<DevicePhase> phase_ = DevicePhase::off;
  std::atomic<int> asked_ = 0;
};

TEST_CASE("a camera that is not there yet is waited for, and named") {
  ArucoSettings settings;
  settings.bodies = {{7, "Card", {{3, 0.1, {}}}}};
  ArucoTracker tracker(std::make_shared<LateCamera>(), settings);
  REQUIRE(tracker.start().ok());
  const TrackerState waiting = tracker.state();
  CHECK(waiting.phase == TrackerPhase::seeking);
  REQUIRE(waiting.fault);
  CHECK(waiting.fault->where == "/dev/video7");
  CHECK(within(5.0, [&] { return tracker.state().frames == 1; }));
  CHECK_FALSE(tracker.state().fault);
}

TEST_CASE("what cannot start says why") {
  const auto none = std::make_shared<RecordedCamera>(RecordedCameraSettings{"/nowhere"});
  ArucoSettings settings;
  settings.bodies = {{7, "Card", {{3, 0.1, {}}}}};
  CHECK(ArucoTracker(none, settings).start().fault().code == "camera.folder");
  settings.dictionary = "none";
  CHECK(ArucoTracker(none, settings).start().fault().code == "aruco.settings");
}

}  // namespace
}  // namespace focalstage
