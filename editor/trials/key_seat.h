#pragma once

#include "editor/trials/input.h"

namespace focalstage {

/// What a key means while a trial waits for its answer.
enum class SeatKey { none, enter, farther, nearer, much_farther, much_nearer, erase, character };

struct KeyPress {
  SeatKey key = SeatKey::none;
  char character = 0;
};

/// Puts bytes of a terminal together: arrows and page keys come as several.
class KeyDecoder {
 public:
  KeyPress take(char byte);

 private:
  std::string sequence_;  ///< begun by an escape
};

/// A reading being made: moved by keys, or typed.
class PointerEntry {
 public:
  PointerEntry(const StudyPointer& pointer, double start_m) : pointer_(pointer), reading_m_(start_m) {}

  /// True: the key was one of ours.
  bool take(const KeyPress& press);

  /// What Enter confirms: the typed distance, or the reading where it was moved. Fault "trials.reading".
  Result<double> confirmed() const;

  /// "412 mm", or what is being typed.
  std::string text() const;

 private:
  void move(double steps);

  StudyPointer pointer_;
  double reading_m_;
  bool moved_ = false;
  std::string typed_;
};

/// A person at a terminal: arrows move the reading, digits type it, Enter confirms, g gives up, q pauses.
class KeySeat final : public TrialParticipant {
 public:
  KeySeat(int terminal, std::stop_token stop) : keys_(terminal), input_(terminal, std::move(stop)) {}

  std::string kind() const override;
  void begin_block(const std::vector<TrialBlock>& plan, const TrialBlock& block) override;
  void notice(const std::string& what) override;
  Result<TrialChoice> ready(const TrialInPlan& at, const WhileWaiting& check) override;
  Result<TrialAnswer> answer(const TrialInPlan& at, const WhileWaiting& check) override;
  Result<TrialChoice> trouble(const std::string& what) override;
  bool lifts_darkness() const override { return true; }
  Result<std::optional<bool>> question(const std::string& text) override;

 private:
  Result<TrialChoice> enter_or_q(const WhileWaiting& check);

  KeyByKey keys_;
  SeatInput input_;
};

}  // namespace focalstage
