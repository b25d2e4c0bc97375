#pragma once

#include <memory>
#include <optional>
#include <utility>

#include "devices/rig/leader.h"
#include "tests/devices/rig/fake_devices.h"

namespace focalstage::test {

/// A player's hand on a leader: sweeps six ahead, the first `settle` in the dark, each lit one with a code of its own.
/// `Room` has devices and their time.
template <class Room, class Led>
struct PlayersHand {
  static constexpr double period_s = 1.0 / 60.0;  ///< that shows are made for

  Room room;
  RigDevices devices = devices_of(room);
  Led leader{devices, {}};
  std::shared_ptr<const Score> now;
  int settle = 0;
  double next_s = 0.1;
  int code = 0;
  bool handing = true;
  std::optional<Fault> fault;

  PlayersHand(std::shared_ptr<const Score> first, int dark_sweeps) : now(std::move(first)), settle(dark_sweeps) {}

  void run(double seconds) {
    const double end_s = room.now_s + seconds;
    while (room.now_s < end_s && !fault) {
      while (handing && next_s < room.now_s + 6 * period_s) hand();
      const Status stepped = leader.step(room.now_s);
      if (!stepped) fault = stepped.fault();
      room.run_until(room.now_s + 0.001);
    }
  }

  void hand() {
    HandedSweep sweep{next_s, now, {}};
    if (settle > 0) {
      --settle;
    } else {
      code = code % 250 + 1;
      for (std::size_t i = 0; i < now->trigger_s.size(); ++i) sweep.pictures.push_back(picture(code));
    }
    leader.hand_over(std::move(sweep));
    next_s = edge_near_s(devices, next_s + period_s);
  }
};

}  // namespace focalstage::test
