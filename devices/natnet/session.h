#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "devices/natnet/packets.h"
#include "devices/natnet/settings.h"
#include "devices/roles/tracker.h"

namespace focalstage {

/// One client's talk with a server, without sockets and clock: what came goes in, what is to be sent comes out. Times
/// are seconds on one clock that never goes back. For one thread at a time.
class NatNetSession {
 public:
  NatNetSession(const NatNetSettings& settings, double now_s);

  /// A datagram from the server.
  void take(std::span<const std::uint8_t> bytes, double now_s);

  /// What is to be sent to the server's command port now; to be asked a few times per `ping_s`.
  std::vector<NatNetBytes> due(double now_s);

  std::shared_ptr<const TrackedFrame> newest() const { return newest_; }
  TrackerState state(double now_s) const;

 private:
  void take_server(std::span<const std::uint8_t> payload);
  void take_names(std::span<const std::uint8_t> payload);
  void take_frame(std::span<const std::uint8_t> payload, double now_s);
  bool fresh(double now_s) const;
  bool overtaken(const NatNetFrame& frame) const;
  std::string where() const;
  std::optional<Fault> seeking_fault(double now_s) const;

  NatNetSettings settings_;
  double begun_s_;
  std::optional<NatNetServer> server_;
  std::map<std::int32_t, std::string> names_;
  bool names_known_ = false;
  std::optional<double> pinged_s_;
  std::optional<double> asked_names_s_;
  std::optional<double> kept_alive_s_;
  std::shared_ptr<const TrackedFrame> newest_;
  std::int64_t newest_number_ = 0;
  std::uint64_t newest_ticks_ = 0;
  TrackerState counts_;
};

}  // namespace focalstage
