#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tests/devices/natnet/emulator/server_bytes.h"

namespace focalstage::natnet_emulator {

/// What goes wrong. Each may be changed while the server runs.
struct Misbehaviour {
  bool silent = false;         ///< answers requests but streams nothing
  bool deaf = false;           ///< answers nothing and streams nothing
  int drop_every = 0;          ///< each so many frames, one is not sent; 0: none
  bool swap_pairs = false;     ///< the second of each two frames is sent first
  int cut_bytes = 0;           ///< so many are missing at the end of each frame
  bool tracking_lost = false;  ///< bit 0 of the parameter is 0, the pose stays
  bool nan_pose = false;
};

struct Options {
  Dialect dialect;
  std::string address = "127.0.0.1";
  std::uint16_t command_port = 0;    ///< 0: any
  std::string group;                 ///< empty: unicast to the last client that spoke
  std::uint16_t data_port = 1511;    ///< multicast
  bool stream_to_data_port = false;  ///< unicast to the client's `data_port` and not to where it spoke from
  double frames_per_s = 240.0;
  double patience_s = 3.0;  ///< unicast: without a word from the client for so long, it is forgotten
};

/// What the server did.
struct Record {
  int pings = 0;
  int model_requests = 0;
  int keep_alives = 0;
  int unknown = 0;
  int frames_made = 0;
  int frames_sent = 0;
  std::optional<double> last_sent_s;  ///< on the steady clock
};

/// A NatNet server in a thread of its own. Its bodies: 7 "Head", going round, and 8 "Box", at rest.
class Server {
 public:
  static constexpr std::uint64_t ticks_per_s = 10000000;
  static constexpr double latency_s = 0.004;

  /// Null if its port cannot be had.
  static std::unique_ptr<Server> start(const Options& options);
  virtual ~Server() = default;

  virtual std::uint16_t command_port() const = 0;
  virtual void misbehave(const Misbehaviour& how) = 0;
  virtual void speak(const Dialect& dialect) = 0;  ///< as another server at the same address
  virtual Record record() const = 0;
};

/// Where body 7 is at a frame's timestamp, metres.
std::array<double, 3> head_position(double timestamp_s);

}  // namespace focalstage::natnet_emulator
