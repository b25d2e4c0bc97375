#include "devices/input/spacemouse.h"

#include <hidapi/hidapi.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <mutex>
#include <thread>
#include <utility>

#include "devices/input/packets.h"
#include "devices/input/probe.h"
#include "devices/roles/clock.h"

namespace focalstage {

namespace {

// How long a wish to stop may wait.
constexpr int tick_ms = 20;
constexpr double blink_s = 0.15;
constexpr int blinks = 6;  // on and off; ends with on, as it was

struct Closer {
  void operator()(hid_device* device) const { hid_close(device); }
};
using HidDevice = std::unique_ptr<hid_device, Closer>;

class SpaceMouse final : public MotionInput {
 public:
  explicit SpaceMouse(SpaceMouseSettings settings) : settings_(std::move(settings)), axes_(settings_) {}
  ~SpaceMouse() override { close(); }

  Status open() override {
    const std::lock_guard opening(opening_);
    if (state().phase == DevicePhase::ready) return {};
    thread_ = {};  // of what was lost
    const std::vector<DeviceId> all = probe_spacemouse();
    const auto found = std::ranges::find_if(
        all, [&](const DeviceId& id) { return settings_.serial.empty() || id.serial == settings_.serial; });
    if (found == all.end()) {
      return lose({"input.absent", "SpaceMouse", all.empty() ? "none is plugged in" : "the one there is another one",
                   "plug it in, or change its serial in the settings"});
    }
    HidDevice device(hid_open_path(found->address.c_str()));
    if (!device) {
      return lose({"input.permission", found->address, "it cannot be opened",
                   "install the udev rule of devices/input/README.md and plug it in again"});
    }
    {
      const std::lock_guard lock(mutex_);
      id_ = *found;
      axes_ = SpaceMouseAxes(settings_);
      state_ = {DevicePhase::ready, {}, monotonic_s(), {}};
    }
    thread_ = std::jthread([this, kept = std::move(device)](const std::stop_token& stop) { run(stop, kept.get()); });
    return {};
  }

  void close() override {
    const std::lock_guard opening(opening_);
    thread_ = {};
    const std::lock_guard lock(mutex_);
    state_ = {};
    axes_ = SpaceMouseAxes(settings_);
  }

  DeviceId id() const override {
    const std::lock_guard lock(mutex_);
    return id_;
  }

  DeviceState state() const override {
    const std::lock_guard lock(mutex_);
    return state_;
  }

  Status identify() override {
    if (state().phase != DevicePhase::ready) return Fault{"input.closed", "SpaceMouse", "it is not open", "plug it in"};
    to_blink_ = blinks;
    return {};
  }

  Deflection deflection() const override {
    const std::lock_guard lock(mutex_);
    return axes_.deflection(monotonic_s());
  }

 private:
  void run(const std::stop_token& stop, hid_device* device) {
    double blinked_s = 0.0;
    while (!stop.stop_requested()) {
      if (to_blink_ > 0 && monotonic_s() >= blinked_s + blink_s) {
        blinked_s = monotonic_s();
        set_lamp(device, --to_blink_ % 2 == 0);
      }
      std::array<std::uint8_t, 64> bytes{};
      const int got = hid_read_timeout(device, bytes.data(), bytes.size(), tick_ms);
      if (got < 0) {
        (void)lose({"input.lost", id().model, "it does not answer any more", "plug it in again"});
        return;
      }
      const auto report = spacemouse_report(std::span(bytes).first(static_cast<std::size_t>(got)));
      const std::lock_guard lock(mutex_);
      if (report) axes_.take(*report, monotonic_s());
      state_.heard_s = monotonic_s();  // a device at rest says nothing, and is there
    }
  }

  static void set_lamp(hid_device* device, bool on) {
    const std::array<std::uint8_t, 2> report{4, static_cast<std::uint8_t>(on ? 1 : 0)};
    (void)hid_write(device, report.data(), report.size());
  }

  Status lose(const Fault& fault) {
    const std::lock_guard lock(mutex_);
    axes_ = SpaceMouseAxes(settings_);
    state_.phase = DevicePhase::lost;
    state_.fault = fault;
    return fault;
  }

  SpaceMouseSettings settings_;
  std::mutex opening_;        ///< open and close, one after the other
  mutable std::mutex mutex_;  ///< what follows; never held during a transfer
  DeviceId id_{"input", "SpaceMouse", "", ""};
  DeviceState state_;
  SpaceMouseAxes axes_;
  std::atomic<int> to_blink_ = 0;
  std::jthread thread_;
};

}  // namespace

std::unique_ptr<MotionInput> make_spacemouse(const SpaceMouseSettings& settings) {
  return std::make_unique<SpaceMouse>(settings);
}

}  // namespace focalstage
