#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <thread>

namespace focalstage {

/// Tells systemd how this service does, by its datagram protocol (sd_notify(3)): that it is ready, that it stops, and
/// again and again, while `alive` holds, that it lives. Does nothing where no service manager asked for it.
class ServiceManager {
 public:
  /// Takes NOTIFY_SOCKET, WATCHDOG_USEC and WATCHDOG_PID from the environment.
  static ServiceManager from_environment();

  ServiceManager() = default;
  ServiceManager(std::string socket, std::optional<std::chrono::microseconds> watchdog)
      : socket_(std::move(socket)), watchdog_(watchdog) {}

  /// From now on `alive` is asked four times in each watchdog interval; where it is false, nothing is said.
  void ready(const std::string& status, std::function<bool()> alive);

  void stopping();

 private:
  void tell(const std::string& message) const;

  std::string socket_;
  std::optional<std::chrono::microseconds> watchdog_;
  std::jthread feeder_;
};

}  // namespace focalstage
