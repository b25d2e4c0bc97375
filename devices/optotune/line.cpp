#include "devices/optotune/line.h"

#include <array>

#include "devices/roles/clock.h"

namespace focalstage {

Status OptotuneLine::greet() {
  constexpr int tries = 3;
  constexpr double patience_s = 0.3;
  Status why;
  for (int i = 0; i < tries; ++i) {
    port_.discard_input();
    const double deadline_s = monotonic_s() + patience_s;
    if (const Status sent = port_.write_all(optotune_start, deadline_s); !sent) return sent;
    std::string came;
    std::array<std::uint8_t, 64> buffer{};
    while (came.size() < optotune_ready.size()) {
      const auto count = port_.read_some(buffer, deadline_s);
      if (!count) return count.fault();
      if (*count == 0) break;
      came.append(buffer.begin(), buffer.begin() + static_cast<std::ptrdiff_t>(*count));
    }
    if (came == optotune_ready) return {};
    why = came.empty()
              ? Fault{"serial.timeout", port_.path(), "the lens driver does not answer", "see its power"}
              : Fault{"optotune.stranger", port_.path(), "what answers there is no lens driver", "name its port"};
  }
  return why;
}

Result<OptotuneAnswer> OptotuneLine::exchange(const OptotuneCommand& command, double patience_s) {
  port_.discard_input();
  const double sent_by_s = monotonic_s() + answer_s_;
  if (const Status sent = port_.write_all(command.bytes, sent_by_s); !sent) return sent.fault();
  const double deadline_s = monotonic_s() + patience_s;
  OptotuneBytes came;
  std::array<std::uint8_t, 64> buffer{};
  for (;;) {
    const auto count = port_.read_some(buffer, deadline_s);
    if (!count) return count.fault();
    if (*count == 0) return OptotuneAnswer{};
    came.insert(came.end(), buffer.begin(), buffer.begin() + static_cast<std::ptrdiff_t>(*count));
    OptotuneAnswer answer = read_optotune(came, command.answer);
    if (answer.reading != OptotuneReading::more) return answer;
  }
}

Result<OptotuneBytes> OptotuneLine::ask(const OptotuneCommand& command) {
  const std::string name(command.name);
  Fault why;
  for (int i = 0; i < 2; ++i) {
    auto answer = exchange(command, answer_s_);
    if (!answer) return answer.fault();
    if (answer->reading == OptotuneReading::refused) return refusal(answer->error, command);
    const bool its_own = answer->reading == OptotuneReading::good && answer->payload[0] == command.bytes[0];
    if (its_own) return std::move(answer->payload);
    if (answer->reading == OptotuneReading::more) {
      why = {"serial.timeout", port_.path(), "no whole answer to " + name, "see the lens driver's cable and power"};
    } else {
      why = {"optotune.damaged", port_.path(), "twice a damaged answer to " + name, "see the cable"};
    }
  }
  return why;
}

Result<int> OptotuneLine::ask_number(const OptotuneCommand& command) {
  const auto payload = ask(command);
  if (!payload) return payload.fault();
  return optotune_number(*payload).value_or(0);  // its length is the command's
}

Status OptotuneLine::tell(const OptotuneCommand& command) {
  const auto answer = exchange(command, refusal_s_);
  if (!answer) return answer.fault();
  if (answer->reading == OptotuneReading::refused) return refusal(answer->error, command);
  if (answer->reading == OptotuneReading::damaged) {
    return Fault{"optotune.damaged", port_.path(), "a damaged answer to " + std::string(command.name), "see the cable"};
  }
  return {};
}

Fault OptotuneLine::refusal(int error, const OptotuneCommand& command) const {
  const std::string name(command.name);
  switch (error) {
    case 1:
      return {"optotune.checksum", port_.path(), name + " was damaged on its way", "see the cable"};
    case 2:
      return {"optotune.unavailable", port_.path(), "its firmware has no " + name, ""};
    case 4:
      return {"optotune.lens", port_.path(), "the lens does not fit the driver", "plug in a lens that does"};
    default:
      return {"optotune.unknown", port_.path(), "it does not know " + name, ""};
  }
}

}  // namespace focalstage
