#pragma once

#include <chrono>
#include <stop_token>

#include "core/study/scripted.h"
#include "editor/trials/participant.h"

namespace focalstage {

/// A scripted participant at a rig. It never ends a darkness; where the rig fails it waits a while for somebody to put
/// it right.
class ScriptedSeat final : public TrialParticipant {
 public:
  ScriptedSeat(ScriptedParticipant script, std::chrono::milliseconds patience, std::stop_token stop)
      : script_(std::move(script)), patience_(patience), stop_(std::move(stop)) {}

  std::string kind() const override;
  void begin_block(const std::vector<TrialBlock>& plan, const TrialBlock& block) override;
  void notice(const std::string& what) override;
  Result<TrialChoice> ready(const TrialInPlan& at, const WhileWaiting& check) override;
  Result<TrialAnswer> answer(const TrialInPlan& at, const WhileWaiting& check) override;
  Result<TrialChoice> trouble(const std::string& what) override;
  bool lifts_darkness() const override { return false; }
  Result<std::optional<bool>> question(const std::string& text) override;

 private:
  using Clock = std::chrono::steady_clock;

  ScriptedParticipant script_;
  std::chrono::milliseconds patience_;
  std::stop_token stop_;
  std::optional<Clock::time_point> troubled_since_;
};

}  // namespace focalstage
