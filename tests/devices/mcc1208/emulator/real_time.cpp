#include "tests/devices/mcc1208/emulator/real_time.h"

#include <algorithm>
#include <chrono>

namespace focalstage::mcc1208_emulator {

namespace {

constexpr auto nap = std::chrono::milliseconds(1);
constexpr double longest_step_s = 0.005;
constexpr auto patience = std::chrono::milliseconds(200);

void drive(const std::stop_token& stop, Emulator& emulator) {
  using Clock = std::chrono::steady_clock;
  double device_s = emulator.time_s();
  std::optional<std::uint64_t> looks;
  auto stepped = Clock::now();
  for (auto before = stepped; !stop.stop_requested();) {
    std::this_thread::sleep_for(nap);
    const auto now = Clock::now();
    const auto looks_now = emulator.host_looks();
    if (looks_now && looks_now == looks && now - stepped < patience) {
      before = now;
      continue;
    }
    looks = looks_now;
    stepped = now;
    device_s += std::min(std::chrono::duration<double>(now - before).count(), longest_step_s);
    before = now;
    emulator.advance_to(device_s);
  }
}

}  // namespace

RealTime::RealTime(Emulator& emulator) : thread_([&emulator](const std::stop_token& stop) { drive(stop, emulator); }) {}

}  // namespace focalstage::mcc1208_emulator
