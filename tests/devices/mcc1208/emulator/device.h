#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace focalstage::mcc1208_emulator {

using Bytes = std::vector<std::uint8_t>;

/// The eight bytes of a control request.
struct Setup {
  std::uint8_t type = 0;
  std::uint8_t request = 0;
  std::uint16_t value = 0;
  std::uint16_t index = 0;
  std::uint16_t length = 0;
};

struct Request {
  Setup setup;
  Bytes data;  ///< that came with it
};

enum class Reply { ok, stall, none };
struct Answer {
  Reply reply = Reply::ok;
  Bytes data;
};

/// A change of the analogue outputs, or one scan whether it changed them or not.
struct Output {
  double time_s = 0.0;                ///< device time
  std::optional<std::uint64_t> scan;  ///< counted from the scan's start; none: set by AOUT
  std::array<int, 2> codes{};
};

struct Options {
  std::string serial = "01D0F1A2";
  std::size_t fifo_bytes = 4096;  ///< the sheet does not know the real one
  double crystal_ppm = 0.0;       ///< by which its clock is fast
};

/// What goes wrong. Each may be changed at any time.
struct Misbehaviour {
  bool starve = false;                       ///< takes no more bulk bytes: an underrun follows
  bool silent = false;                       ///< answers no request and takes no bulk bytes
  std::vector<std::uint8_t> stalled;         ///< these requests are refused
  std::uint16_t status_bits = 0;             ///< set in every status
  double delay_s = 0.0;                      ///< wall time before each answer
  std::optional<std::size_t> short_write;    ///< the next bulk transfer ends after so many bytes, as if it were whole
  std::optional<std::uint64_t> cut_at_byte;  ///< unplugged once so many bulk bytes were taken since plugging in
  std::optional<std::uint64_t> cut_at_request;  ///< unplugged before it answers the request of this number, from 0
};

/// The USB-1208FS-Plus of hardware.md section 3 without its USB: requests in, packets in, scans out. Time is its own
/// and stands still unless it is told.
class Device {
 public:
  /// The host's next packet, 64 bytes at most; 0 where there is none.
  using Packets = std::function<std::size_t(std::span<std::uint8_t>)>;

  explicit Device(const Options& options) : options_(options) {}

  void power_on();
  Answer control(const Setup& setup, std::span<const std::uint8_t> data, const Misbehaviour& how);
  void take(const Packets& packets);
  void advance_to(double time_s, const Packets& packets);
  void clear_halt() { halted_ = false; }

  double time_s() const { return now_s_; }
  bool halted() const { return halted_; }  ///< the bulk endpoint stalls
  std::array<int, 2> codes() const { return codes_; }
  /// Pins of a DIO port that is an output; none for an input.
  std::optional<std::uint8_t> pins(int port) const;
  std::vector<Output> outputs_since();  ///< since it was last asked
  const std::vector<Request>& requests() const { return requests_; }

 private:
  Answer answer(const Setup& setup, std::span<const std::uint8_t> data, const Misbehaviour& how);
  Answer answer_port(const Setup& setup, bool in);
  Answer answer_output(const Setup& setup, bool in);
  bool start_scan(std::span<const std::uint8_t> data);
  bool play_one();
  void underrun();
  std::size_t scan_bytes() const;
  double scan_s() const;

  Options options_;
  double now_s_ = 0.0;
  std::array<int, 2> codes_{};
  std::array<std::uint8_t, 2> latch_{};
  std::array<bool, 2> input_{true, true};
  std::deque<std::uint8_t> fifo_;
  bool running_ = false;
  bool underrun_ = false;
  bool halted_ = false;
  std::uint8_t options_byte_ = 0;
  std::uint32_t count_ = 0;
  std::uint32_t pacer_ = 0;
  std::optional<double> first_scan_s_;
  std::uint64_t scans_ = 0;
  std::vector<Output> outputs_;
  std::vector<Request> requests_;
};

}  // namespace focalstage::mcc1208_emulator
