#include <atomic>
#include <chrono>
#include <cmath>
#include <deque>
#include <memory>
#include <mutex>
#include <numbers>
#include <optional>
#include <thread>
#include <vector>

#include <sys/resource.h>
#include <unistd.h>

#include <doctest/doctest.h>

#include "devices/display/frame_queue.h"
#include "devices/lightcrafter/lightcrafter.h"
#include "devices/mcc1208/mcc1208.h"
#include "devices/rig/device_rig.h"
#include "devices/roles/clock.h"
#include "devices/sim/sim_shutter.h"
#include "devices/uno/uno.h"
#include "tests/devices/lightcrafter/board_reports.h"
#include "tests/devices/mcc1208/emulator/emulator.h"
#include "tests/devices/uno/emulator/emulator.h"
#include "tests/rig/emulator/lens_plant.h"

// A rig whose projector is the clock, with its real drivers and firmware on emulated devices in one device time: a
// LightCrafter on a video output of 59.94 Hz, a waveform generator of 60 Hz with a crystal of its own, and a board
// whose clock is off.

namespace focalstage {
namespace {

using lightcrafter_emulator::Light;
using rig_emulator::LensPlant;
using rig_emulator::LensPlantSettings;

constexpr double show_period_s = 1.0 / 60.0;
constexpr double video_period_s = 1.0 / 59.94;
constexpr double chip_hz = 16e6 * (1.0 + 3e-3);
constexpr double amplitude_a = 0.03;
constexpr double exposure_s = 0.0005;
const std::vector<double> slots_s{0.0045, 0.0065, 0.0135};  // the left eye's two, and the right eye's
constexpr int rows = 1140;
constexpr int columns = 912;

/// A video cable to the emulated projector, which outlives the output that it hangs on.
class Cable {
 public:
  FrameQueue queue{2};
  const std::vector<std::uint32_t> black = std::vector<std::uint32_t>(columns * rows, 0);

  void vblank(lightcrafter_emulator::Board& projector, double device_s, double host_s) {
    const VideoFrame frame = queue.take();
    projector.video_frame(frame ? *frame : black, device_s);
    queue.shown(host_s, 0);
  }
};

class CableDisplay final : public Display {
 public:
  explicit CableDisplay(std::shared_ptr<Cable> cable) : cable_(std::move(cable)) {}
  Status open() override {
    cable_->queue.open(cable_->black.size());
    return {};
  }
  void close() override { cable_->queue.close(); }
  VideoMode mode() const override { return {columns, rows, video_period_s}; }
  Status post(VideoFrame frame) override { return cable_->queue.post(std::move(frame)); }
  std::size_t waiting() const override { return cable_->queue.waiting(); }
  void black() noexcept override { cable_->queue.forget(); }
  DisplayReport report() const override { return cable_->queue.report(); }

 private:
  std::shared_ptr<Cable> cable_;
};

/// What one exposure was.
struct Seen {
  double start_s = 0.0;  ///< device time
  double after_s = 0.0;  ///< since its period's vsync
  int picture = -1;      ///< whose band is bright, and no other's
  double power_d = 0.0;
  double left = 0.0;  ///< least transmission of the slot's own, most of the other's
  double right = 0.0;
};

/// Picture k is bright in the k-th band of rows.
Picture picture_of(std::size_t which) {
  auto codes = std::make_shared<std::vector<std::uint8_t>>(columns * rows, 0);
  const std::size_t band = columns * rows / slots_s.size();
  std::fill_n(codes->begin() + static_cast<std::ptrdiff_t>(which * band), band, 255);
  return {codes, *codes};
}

int picture_in(const Light& light) {
  const auto levels = light.levels();
  const std::size_t band = levels.size() / slots_s.size();
  int found = -1;
  for (std::size_t k = 0; k < slots_s.size(); ++k) {
    if (levels[k * band + band / 2] == 0) continue;
    if (found >= 0) return -1;
    found = static_cast<int>(k);
  }
  return found;
}

/// Hardware does not wait for a busy machine: before others, where that is allowed. Threads begin as who starts them.
class Preferred {
 public:
  Preferred() { (void)::setpriority(PRIO_PROCESS, 0, -15); }
  ~Preferred() { (void)::setpriority(PRIO_PROCESS, 0, 0); }
  Preferred(const Preferred&) = delete;
  Preferred& operator=(const Preferred&) = delete;
};

/// The devices, wired as docs/rig.md says for a projector that is the clock.
class Room {
 public:
  Room()
      : generator_(mcc1208_emulator::Emulator::create(crystal())),
        board_(options()),
        link_("/tmp/focalstage-led-" + std::to_string(::getpid())) {
    REQUIRE_MESSAGE(generator_, "this test runs under umockdev-wrapper, as ctest does it");
    board_.set_link(link_);
    generator_->on_output([this](const auto& output) { hear(output); });
    generator_->plug_in();
    lens_.step(0.0, 0.0);
    for (const Side eye : both_sides) shutter_[eye].command(ShutterLevel::closed, 0.0);
    board_.chip().lens_edge_at(0);
    hardware_.reset();
  }
  ~Room() {
    time_ = {};
    ::unlink(link_.c_str());
  }

  RigDevices devices() {
    LightCrafterSettings settings;
    settings.plan.shown_bits = 1;
    settings.check_signal = false;
    RigDevices devices;
    devices.projector =
        make_lightcrafter(settings, std::make_unique<CableDisplay>(cable_), [this](const auto&, const auto&) {
          return Result<std::unique_ptr<lightcrafter::Reports>>(
              std::make_unique<lightcrafter::BoardReports>(projector_, std::make_shared<std::atomic<bool>>(true)));
        });
    Mcc1208Settings generator;
    generator.amperes_per_volt = 0.12;
    generator.enable_bit = 0;
    // Of this machine's time: that of the devices goes slower where it is busy.
    generator.silence_s = 3.0;
    generator.answer_s = 0.5;
    devices.lens = make_mcc1208(generator);
    UnoSettings uno;
    uno.path = link_;
    devices.board = make_uno(uno);
    const Preferred hardware;
    time_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
    return devices;
  }

  std::vector<Seen> take_seen() {
    const std::lock_guard lock(mutex_);
    return std::exchange(seen_, {});
  }
  double time_s() const {
    const std::lock_guard lock(mutex_);
    return time_s_;
  }
  std::size_t seen() const {
    const std::lock_guard lock(mutex_);
    return seen_.size();
  }

  std::atomic<bool> lens_wired = true;

 private:
  static mcc1208_emulator::Options crystal() {
    mcc1208_emulator::Options options;
    options.crystal_ppm = 80.0;
    return options;
  }
  static uno_emulator::Options options() {
    uno_emulator::Options options;
    options.firmware_elf = FOCALSTAGE_FIRMWARE_ELF;
    return options;
  }
  static uno_emulator::Cycle cycles(double seconds) { return static_cast<uno_emulator::Cycle>(seconds * chip_hz); }

  void hear(const mcc1208_emulator::Output& output) {
    const auto pins = generator_->pins(0);
    const double volts = (output.codes[0] - 2048) * 5.0 / 4096.0;
    lens_.step(output.time_s, pins && (*pins & 1) != 0 ? volts * 0.12 : 0.0);
    const bool rises = sync_code_ < 2048 && output.codes[1] >= 2048;
    sync_code_ = output.codes[1];
    if (rises && lens_wired) board_.chip().lens_edge_at(cycles(output.time_s));
  }

  void advance_to(double time_s, double host_s) {
    generator_->advance_to(time_s);
    for (; vsync_s_ <= time_s; vsync_s_ += video_period_s) {
      cable_->vblank(projector_, vsync_s_, host_s - (time_s - vsync_s_));
      if (projector_.running()) board_.chip().edge_at(cycles(vsync_s_));  // TRIG_OUT_2: the first exposure
      for (Light& light : projector_.take_lights()) {
        if (!light.black()) lit_.push_back({std::move(light), vsync_s_});
      }
    }
    board_.run_until(cycles(time_s));
    heed_pins();
    const std::lock_guard lock(mutex_);
    time_s_ = time_s;
    end_exposures();
  }

  void heed_pins() {
    uno_emulator::Chip& chip = board_.chip();
    const auto move = [this](Side eye, const std::vector<uno_emulator::PinChange>& changes) {
      for (const auto& change : changes) {
        shutter_[eye].command(change.high ? ShutterLevel::closed : ShutterLevel::open,
                              static_cast<double>(change.at) / chip_hz);
      }
    };
    move(Side::left, chip.left);
    move(Side::right, chip.right);
    chip.forget();
  }

  void end_exposures() {
    while (!lit_.empty() && lit_.front().light.start_s + lit_.front().light.length_s < time_s_) {
      const Light& light = lit_.front().light;
      const double end_s = light.start_s + light.length_s;
      Seen seen;
      seen.start_s = light.start_s;
      seen.after_s = light.start_s - lit_.front().vsync_s;
      seen.picture = picture_in(light);
      seen.power_d = lens_.power_d(0.5 * (light.start_s + end_s));
      const bool of_left = seen.picture < 2;
      const Transmission left = shutter_.left.during(light.start_s, end_s);
      const Transmission right = shutter_.right.during(light.start_s, end_s);
      seen.left = of_left ? left.least : left.most;
      seen.right = of_left ? right.most : right.least;
      seen_.push_back(seen);
      lit_.pop_front();
    }
    for (const Side eye : both_sides) shutter_[eye].forget_before(time_s_ - 0.2);
  }

  /// Where this machine was busy, device time waits with it.
  void run(const std::stop_token& stop) {
    using Clock = std::chrono::steady_clock;
    double device_s = 0.0;
    std::optional<std::uint64_t> looks;
    auto looked = Clock::now();
    auto fed = looked - std::chrono::seconds(1);
    for (auto before = looked; !stop.stop_requested();) {
      std::this_thread::sleep_for(std::chrono::microseconds(500));
      const auto now = Clock::now();
      const auto looks_now = generator_->host_looks();
      if (!looks_now || looks_now != looks) looked = now;
      looks = looks_now;
      const auto unseen = now - looked;
      // So it does where the host feeds the projector and did not come to it in time.
      if (cable_->queue.waiting() > 0) fed = now;
      const auto unfed = now - fed;
      const bool starved = unfed > std::chrono::milliseconds(8) && unfed < std::chrono::milliseconds(80);
      if (!starved && (unseen < std::chrono::milliseconds(4) || unseen > std::chrono::milliseconds(200))) {
        double left_s = std::min(std::chrono::duration<double>(now - before).count(), 0.004);
        for (; left_s > 0.0; left_s -= 0.0005) {
          device_s += std::min(left_s, 0.0005);
          advance_to(device_s, monotonic_s());
        }
      }
      before = now;
    }
  }

  struct Lit {
    Light light;
    double vsync_s;
  };

  std::optional<Preferred> hardware_{std::in_place};  ///< while its threads are started
  std::unique_ptr<mcc1208_emulator::Emulator> generator_;
  uno_emulator::UnoEmulator board_;
  lightcrafter_emulator::Board projector_;
  std::shared_ptr<Cable> cable_ = std::make_shared<Cable>();
  std::string link_;
  LensPlant lens_{LensPlantSettings{}};
  PerEye<SimShutter> shutter_{SimShutter(SimShutterSettings{}), SimShutter(SimShutterSettings{})};
  int sync_code_ = 0;
  double vsync_s_ = 0.0031;
  std::deque<Lit> lit_;
  mutable std::mutex mutex_;
  double time_s_ = 0.0;
  std::vector<Seen> seen_;
  std::jthread time_;
};

/// A player's hand, until there was so much light, or a doubt, or it takes too long.
void play(DeviceRig& rig, const Room& room, std::size_t exposures) {
  std::vector<double> drive;
  for (int i = 0; i < 400; ++i) drive.push_back(amplitude_a * std::sin(2.0 * std::numbers::pi * i / 400));
  const std::vector<Picture> pictures{picture_of(0), picture_of(1), picture_of(2)};
  double next_s = monotonic_s() + 6 * show_period_s;
  const double until_s = next_s + 40.0;
  for (int sweep = 0; !rig.doubt() && room.seen() < exposures && next_s < until_s; ++sweep) {
    if (sweep == 0) {
      rig.set_exposure(exposure_s, {});
      rig.announce_triggers(slots_s);
      for (const Side eye : both_sides) rig.set_drive(eye, drive, show_period_s / 400);
    }
    const bool lit = sweep >= rig.settle_sweeps();
    rig.post_images(lit ? pictures : std::vector<Picture>{});
    rig.sync_edge(next_s);
    rig.shutter(Side::left, ShutterLevel::open, next_s + 0.0002);
    rig.shutter(Side::left, ShutterLevel::closed, next_s + 0.0080);
    rig.shutter(Side::right, ShutterLevel::open, next_s + 0.0085);
    rig.shutter(Side::right, ShutterLevel::closed, next_s + 0.0160);
    for (const double at_s : slots_s) {
      if (lit) rig.trigger(next_s + at_s);
    }
    rig.run_until(monotonic_s());
    next_s = rig.edge_near_s(next_s + show_period_s);
    sleep_until(next_s - 6 * show_period_s);
  }
}

/// What the lens has at this time of a period of the projector's.
double asked_d(double at_s) {
  const LensPlantSettings lens;
  const double turn = 2.0 * std::numbers::pi / video_period_s;
  return amplitude_a * lens.gain_d_per_a / std::hypot(1.0, turn * lens.lag_s) *
         std::sin(turn * (at_s - lens.delay_s) - std::atan(turn * lens.lag_s));
}

void becomes_ready(DeviceRig& rig) {
  Status ready;
  for (const double until_s = monotonic_s() + 60.0; monotonic_s() < until_s;) {
    ready = rig.ready();
    if (ready) return;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  FAIL(describe(ready.fault()));
}

/// Each exposure is what was asked for at its place in the period; those from `dark_s` on may lack their shutter, which
/// closes at once, and their power, where the drive was what failed. How many there were.
std::size_t hold_against(const std::vector<Seen>& seen, double dark_s) {
  double worst_d = 0.0;
  double worst_s = 0.0;
  int wrong = 0;
  for (const Seen& light : seen) {
    const double slot_s = slots_s[0] + light.after_s;
    const auto nearest =
        std::ranges::min_element(slots_s, {}, [&](double start_s) { return std::abs(start_s - slot_s); });
    const bool of_left = nearest - slots_s.begin() < 2;
    worst_s = std::max(worst_s, std::abs(*nearest - slot_s));
    wrong += light.picture != nearest - slots_s.begin() ? 1 : 0;
    CHECK((of_left ? light.right : light.left) <= 0.001);
    if (light.start_s >= dark_s) continue;
    worst_d = std::max(worst_d, std::abs(light.power_d - asked_d(*nearest + 0.5 * exposure_s)));
    CHECK((of_left ? light.left : light.right) >= 0.999);
  }
  CHECK(wrong == 0);
  MESSAGE(seen.size(), " exposures: power within ", worst_d, " D, time within ", 1e6 * worst_s, " us");
  CHECK(worst_d <= 0.02);
  CHECK(worst_s <= 20e-6);
  return seen.size();
}

/// What light there was by now, once all of it has ended.
std::vector<Seen> light_of(Room& room) {
  const double dark_s = room.time_s();
  while (room.time_s() < dark_s + 0.2) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  return room.take_seen();
}

TEST_CASE("a LightCrafter leads: each exposure its own picture, power and shutter; a drive not seen is darkness") {
  Room room;
  DeviceRigSettings settings;
  // Of this machine's time: that of the devices goes slower where it is busy.
  settings.following_sweeps = 720;
  settings.light_goes_first_s = 0.5;
  DeviceRig rig(room.devices(), settings);
  // A machine that is too busy makes it dark, rightly; then once more. What light there is must be right each time.
  bool played = false;
  for (const double until_s = monotonic_s() + 150.0; !played && monotonic_s() < until_s;) {
    becomes_ready(rig);
    play(rig, room, 450);
    const auto doubt = rig.doubt();
    const double dark_s =
        room.time_s() - (doubt ? 0.15 : 0.01);  // what fails is noticed within its detection time and a sweep
    rig.dark(monotonic_s());
    played = hold_against(light_of(room), dark_s) >= 450;
    if (doubt) MESSAGE(describe(*doubt));
  }
  CHECK(played);

  becomes_ready(rig);
  room.lens_wired = false;
  play(rig, room, 1);
  REQUIRE(rig.doubt());  // pictures were due and the drive was not in step
  CHECK(light_of(room).empty());
}

}  // namespace
}  // namespace focalstage
