#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <stop_token>
#include <string>

#include "core/base/result.h"
#include "editor/trials/input.h"
#include "editor/trials/key_seat.h"

namespace focalstage {

/// What an observer says of two things that are compared (two-alternative forced choice).
enum class Choice { first, second, give_up };

/// Whoever looks at a pattern. Faults: what `check` says, "trials.stopped", "trials.input-ended".
class Observer {
 public:
  virtual ~Observer() = default;

  /// "human", or "scripted".
  virtual std::string kind() const = 0;

  /// In the light of level `level`, for the `question`-th time (from 0).
  virtual Result<Choice> choose(int question, std::size_t level, const WhileWaiting& check) = 0;
};

/// Which keys mean what; 'q' always gives up.
struct ChoiceKeys {
  char first = 'u';
  char second = 'd';
  SeatKey first_arrow = SeatKey::farther;  ///< up and right
  SeatKey second_arrow = SeatKey::nearer;  ///< down and left
};

/// A person at a terminal or behind a pipe.
class KeyObserver final : public Observer {
 public:
  KeyObserver(int file, std::stop_token stop, const ChoiceKeys& meaning)
      : keys_(file), input_(file, std::move(stop)), meaning_(meaning) {}

  std::string kind() const override { return "human"; }
  Result<Choice> choose(int question, std::size_t level, const WhileWaiting& check) override;

 private:
  KeyByKey keys_;
  SeatInput input_;
  KeyDecoder decoder_;
  ChoiceKeys meaning_;
};

/// How much more the first thing has of what is compared, for an eye that sees level `level`.
using SeenDifference = std::function<Result<double>(std::size_t level)>;

/// A simulated eye: what it sees decides, with Gaussian noise. The noise of a question depends on seed and question
/// alone, so that a test which was interrupted ends in the same answers.
class ScriptedObserver final : public Observer {
 public:
  ScriptedObserver(SeenDifference difference, double noise, std::uint64_t seed)
      : difference_(std::move(difference)), noise_(noise), seed_(seed) {}

  std::string kind() const override { return "scripted"; }
  Result<Choice> choose(int question, std::size_t level, const WhileWaiting& check) override;

 private:
  SeenDifference difference_;
  double noise_;
  std::uint64_t seed_;
  std::map<std::size_t, double> seen_;
};

}  // namespace focalstage
