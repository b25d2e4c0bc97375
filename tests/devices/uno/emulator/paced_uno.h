#pragma once

#include <mutex>
#include <string>
#include <thread>
#include <utility>

#include "tests/devices/uno/emulator/emulator.h"

namespace focalstage::uno_emulator {

struct Pace {
  double sync_hz = 60.0;   ///< edges that it gets; 0: none
  double clock_ppm = 0.0;  ///< how much faster the chip's clock runs than it should
  int stray_every = 0;     ///< after so many edges comes one that should not; 0: never
  bool remembers = true;   ///< edges and pins, for ever
};

/// An emulated board that a thread of its own drives by the wall's time. Where the machine is too slow, its time is
/// late rather than hurried.
class PacedUno {
 public:
  PacedUno(const Options& options, const Pace& pace);

  /// Does this with the emulator while its time stands still.
  template <class Do>
  auto with(Do&& what) {
    const std::lock_guard lock(mutex_);
    return std::forward<Do>(what)(emulator_);
  }
  std::string path() {
    return with([](UnoEmulator& uno) { return uno.path(); });
  }
  void misbehave(const Misbehaviour& how) {
    with([&](UnoEmulator& uno) { uno.misbehave(how); });
  }
  /// From now on.
  void sync(double hz);

 private:
  void run(const std::stop_token& stop);
  void add_stray();
  double cycles_per_s() const { return 16e6 * (1.0 + 1e-6 * pace_.clock_ppm); }

  Pace pace_;
  std::mutex mutex_;
  UnoEmulator emulator_;
  std::size_t strays_at_ = 0;
  std::jthread thread_;  ///< last: it uses the others
};

}  // namespace focalstage::uno_emulator
