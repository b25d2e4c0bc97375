#pragma once

#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

#include "devices/serial/serial_port.h"
#include "devices/uno/packets.h"
#include "devices/uno/waker.h"

namespace focalstage::uno {

/// Talks with a board: one request at a time, said again until it is answered. Of one thread; `waker` may be of others.
/// Times are those of devices/roles/clock.h.
class Dialogue {
 public:
  Dialogue(SerialPort port, const Waker& waker) : port_(std::move(port)), waker_(&waker) {}

  /// The answer to it, OK or an error. Faults: "uno.silent" when the deadline passed, "uno.woken" when the waker rang
  /// meanwhile, "serial.gone".
  Result<Reply> ask(std::string_view command, double deadline_s, double repeat_s = 0.06);
  /// As `ask`, and nothing interrupts it.
  Result<Reply> insist(std::string_view command, double deadline_s, double repeat_s);

  /// Hears what comes unasked until then, or until the waker rings.
  Status listen(double until_s);

  /// What came unasked (boot, dark) since this was asked last.
  std::vector<Reply> take_unasked() { return std::exchange(unasked_, {}); }
  /// When the last good line came; 0: none did.
  double heard_s() const { return heard_s_; }
  /// Lines that came damaged.
  std::uint64_t damaged() const { return damaged_; }
  const std::string& path() const { return port_.path(); }

 private:
  Result<Reply> converse(std::string_view command, double deadline_s, double repeat_s, bool may_be_woken);
  Status hear(double until_s, bool may_be_woken);
  void take(const Reply& reply);

  SerialPort port_;
  const Waker* waker_;
  ReplyReader reader_;
  std::uint8_t number_ = 0;
  std::vector<Reply> answers_;
  std::vector<Reply> unasked_;
  bool refused_line_ = false;  ///< the board got a damaged one
  double heard_s_ = 0.0;
  std::uint64_t damaged_ = 0;
};

}  // namespace focalstage::uno
