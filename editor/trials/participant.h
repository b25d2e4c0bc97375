#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/study/plan.h"

namespace focalstage {

/// A trial with all that it is part of.
struct TrialInPlan {
  const Study& study;
  const std::string& participant;
  const std::vector<TrialBlock>& plan;
  const TrialBlock& block;
  const Trial& trial;
};

enum class TrialChoice { go_on, pause };

/// How a trial ended.
struct TrialAnswer {
  enum class Kind { matched, gave_up, pause };
  Kind kind = Kind::matched;
  double response_m = 0.0;
};

/// Called while somebody thinks; a fault ends the waiting.
using WhileWaiting = std::function<Status()>;

/// Whoever answers: a person at the keyboard, or a script. Faults: what `check` said; "trials.stopped" (Ctrl-C);
/// "trials.input-ended".
class TrialParticipant {
 public:
  virtual ~TrialParticipant() = default;

  /// "human", or "scripted:NAME".
  virtual std::string kind() const = 0;

  /// A part of a block begins.
  virtual void begin_block(const std::vector<TrialBlock>& plan, const TrialBlock& block) = 0;

  /// Something to be known, to which nothing need be answered.
  virtual void notice(const std::string& what) = 0;

  /// In the dark: the pointer is put to where the trial wants it.
  virtual Result<TrialChoice> ready(const TrialInPlan& at, const WhileWaiting& check) = 0;

  /// In the target's light.
  virtual Result<TrialAnswer> answer(const TrialInPlan& at, const WhileWaiting& check) = 0;

  /// The rig failed; returns when it is to be tried again.
  virtual Result<TrialChoice> trouble(const std::string& what) = 0;

  /// Whether going on after trouble means that a latched darkness may end: only a person may say so.
  virtual bool lifts_darkness() const = 0;

  /// Yes or no; nothing: paused.
  virtual Result<std::optional<bool>> question(const std::string& text) = 0;
};

}  // namespace focalstage
