#pragma once

#include <functional>
#include <memory>
#include <string>
#include <thread>

#include "core/base/result.h"
#include "devices/runtime/desk_command.h"
#include "devices/runtime/rate_limit.h"
#include "io/rig_config/rig_config.h"

namespace focalstage {

/// A control desk's way in: OSC over UDP, from this machine and the listed peers, 50 commands a second at most and
/// blackout as often as it comes. Nothing is answered; refusals are in the log.
class OscDesk {
 public:
  /// `obey` is called in the desk's own thread. "runtime.address", "runtime.address-in-use".
  static Result<std::unique_ptr<OscDesk>> start(const OscConfig& config, std::function<void(const DeskCommand&)> obey);
  ~OscDesk();

  const std::string& address() const { return address_; }

 private:
  OscDesk(OscConfig config, std::function<void(const DeskCommand&)> obey, int socket, std::string address);
  void run(const std::stop_token& stop);
  bool receive();

  OscConfig config_;
  std::function<void(const DeskCommand&)> obey_;
  int socket_;
  std::string address_;
  RateLimit commands_{50.0, 100.0};
  RateLimit remarks_{1.0, 5.0};  ///< in the log, of those who may not
  std::jthread thread_;
};

}  // namespace focalstage
