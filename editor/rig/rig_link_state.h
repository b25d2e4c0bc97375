#pragma once

#include <chrono>
#include <condition_variable>
#include <deque>
#include <filesystem>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>

#include "editor/rig/live_stream.h"
#include "editor/rig/rig_link.h"
#include "editor/rig/simulated_rig.h"
#include "io/protocol/client.h"

namespace focalstage {

/// What works behind a RigLink: one thread that does what was asked, in order; one that watches the rig; one for
/// blackouts.
struct RigLink::State {
  std::function<void()> wake;
  std::filesystem::path folder;

  mutable std::mutex mutex;
  std::condition_variable arrived;
  RigStatus status;
  std::deque<std::function<void()>> orders;  ///< for the worker, in order
  std::stop_source push_stop;
  bool ending = false;
  LiveWish live_wish;
  std::chrono::steady_clock::time_point live_again{};  ///< not before this, after it could not begin

  LiveStream stream;                      ///< the worker's
  std::optional<SimulatedRig> simulated;  ///< the worker's
  std::optional<RigClient> client;        ///< the worker's; holds the rig

  std::condition_variable urgent;  ///< `blackout_wanted` or `ending` was set
  bool blackout_wanted = false;

  std::jthread watcher;  ///< started and joined by the worker
  std::thread worker;
  std::thread lifeguard;  ///< for blackouts alone: they wait for nothing that was asked before

  void run();
  void stand_by();
  void order(std::function<void()> what);
  void connect_to(const std::string& address, bool own);
  void leave();
  void begin_simulated();
  void revive();
  void watch(const std::string& address, std::stop_token stop);
  void tell(const Status& done);
  void stay_live();
  void push(const MakeShow& make, std::stop_token stop);

  template <class Change>
  void publish(Change&& change) {
    {
      const std::lock_guard lock(mutex);
      change(status);
    }
    wake();
  }
};

}  // namespace focalstage
