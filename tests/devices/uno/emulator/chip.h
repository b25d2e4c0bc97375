#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

struct avr_t;
struct avr_irq_t;
struct avr_uart_t;
struct avr_watchdog_t;

namespace focalstage::uno_emulator {

/// Of the chip's own clock: 16 million to its second, however long that is.
using Cycle = std::uint64_t;

/// A pin's change, and when it happened.
struct PinChange {
  Cycle at = 0;
  bool high = false;
};

/// The firmware on a simulated ATmega328P: sync edges and serial bytes go in at exact cycles, changes of pins come out
/// with theirs. One thread at a time.
class Chip {
 public:
  explicit Chip(const std::string& firmware_elf);
  ~Chip();
  Chip(const Chip&) = delete;
  Chip& operator=(const Chip&) = delete;

  Cycle now() const;
  /// To that cycle; at most one instruction beyond, also asleep.
  void run_until(Cycle at);
  void run_for(Cycle cycles) { run_until(now() + cycles); }

  /// One sync edge at that cycle; what is over: at once. As many as wanted, in any order.
  void edge_at(Cycle at);
  /// Sync edges every `cycles`, the first after one of these; 0: no more. Kept to fractions of a cycle.
  void sync_every(double cycles);

  /// One edge of the lens drive's at D2, at that cycle, as `edge_at`.
  void lens_edge_at(Cycle at);

  /// What stands at analogue input 0 to 5, as a share of 5 V, at a cycle: asked for each conversion, of the cycle in
  /// which a real converter holds its input.
  void set_analogue(std::function<double(int input, double cycle)> share) { analogue_ = std::move(share); }

  /// Queues bytes as they are; they go in back to back, as fast as the board's USB bridge says them (10 bits of 136
  /// cycles each).
  void send_raw(std::string_view bytes);
  std::size_t waiting_bytes() const { return to_chip_.size(); }
  bool sent_all() const { return to_chip_.empty(); }
  /// What the chip said since this was asked last.
  std::string take_bytes();

  /// As by its reset button, or by a host that opens the port.
  void reset();
  /// Replaces the instruction at which the main loop now stands by a jump to itself, until the chip resets.
  void hang_main_loop();
  /// The watchdog takes so many times its nominal 2048 cycles of 128 kHz, and their multiples.
  void set_watchdog_slowness(double times) { watchdog_slowness_ = times; }
  /// Empties the lists below, which only grow.
  void forget();

  std::vector<Cycle> edges;
  std::vector<PinChange> trigger;
  std::vector<PinChange> left;
  std::vector<PinChange> right;
  std::vector<PinChange> lamp;
  bool trigger_high = false;
  bool left_high = false;
  bool right_high = false;
  bool lamp_high = false;
  int overruns = 0;  ///< bytes that a real chip would have lost: its receiver keeps two and the one that is coming in

 private:
  static std::uint64_t halt(avr_t* avr, std::uint64_t when, void* self);
  static std::uint64_t next_edge(avr_t* avr, std::uint64_t when, void* self);
  static std::uint64_t end_edge(avr_t* avr, std::uint64_t when, void* self);
  static std::uint64_t single_edge(avr_t* avr, std::uint64_t when, void* self);
  static std::uint64_t lens_edge(avr_t* avr, std::uint64_t when, void* self);
  static std::uint64_t end_lens_edge(avr_t* avr, std::uint64_t when, void* self);
  static void converts(avr_irq_t* irq, std::uint32_t value, void* self);
  static std::uint64_t converted(avr_t* avr, std::uint64_t when, void* self);
  static std::uint64_t next_byte(avr_t* avr, std::uint64_t when, void* self);
  static void said(avr_irq_t* irq, std::uint32_t value, void* self);
  static void trigger_changed(avr_irq_t* irq, std::uint32_t value, void* self);
  static void left_changed(avr_irq_t* irq, std::uint32_t value, void* self);
  static void right_changed(avr_irq_t* irq, std::uint32_t value, void* self);
  static void lamp_changed(avr_irq_t* irq, std::uint32_t value, void* self);
  static void was_reset(avr_t* avr);
  void swap_hang();
  void listen();
  void mend_timing();
  void receive(std::uint8_t byte);
  void raise_edge();
  void set_lens_pin(bool high);
  void changed(bool& high, std::vector<PinChange>& changes, std::uint32_t value);

  avr_t* avr_ = nullptr;
  avr_uart_t* uart_ = nullptr;
  avr_watchdog_t* watchdog_ = nullptr;
  void (*own_reset_)(avr_t*) = nullptr;  ///< simavr's
  Cycle halt_at_ = 0;
  double period_cycles_ = 0.0;
  double next_edge_ = 0.0;
  std::multiset<Cycle> single_edges_;
  std::multiset<Cycle> lens_edges_;
  std::deque<char> to_chip_;
  bool byte_is_due_ = false;
  double watchdog_slowness_ = 1.0;
  std::optional<std::uint32_t> hung_at_;
  std::array<std::uint8_t, 2> hang_{0xFF, 0xCF};
  std::string bytes_;
  std::function<double(int, double)> analogue_;
  Cycle first_conversion_ = 0;  ///< of those that follow each other without a pause
  Cycle newest_conversion_ = 0;
  unsigned conversions_ = 0;
  std::uint32_t mux_ = 0;
};

}  // namespace focalstage::uno_emulator
