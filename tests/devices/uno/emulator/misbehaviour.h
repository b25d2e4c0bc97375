#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <string>

#include "tests/devices/uno/emulator/chip.h"

namespace focalstage::uno_emulator {

/// What the board and its line do wrong. "One in so many" counts from the moment it is set; 0: none.
struct Misbehaviour {
  bool silent = false;                                     ///< nothing that it says arrives
  bool deaf = false;                                       ///< nothing that it is told arrives
  int damage_every = 0;                                    ///< one line in so many that it says has a wrong letter
  int damage_requests_every = 0;                           ///< and that it is told
  int lose_every = 0;                                      ///< one line in so many that it says does not arrive
  int wrong_number_every = 0;                              ///< one answer in so many has another request's number
  bool stale = false;                                      ///< before each line the one before it comes again
  bool refuse = false;                                     ///< every OK is an ERR 3
  double delay_s = 0.0;                                    ///< its lines arrive so much later
  bool dribble = false;                                    ///< what it says arrives byte by byte
  std::optional<std::size_t> unplug_after = std::nullopt;  ///< so many bytes that a host was told, the port is gone
};

/// The way from the chip to the host, and back, as the misbehaviour has it.
class Line {
 public:
  void misbehave(const Misbehaviour& how);
  const Misbehaviour& how() const { return how_; }

  /// What the chip said at that cycle.
  void say(const std::string& bytes, Cycle now);
  /// What of it arrives by now.
  std::string arrived(Cycle now);
  /// What arrives of what the host said.
  std::string told(const std::string& bytes);
  void clear();

 private:
  struct Arrival {
    Cycle at;
    std::string bytes;
  };
  void say_line(const std::string& line, Cycle now);
  std::string spoilt(const std::string& line);

  Misbehaviour how_;
  std::string saying_;
  std::string before_;
  std::deque<Arrival> arrivals_;
  int lines_ = 0;
  int requests_ = 0;
};

}  // namespace focalstage::uno_emulator
