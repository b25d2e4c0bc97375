#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "core/base/result.h"

namespace focalstage {

/// A serial line, raw, 8 data bits, no parity, one stop bit, no flow control. No thread of its own: one thread may read
/// while another writes. Deadlines are times of devices/roles/clock.h.
///
/// Faults: "serial.open", "serial.busy" (another program has it), "serial.baud", "serial.timeout" and "serial.gone":
/// unplugged, hung up or failed, and nothing will ever come from this port again.
class SerialPort {
 public:
  /// As this program's alone where the system knows how to. Raises DTR, which resets an Arduino; closing leaves it
  /// raised.
  static Result<SerialPort> open(const std::string& path, int baud = 115200);

  SerialPort(SerialPort&& other) noexcept;
  SerialPort& operator=(SerialPort&& other) noexcept;
  ~SerialPort();

  /// "serial.timeout": some of it may have been sent.
  Status write_all(std::span<const std::uint8_t> bytes, double deadline_s);
  Status write_all(std::string_view text, double deadline_s);

  /// Waits for the first byte, then takes what is there; 0: nothing came by then. A deadline that is over still takes
  /// what is there.
  Result<std::size_t> read_some(std::span<std::uint8_t> buffer, double deadline_s);

  /// Forgets what came and was not read.
  void discard_input();

  const std::string& path() const { return path_; }
  /// For poll; -1 once moved from.
  int descriptor() const { return descriptor_; }

 private:
  SerialPort(std::string path, int descriptor) : path_(std::move(path)), descriptor_(descriptor) {}

  Fault gone(int error) const;

  std::string path_;
  int descriptor_ = -1;
};

}  // namespace focalstage
