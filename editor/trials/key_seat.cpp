#include "editor/trials/key_seat.h"

#include <algorithm>
#include <cstdio>

#include "core/study/response.h"
#include "editor/trials/trial_words.h"

namespace focalstage {
namespace {

constexpr double few_steps = 1.0;
constexpr double many_steps = 10.0;
constexpr std::size_t longest_typed = 8;

void say(const std::string& text) {
  std::printf("\r\x1b[K%s\r\n", text.c_str());
  std::fflush(stdout);
}

/// On the same line, over what stood there.
void show(const std::string& text) {
  std::printf("\r\x1b[K%s", text.c_str());
  std::fflush(stdout);
}

SeatKey key_of(const std::string& sequence) {
  if (sequence == "\x1b[A" || sequence == "\x1b[C" || sequence == "\x1bOA" || sequence == "\x1bOC")
    return SeatKey::farther;
  if (sequence == "\x1b[B" || sequence == "\x1b[D" || sequence == "\x1bOB" || sequence == "\x1bOD")
    return SeatKey::nearer;
  if (sequence == "\x1b[5~") return SeatKey::much_farther;
  if (sequence == "\x1b[6~") return SeatKey::much_nearer;
  return SeatKey::none;
}

bool ends_sequence(const std::string& sequence) {
  const bool opened = sequence.size() == 2 && (sequence[1] == '[' || sequence[1] == 'O');
  return sequence.size() > 1 && !opened && sequence.back() >= '@' && sequence.back() <= '~';
}

}  // namespace

KeyPress KeyDecoder::take(char byte) {
  if (byte == '\x1b') {
    sequence_ = byte;
    return {};
  }
  if (!sequence_.empty()) {
    sequence_ += byte;
    if (!ends_sequence(sequence_)) return {};
    const SeatKey key = key_of(sequence_);
    sequence_.clear();
    return {key, 0};
  }
  if (byte == '\r' || byte == '\n') return {SeatKey::enter, 0};
  if (byte == '\x7f' || byte == '\b') return {SeatKey::erase, 0};
  return {SeatKey::character, byte};
}

void PointerEntry::move(double steps) {
  typed_.clear();
  moved_ = true;
  reading_m_ = std::clamp(reading_m_ + steps * pointer_.step_m, pointer_.from_m, pointer_.to_m);
}

bool PointerEntry::take(const KeyPress& press) {
  switch (press.key) {
    case SeatKey::farther:
      move(few_steps);
      return true;
    case SeatKey::nearer:
      move(-few_steps);
      return true;
    case SeatKey::much_farther:
      move(many_steps);
      return true;
    case SeatKey::much_nearer:
      move(-many_steps);
      return true;
    case SeatKey::erase:
      if (!typed_.empty()) typed_.pop_back();
      return true;
    case SeatKey::character:
      if ((press.character < '0' || press.character > '9') && press.character != '.') return false;
      if (typed_.size() < longest_typed) typed_ += press.character;
      return true;
    default:
      return false;
  }
}

Result<double> PointerEntry::confirmed() const {
  if (!typed_.empty()) return reading_from(typed_, pointer_);
  if (moved_) return reading_m_;
  return Fault{"trials.reading", "answer", "the pointer stands where it was put",
               "move it with the arrows or type its reading first"};
}

std::string PointerEntry::text() const { return typed_.empty() ? reading_text(reading_m_) : typed_ + "_ mm"; }

std::string KeySeat::kind() const { return human_kind; }

void KeySeat::begin_block(const std::vector<TrialBlock>& plan, const TrialBlock& block) {
  say(block_text(plan, block));
  say("Arrows and page keys move the reading, digits type it in mm, Enter confirms; g gives up, q pauses.");
}

Result<TrialChoice> KeySeat::enter_or_q(const WhileWaiting& check) {
  KeyDecoder decoder;
  for (;;) {
    const auto byte = input_.next(check);
    if (!byte) return byte.fault();
    const KeyPress press = decoder.take(*byte);
    if (press.key == SeatKey::enter) return TrialChoice::go_on;
    if (press.key == SeatKey::character && press.character == 'q') return TrialChoice::pause;
  }
}

void KeySeat::notice(const std::string& what) { say(printable(what)); }

Result<TrialChoice> KeySeat::ready(const TrialInPlan& at, const WhileWaiting& check) {
  input_.forget();
  show(trial_text(at) + ". Enter when it stands there.");
  return enter_or_q(check);
}

Result<TrialAnswer> KeySeat::answer(const TrialInPlan& at, const WhileWaiting& check) {
  PointerEntry entry(at.study.pointer, at.trial.pointer_start_m);
  KeyDecoder decoder;
  for (;;) {
    show("Trial " + std::to_string(at.trial.number) + " of " + std::to_string(at.block.trials.size()) + ": " +
         entry.text());
    const auto byte = input_.next(check);
    if (!byte) return byte.fault();
    const KeyPress press = decoder.take(*byte);
    if (entry.take(press)) continue;
    if (press.key == SeatKey::character && press.character == 'g') return TrialAnswer{TrialAnswer::Kind::gave_up, 0.0};
    if (press.key == SeatKey::character && press.character == 'q') return TrialAnswer{TrialAnswer::Kind::pause, 0.0};
    if (press.key != SeatKey::enter) continue;
    const auto reading_m = entry.confirmed();
    if (reading_m) return TrialAnswer{TrialAnswer::Kind::matched, *reading_m};
    say(complaint(reading_m.fault()));
  }
}

Result<TrialChoice> KeySeat::trouble(const std::string& what) {
  say(printable(what));
  input_.forget();
  show("Enter goes on and lets the rig be lit again, q pauses.");
  return enter_or_q({});
}

Result<std::optional<bool>> KeySeat::question(const std::string& text) {
  show(printable(text) + " (y or n, q to pause) ");
  for (;;) {
    const auto byte = input_.next({});
    if (!byte) return byte.fault();
    if (*byte != 'y' && *byte != 'n' && *byte != 'q') continue;
    say(printable(text) + (*byte == 'y' ? " Yes." : *byte == 'n' ? " No." : ""));
    if (*byte == 'q') return std::optional<bool>();
    return std::optional(*byte == 'y');
  }
}

}  // namespace focalstage
