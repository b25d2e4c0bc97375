#pragma once

#include <thread>

#include "tests/devices/mcc1208/emulator/emulator.h"

namespace focalstage::mcc1208_emulator {

/// Drives an emulator's time by the wall clock for as long as it lives. Where this machine was busy, device time waits
/// with it: a step is never longer than 5 ms, and there is none, for 0.2 s at most, while a host that has claimed the
/// device got no turn to refill it. So a busy machine makes no underruns, and a host that hangs does.
class RealTime {
 public:
  explicit RealTime(Emulator& emulator);

 private:
  std::jthread thread_;
};

}  // namespace focalstage::mcc1208_emulator
