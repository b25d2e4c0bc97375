#pragma once

#include <string>

#include "core/base/result.h"
#include "devices/optotune/packets.h"
#include "devices/serial/serial_port.h"

namespace focalstage {

/// The serial line as questions and answers, one at a time: its caller sees to that.
class OptotuneLine {
 public:
  OptotuneLine(SerialPort port, double answer_s, double refusal_s)
      : port_(std::move(port)), answer_s_(answer_s), refusal_s_(refusal_s) {}

  /// The handshake, three times at most.
  Status greet();

  /// The answer's payload. What did not come or came damaged is asked once more. Faults: "serial.timeout",
  /// "serial.gone", "optotune.damaged", and the device's own "optotune.checksum", "optotune.unavailable",
  /// "optotune.unknown", "optotune.lens".
  Result<OptotuneBytes> ask(const OptotuneCommand& command);
  /// The number that ends the answer.
  Result<int> ask_number(const OptotuneCommand& command);
  /// For what is silent where it succeeds.
  Status tell(const OptotuneCommand& command);

 private:
  Result<OptotuneAnswer> exchange(const OptotuneCommand& command, double patience_s);
  Fault refusal(int error, const OptotuneCommand& command) const;

  SerialPort port_;
  double answer_s_;
  double refusal_s_;
};

}  // namespace focalstage
