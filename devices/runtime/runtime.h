#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "devices/runtime/rig_thread.h"
#include "io/rig_config/rig_config.h"

namespace focalstage {

struct RuntimeOptions {
  std::string listen = "127.0.0.1:50371";  ///< loopback only; port 0 picks one
  std::filesystem::path store;
  RigThreadSettings rig;
  std::chrono::milliseconds lease{10'000};
  NetworkConfig network;
  std::vector<ClientConfig> clients;  ///< who may do what, where the network has certificates
};

/// The rig daemon: a store of shows, a rig that plays them, and the service through which editors reach both.
class Runtime {
 public:
  /// "runtime.not-loopback", "runtime.address-in-use", "runtime.address", "store.in-use", "file.unwritable".
  static Result<Runtime> start(const RuntimeOptions& options);

  Runtime(Runtime&&) noexcept;
  Runtime& operator=(Runtime&&) noexcept;
  ~Runtime();  ///< dark within a sweep, then gone

  /// Where it listens, with the port it got.
  const std::string& address() const;

 private:
  struct State;
  explicit Runtime(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

/// Host and port of an address that only this machine can reach; else a fault that says so.
Result<std::string> loopback_address(const std::string& listen);

}  // namespace focalstage
