#pragma once

#include <doctest/doctest.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <memory>
#include <string>
#include <thread>

#include "devices/roles/clock.h"
#include "devices/uno/uno.h"
#include "tests/devices/uno/emulator/paced_uno.h"

namespace focalstage::test {

/// An emulated board, and the driver that is told of it by a link, which leads wherever it is plugged in.
struct PluggedIn {
  explicit PluggedIn(const uno_emulator::Pace& pace = {}, uno_emulator::Options options = {}, UnoSettings wanted = {})
      : settings(std::move(wanted)), board(with_firmware(options), pace) {
    if (settings.path.empty()) {
      const auto name = "focalstage-uno-" + std::to_string(::getpid()) + "-" + std::to_string(++count);
      settings.path = (std::filesystem::temp_directory_path() / name).string();
    }
    board.with([&](uno_emulator::UnoEmulator& emulator) { emulator.set_link(settings.path); });
    uno = make_uno(settings);
  }

  static uno_emulator::Options with_firmware(uno_emulator::Options options) {
    options.firmware_elf = FOCALSTAGE_FIRMWARE_ELF;
    return options;
  }

  template <class Done>
  static bool soon(Done&& done, double within_s = 3.0) {
    for (const double end_s = monotonic_s() + within_s; !done();) {
      if (monotonic_s() > end_s) return false;
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    return true;
  }
  bool comes_to(DevicePhase phase) const {
    if (soon([&] { return uno->state().phase == phase; })) return true;
    const DeviceState state = uno->state();
    MESSAGE(name_of(state.phase) << ": " << (state.fault ? describe(*state.fault) : "no fault"));
    return false;
  }
  /// A crowded machine may take longer than `dark` waits, and says so.
  bool made_dark() const {
    return soon([&] { return uno->dark(); });
  }
  bool is_synced() const {
    return soon([&] { return uno->report().period_s.has_value(); });
  }
  uno_emulator::Cycle now() {
    return board.with([](uno_emulator::UnoEmulator& emulator) { return emulator.chip().now(); });
  }
  std::size_t triggers() {
    return board.with([](uno_emulator::UnoEmulator& emulator) { return emulator.chip().trigger.size(); });
  }

  static inline int count = 0;
  UnoSettings settings;
  uno_emulator::PacedUno board;
  std::unique_ptr<TriggerBoard> uno;
};

/// In words: a fault, or "done".
inline std::string outcome_of(const Status& status) { return status ? "done" : describe(status.fault()); }

inline UnoSettings quick_boot() {
  UnoSettings settings;
  settings.boot_s = 0.3;
  return settings;
}

/// Three triggers, and the shutters in turn.
inline BoardTable some_table() {
  BoardTable table;
  table.period_s = 1.0 / 60.0;
  table.trigger_s = {1.25e-3, 4e-3, 12e-3};
  table.shutter.left = ShutterWindow{15.2e-3, 15.2e-3 + 8e-3};
  table.shutter.right = ShutterWindow{7e-3, 15e-3};
  return table;
}

inline void wait_s(double seconds) { sleep_until(monotonic_s() + seconds); }

}  // namespace focalstage::test
