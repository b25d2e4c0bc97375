#include "editor/trials/input.h"

#include <poll.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdio>

#include "editor/trials/faults.h"

namespace focalstage {
namespace {

constexpr int poll_ms = 40;
constexpr std::chrono::milliseconds check_every{250};
constexpr std::size_t longest_line = 200;

std::string mm(double length_m) {
  char text[32];
  std::snprintf(text, sizeof text, "%.0f", length_m * 1e3);
  return text;
}

}  // namespace

Result<char> SeatInput::next(const WhileWaiting& check) {
  for (;;) {
    if (stop_.stop_requested()) return stopped();
    if (check && Clock::now() - checked_ > check_every) {
      if (Status good = check(); !good) return good.fault();
      checked_ = Clock::now();
    }
    pollfd waiting{file_, POLLIN, 0};
    const int ready = ::poll(&waiting, 1, poll_ms);
    if (ready == 0 || (ready < 0 && errno == EINTR)) continue;
    char byte = 0;
    const ssize_t count = ::read(file_, &byte, 1);
    if (count < 0 && (errno == EINTR || errno == EAGAIN)) continue;
    if (count <= 0) return input_ended();
    return byte;
  }
}

Result<std::string> SeatInput::line(const WhileWaiting& check) {
  std::string text;
  for (;;) {
    const auto byte = next(check);
    // A last line may lack its end.
    if (!byte && byte.fault().code == "trials.input-ended" && !text.empty()) return text;
    if (!byte) return byte.fault();
    if (*byte == '\n') return text;
    if (*byte != '\r' && text.size() < longest_line) text += *byte;
  }
}

void SeatInput::forget() { ::tcflush(file_, TCIFLUSH); }

KeyByKey::KeyByKey(int terminal) : terminal_(terminal) {
  if (::tcgetattr(terminal_, &before_) != 0) return;
  termios keys = before_;
  keys.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
  keys.c_cc[VMIN] = 1;
  keys.c_cc[VTIME] = 0;
  changed_ = ::tcsetattr(terminal_, TCSADRAIN, &keys) == 0;
}

KeyByKey::~KeyByKey() {
  if (changed_) ::tcsetattr(terminal_, TCSADRAIN, &before_);
}

Result<double> reading_from(const std::string& text, const StudyPointer& pointer) {
  const auto begin = text.find_first_not_of(" \t");
  const Fault unclear{"trials.reading", "answer", "\"" + text + "\" is no distance", "type millimetres, such as 412"};
  if (begin == std::string::npos) return unclear;
  double reading_mm = 0.0;
  const char* const end = text.data() + text.size();
  const auto [rest, problem] = std::from_chars(text.data() + begin, end, reading_mm);
  std::string unit(rest, end);
  std::erase_if(unit, [](char c) { return c == ' ' || c == '\t'; });
  if (problem != std::errc{} || !std::isfinite(reading_mm) || !(unit.empty() || unit == "mm")) return unclear;
  const double reading_m = reading_mm / 1e3;
  if (reading_m >= pointer.from_m && reading_m <= pointer.to_m) return reading_m;
  return Fault{"trials.reading", "answer",
               "the pointer goes from " + mm(pointer.from_m) + " to " + mm(pointer.to_m) + " mm only", "read it again"};
}

}  // namespace focalstage
