#pragma once

#include <termios.h>

#include <chrono>
#include <stop_token>
#include <string>

#include "core/base/result.h"
#include "editor/trials/participant.h"

namespace focalstage {

/// Bytes from a keyboard or a pipe, one at a time, while the rig is watched.
class SeatInput {
 public:
  SeatInput(int file, std::stop_token stop) : file_(file), stop_(std::move(stop)) {}

  /// The next byte. Looks at the rig four times a second meanwhile. Faults: what `check` says, "trials.stopped",
  /// "trials.input-ended".
  Result<char> next(const WhileWaiting& check);

  /// Up to the next line end, without it.
  Result<std::string> line(const WhileWaiting& check);

  /// What was typed while nobody asked is forgotten.
  void forget();

 private:
  using Clock = std::chrono::steady_clock;

  int file_;
  std::stop_token stop_;
  Clock::time_point checked_{};
};

/// While it lives, the terminal gives each key as it is pressed and echoes none. Ctrl-C stays a signal.
class KeyByKey {
 public:
  explicit KeyByKey(int terminal);
  ~KeyByKey();
  KeyByKey(const KeyByKey&) = delete;
  KeyByKey& operator=(const KeyByKey&) = delete;

 private:
  int terminal_;
  bool changed_ = false;
  termios before_{};
};

/// "412", "412.5 mm": a reading in metres within the pointer's range. Fault "trials.reading" says what is wrong with
/// it.
Result<double> reading_from(const std::string& text, const StudyPointer& pointer);

}  // namespace focalstage
