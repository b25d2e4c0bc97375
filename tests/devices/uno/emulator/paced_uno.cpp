#include "tests/devices/uno/emulator/paced_uno.h"

#include <algorithm>
#include <chrono>

namespace focalstage::uno_emulator {

namespace {

using WallClock = std::chrono::steady_clock;

constexpr auto step = std::chrono::microseconds(500);
constexpr double most_behind_s = 0.01;

}  // namespace

PacedUno::PacedUno(const Options& options, const Pace& pace) : pace_(pace), emulator_(options) {
  sync(pace.sync_hz);
  thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
}

void PacedUno::sync(double hz) {
  with([&](UnoEmulator& uno) { uno.chip().sync_every(hz > 0.0 ? cycles_per_s() / hz : 0.0); });
}

void PacedUno::run(const std::stop_token& stop) {
  WallClock::time_point wall = WallClock::now();
  double due = 0.0;
  while (!stop.stop_requested()) {
    std::this_thread::sleep_for(step);
    const WallClock::time_point now = WallClock::now();
    const std::lock_guard lock(mutex_);
    due += std::chrono::duration<double>(now - wall).count() * cycles_per_s();
    wall = now;
    Chip& chip = emulator_.chip();
    due = std::min(due, static_cast<double>(chip.now()) + most_behind_s * cycles_per_s());
    emulator_.run_until(static_cast<Cycle>(due));
    add_stray();
    if (!pace_.remembers) chip.forget();
  }
}

void PacedUno::add_stray() {
  Chip& chip = emulator_.chip();
  if (pace_.stray_every <= 0 || pace_.sync_hz <= 0.0) return;
  if (!pace_.remembers) strays_at_ += chip.edges.size();
  const std::size_t seen = pace_.remembers ? chip.edges.size() - strays_at_ : strays_at_;
  if (seen < static_cast<std::size_t>(pace_.stray_every)) return;
  strays_at_ = pace_.remembers ? chip.edges.size() : 0;
  chip.edge_at(chip.now() + static_cast<Cycle>(0.4 * cycles_per_s() / pace_.sync_hz));
}

}  // namespace focalstage::uno_emulator
