#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "devices/catalog/device_drivers.h"
#include "devices/runtime/address.h"
#include "devices/runtime/desk_command.h"
#include "devices/runtime/figures.h"
#include "devices/runtime/live_tracking.h"
#include "devices/runtime/rig_thread.h"
#include "io/rig_config/rig_config.h"

namespace focalstage {

struct RuntimeOptions {
  std::string listen = "127.0.0.1:50371";  ///< loopback only; port 0 picks one
  std::filesystem::path store;
  RigThreadSettings rig;
  std::chrono::milliseconds lease{10'000};
  TrackerSetup tracker;
  NetworkConfig network;
  DeviceDrivers drivers;              ///< whose devices it lists and identifies
  std::vector<ClientConfig> clients;  ///< who may do what, where the network has certificates
};

/// The rig daemon: a store of shows, a rig that plays them, and the service through which editors reach both.
class Runtime {
 public:
  /// "runtime.not-loopback", "runtime.address-in-use", "runtime.address", "store.in-use", "file.unwritable",
  /// "credentials.*", and those of the tracker.
  static Result<Runtime> start(const RuntimeOptions& options);

  Runtime(Runtime&&) noexcept;
  Runtime& operator=(Runtime&&) noexcept;
  ~Runtime();  ///< dark within a sweep, then gone

  /// Where it listens, with the port it got.
  const std::string& address() const;

  /// What it counts. Asks for the rig's lock, as every look at the state does.
  RuntimeFigures figures() const;

  /// What a control desk says: "rig.held" while an editor holds the rig, unless `despite_lease`; blackout always.
  Status operate(const DeskCommand& command, bool despite_lease) const;

  /// The thread that keeps the rig's time went round in the last two seconds. Waits for nothing.
  bool keeps_time() const;

 private:
  struct State;
  explicit Runtime(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace focalstage
