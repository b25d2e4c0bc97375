#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

struct avr_t;
struct avr_irq_t;

namespace focalstage::test {

using Cycle = std::uint64_t;

/// A pin's change, and the cycle of the board's own clock at which it happened.
struct PinChange {
  Cycle at = 0;
  bool high = false;
};

/// The firmware on a simulated ATmega328P: sync edges and serial bytes go in at exact cycles, changes of pins come out
/// with theirs.
class Board {
 public:
  Board();
  ~Board();
  Board(const Board&) = delete;
  Board& operator=(const Board&) = delete;

  Cycle now() const;
  void run_for(Cycle cycles);

  /// Sync edges every `cycles`, the first after one of these; 0: no more. Kept to fractions of a cycle.
  void sync_every(double cycles);
  /// One edge more, beside the others, this many cycles from now.
  void stray_edge_in(Cycle cycles);

  /// Queues bytes as they are; they go in back to back at 115200 baud.
  void send_raw(std::string_view bytes);
  /// Queues a request with number and checksum.
  void send(std::string_view body);
  bool sent_all() const { return to_board_.empty(); }
  /// Sends, and waits for the answer to it: what follows the number. Empty: none within 50 ms.
  std::string ask(std::string_view body);
  /// The lines the board said, without their checksums, which were good.
  std::vector<std::string> take_lines();

  /// Replaces the instruction at which the main loop now stands by a jump to itself, until the chip resets.
  void hang_main_loop();

  std::vector<Cycle> edges;
  std::vector<PinChange> trigger;
  std::vector<PinChange> left;
  std::vector<PinChange> right;
  bool trigger_high = false;
  bool left_high = false;
  bool right_high = false;
  int damaged_lines = 0;

 private:
  static std::uint64_t next_edge(avr_t* avr, std::uint64_t when, void* self);
  static std::uint64_t end_edge(avr_t* avr, std::uint64_t when, void* self);
  static std::uint64_t stray_edge(avr_t* avr, std::uint64_t when, void* self);
  static std::uint64_t next_byte(avr_t* avr, std::uint64_t when, void* self);
  static void heard(avr_irq_t* irq, std::uint32_t value, void* self);
  static void trigger_changed(avr_irq_t* irq, std::uint32_t value, void* self);
  static void left_changed(avr_irq_t* irq, std::uint32_t value, void* self);
  static void right_changed(avr_irq_t* irq, std::uint32_t value, void* self);
  void raise_edge();
  void changed(bool& high, std::vector<PinChange>& changes, std::uint32_t value);
  void take_line();

  avr_t* avr_ = nullptr;
  double period_cycles_ = 0.0;
  double next_edge_ = 0.0;
  std::deque<char> to_board_;
  bool byte_is_due_ = false;
  std::string said_;
  std::vector<std::string> lines_;
  int sequence_ = 0;
};

}  // namespace focalstage::test
