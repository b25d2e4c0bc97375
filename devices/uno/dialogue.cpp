#include "devices/uno/dialogue.h"

#include <poll.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>

#include "devices/roles/clock.h"

namespace focalstage::uno {

namespace {

// A line is 64 bytes: the system takes it at once, or nobody reads at the other end.
constexpr double send_s = 0.01;
constexpr unsigned damaged_line = 2;  // the board's error

}  // namespace

Result<Reply> Dialogue::ask(std::string_view command, double deadline_s, double repeat_s) {
  return converse(command, deadline_s, repeat_s, true);
}

Result<Reply> Dialogue::insist(std::string_view command, double deadline_s, double repeat_s) {
  return converse(command, deadline_s, repeat_s, false);
}

Status Dialogue::listen(double until_s) {
  const Status heard = hear(until_s, true);
  return heard || heard.fault().code == "uno.woken" ? Status{} : heard;
}

Result<Reply> Dialogue::converse(std::string_view command, double deadline_s, double repeat_s, bool may_be_woken) {
  const std::uint8_t number = ++number_;
  const std::optional<std::string> line = request(number, command);
  if (!line) return Fault{"uno.line", path(), "this is no request: " + std::string(command), ""};
  while (monotonic_s() < deadline_s) {
    answers_.clear();
    refused_line_ = false;
    const Status sent = port_.write_all(*line, monotonic_s() + send_s);
    if (!sent && sent.fault().code != "serial.timeout") return sent.fault();
    for (const double again_s = std::min(deadline_s, monotonic_s() + repeat_s); monotonic_s() < again_s;) {
      if (const Status heard = hear(again_s, may_be_woken); !heard) return heard.fault();
      // Answers to what was asked before come late, and are not for this.
      const auto ours = std::ranges::find(answers_, std::optional(number), &Reply::number);
      if (ours != answers_.end()) return *ours;
      answers_.clear();
      if (refused_line_) break;
    }
  }
  return Fault{"uno.silent", path(), "the trigger board does not answer",
               "see its cable and power; it needs the firmware of devices/firmware"};
}

/// One wait, and all that came.
Status Dialogue::hear(double until_s, bool may_be_woken) {
  std::array<pollfd, 2> polled{pollfd{port_.descriptor(), POLLIN, 0},
                               pollfd{may_be_woken ? waker_->descriptor() : -1, POLLIN, 0}};
  const double left_s = std::clamp(until_s - monotonic_s(), 0.0, 1.0);
  ::poll(polled.data(), polled.size(), static_cast<int>(std::ceil(left_s * 1e3)));
  std::array<std::uint8_t, 256> buffer{};
  const Result<std::size_t> got = port_.read_some(buffer, 0.0);
  if (!got) return got.fault();
  for (std::size_t i = 0; i < *got; ++i) {
    if (const auto reply = reader_.push(static_cast<char>(buffer[i]))) take(*reply);
  }
  if (may_be_woken && waker_->answer()) return Fault{"uno.woken", path(), "something comes first", ""};
  return {};
}

void Dialogue::take(const Reply& reply) {
  if (reply.kind == ReplyKind::damaged) {
    ++damaged_;
    return;
  }
  heard_s_ = monotonic_s();
  if (reply.number) {
    answers_.push_back(reply);
  } else if (reply.kind == ReplyKind::error) {
    refused_line_ = refused_line_ || reply.code == damaged_line;
  } else {
    unasked_.push_back(reply);
  }
}

}  // namespace focalstage::uno
