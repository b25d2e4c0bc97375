#include "tests/devices/uno/emulator/misbehaviour.h"

#include <utility>

#include "tests/devices/uno/emulator/line_sum.h"

namespace focalstage::uno_emulator {

namespace {

bool is_due(int every, int count) { return every > 0 && count % every == 0; }

}  // namespace

void Line::misbehave(const Misbehaviour& how) {
  how_ = how;
  lines_ = 0;
  requests_ = 0;
}

void Line::clear() {
  saying_.clear();
  before_.clear();
  arrivals_.clear();
}

void Line::say(const std::string& bytes, Cycle now) {
  for (const char byte : bytes) {
    saying_.push_back(byte);
    if (byte == '\n') say_line(std::exchange(saying_, {}), now);
  }
}

void Line::say_line(const std::string& line, Cycle now) {
  ++lines_;
  if (how_.silent || is_due(how_.lose_every, lines_)) return;
  const std::string spoilt_line = spoilt(line);
  const Cycle at = now + static_cast<Cycle>(how_.delay_s * 16e6);
  if (how_.stale && !before_.empty()) arrivals_.push_back({at, before_});
  arrivals_.push_back({at, spoilt_line});
  before_ = spoilt_line;
}

std::string Line::spoilt(const std::string& line) {
  std::string body = without_sum(line.substr(0, line.size() - 1));
  if (body.empty()) return line;
  const std::size_t space = body.find(' ');
  const bool is_answer = body.front() != '!';
  if (is_answer && how_.refuse && body.compare(space, 3, " OK") == 0) body = body.substr(0, space) + " ERR 3";
  if (is_answer && is_due(how_.wrong_number_every, lines_)) {
    body = std::to_string((std::stoi(body) + 100) % 256) + body.substr(space);
  }
  std::string out = with_sum(body) + "\n";
  if (is_due(how_.damage_every, lines_)) out[out.size() / 2] = '~';
  return out;
}

std::string Line::arrived(Cycle now) {
  std::string bytes;
  while (!arrivals_.empty() && arrivals_.front().at <= now) {
    std::string& first = arrivals_.front().bytes;
    if (how_.dribble) {
      bytes = first.substr(0, 1);
      first.erase(0, 1);
      if (first.empty()) arrivals_.pop_front();
      return bytes;
    }
    bytes += first;
    arrivals_.pop_front();
  }
  return bytes;
}

std::string Line::told(const std::string& bytes) {
  if (how_.deaf) return {};
  std::string out = bytes;
  for (std::size_t i = 0; i < out.size(); ++i) {
    if (out[i] != '\n') continue;
    ++requests_;
    if (is_due(how_.damage_requests_every, requests_) && i > 0) out[i - 1] = '~';
  }
  return out;
}

}  // namespace focalstage::uno_emulator
