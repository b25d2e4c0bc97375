#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <thread>

#include "core/base/result.h"

namespace focalstage {

/// Stands at the port: lets so many connections in at a time, in all and from one address, and closes the others at
/// once. The server behind it has no such bound of its own.
class Doorman {
 public:
  struct Settings {
    int connections_max = 64;
    int connections_per_peer_max = 32;
  };

  /// Takes over `socket`, which listens. `let_in` gets each connection to keep.
  Doorman(int socket, const Settings& settings, std::function<void(int connection)> let_in);
  ~Doorman();

  int connections() const { return connections_; }
  std::uint64_t turned_away() const { return turned_away_; }

 private:
  void run(const std::stop_token& stop);
  void accept_one();
  void leave(int watched);

  int socket_;
  Settings settings_;
  std::function<void(int)> let_in_;
  int events_;                         ///< epoll
  std::map<int, std::string> inside_;  ///< our copy of each connection's descriptor, and its peer
  std::map<std::string, int> of_a_peer_;
  std::atomic<int> connections_ = 0;
  std::atomic<std::uint64_t> turned_away_ = 0;
  std::jthread thread_;
};

}  // namespace focalstage
