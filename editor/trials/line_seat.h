#pragma once

#include "editor/trials/input.h"

namespace focalstage {

/// A person whose answers come line by line, from a pipe or a slider's own program: a distance in mm, `g` gives up, `q`
/// pauses. What is said to the person goes to stdout.
class LineSeat final : public TrialParticipant {
 public:
  LineSeat(int input, std::stop_token stop) : input_(input, std::move(stop)) {}

  std::string kind() const override;
  void begin_block(const std::vector<TrialBlock>& plan, const TrialBlock& block) override;
  void notice(const std::string& what) override;
  Result<TrialChoice> ready(const TrialInPlan& at, const WhileWaiting& check) override;
  Result<TrialAnswer> answer(const TrialInPlan& at, const WhileWaiting& check) override;
  Result<TrialChoice> trouble(const std::string& what) override;
  bool lifts_darkness() const override { return true; }
  Result<std::optional<bool>> question(const std::string& text) override;

 private:
  SeatInput input_;
};

}  // namespace focalstage
