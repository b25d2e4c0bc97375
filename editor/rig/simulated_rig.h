#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>

#include "core/base/result.h"

namespace focalstage {

/// A runtime with a simulated rig, as a process of its own that ends with this object, and with this program however
/// that ends.
class SimulatedRig {
 public:
  /// Starts `focalstage-runtime` beside this program on a free port. The calling thread must outlive it: the system
  /// ends the process with the thread. Faults "program.missing", "rig.start".
  static Result<SimulatedRig> start(const std::filesystem::path& store);

  SimulatedRig(SimulatedRig&& other) noexcept;
  SimulatedRig& operator=(SimulatedRig&& other) noexcept;
  ~SimulatedRig();

  const std::string& address() const { return address_; }
  bool running();

 private:
  SimulatedRig(pid_t process, std::string address) : process_(process), address_(std::move(address)) {}
  void stop();

  pid_t process_ = -1;
  std::string address_;
};

}  // namespace focalstage
