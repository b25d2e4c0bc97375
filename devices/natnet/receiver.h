#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <thread>
#include <vector>

#include "devices/natnet/session.h"
#include "devices/natnet/settings.h"
#include "devices/natnet/udp_socket.h"
#include "devices/roles/tracker.h"

namespace focalstage {

/// A NatNet server as a tracker: sockets and a thread around a session.
class NatNetReceiver final : public Tracker {
 public:
  explicit NatNetReceiver(const NatNetSettings& settings) : settings_(settings) {}
  ~NatNetReceiver() override { stop(); }

  /// Faults: "natnet.address", "natnet.socket". Starting what runs changes nothing.
  Status start() override;
  void stop() override;

  std::shared_ptr<const TrackedFrame> newest() const override;
  TrackerState state() const override;

 private:
  Status open();
  void run(const std::stop_token& stop);
  void drain(const UdpSocket& socket, std::vector<std::uint8_t>& buffer);
  void send_due();

  NatNetSettings settings_;
  std::mutex starting_;  ///< start and stop, one after the other
  UdpAddress server_;
  std::vector<UdpSocket> sockets_;  ///< the first is for commands; frames are read from all alike
  mutable std::mutex mutex_;        ///< the session, for as long as a message is read
  std::optional<NatNetSession> session_;
  std::jthread thread_;
};

}  // namespace focalstage
