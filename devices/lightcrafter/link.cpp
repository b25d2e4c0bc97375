#include "devices/lightcrafter/link.h"

#include "devices/roles/clock.h"

namespace focalstage::lightcrafter {

namespace {

constexpr int slice_ms = 5;  ///< how long a hurry may go unnoticed

Fault fault(const char* code, const std::string& message, const std::string& remedy) {
  return {code, "LightCrafter 4500", message, remedy};
}

Fault gone() {
  return fault("projector.lost", "it is no longer there", "look at its USB cable and its power, then open it again");
}

}  // namespace

Link::Link(std::unique_ptr<Reports> reports, double answer_s, const std::atomic<bool>& hurry)
    : reports_(std::move(reports)), answer_s_(answer_s), hurry_(hurry) {}

Status Link::write(Command command, std::span<const std::uint8_t> payload) {
  return write(command, payload, {answer_s_, false});
}

Result<Bytes> Link::read(Command command) { return read(command, {answer_s_, false}); }

Status Link::write_at_once(Command command, std::span<const std::uint8_t> payload, double answer_s) {
  return write(command, payload, {answer_s, true});
}

Result<Bytes> Link::read_at_once(Command command, double answer_s) { return read(command, {answer_s, true}); }

Status Link::write(Command command, std::span<const std::uint8_t> payload, Wait wait) {
  const std::uint8_t sequence = sequence_++;
  if (const Status sent = send(write_message(command, sequence, payload)); !sent) return sent;
  const Result<Answer> got = answer(command, false, sequence, wait);
  if (!got) return got.fault();
  if (got->sequence == sequence && sequence != 0) echoes_ = true;
  return {};
}

Result<Bytes> Link::read(Command command, Wait wait) {
  if (const Status sent = send(read_message(command)); !sent) return sent.fault();
  Result<Answer> got = answer(command, true, 0, wait);
  if (!got) return got.fault();
  if (got->data.empty()) {
    return fault("projector.refused", "it does not tell " + name_of(command), "look at its firmware's version");
  }
  return std::move(got->data);
}

Status Link::send(std::span<const std::uint8_t> message) {
  Report old;
  for (int i = 0; i < 64; ++i) {  // answers that came too late
    const Reports::Got got = reports_->read(old, 0);
    if (got == Reports::Got::gone) return gone();
    if (got == Reports::Got::nothing) break;
  }
  for (const Report& report : reports_of(message)) {
    if (!reports_->write(report)) return gone();
  }
  return {};
}

Result<Answer> Link::answer(Command command, bool to_read, std::uint8_t sequence, Wait wait) {
  const double until_s = monotonic_s() + wait.answer_s;
  Report report;
  while (monotonic_s() < until_s) {
    if (hurry_ && !wait.at_once) return fault("projector.hurried", name_of(command) + " was cut short by darkness", "");
    const Reports::Got got = reports_->read(report, slice_ms);
    if (got == Reports::Got::gone) return gone();
    if (got == Reports::Got::nothing) continue;
    auto answer = parse_answer(report);
    if (!answer || answer->to_read != to_read) continue;
    if (!to_read && echoes_ && answer->sequence != sequence) continue;
    if (answer->nack) {
      return fault("projector.refused", "it refused " + std::string(to_read ? "to tell " : "") + name_of(command),
                   "look at its firmware's version");
    }
    return std::move(*answer);
  }
  return fault("projector.silent", "it did not answer " + name_of(command) + " in time",
               "switch it off and on, then open it again");
}

}  // namespace focalstage::lightcrafter
