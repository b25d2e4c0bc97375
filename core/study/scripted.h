#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/study/plan.h"

namespace focalstage {

/// A participant that follows a rule instead of seeing anything: for tests, and to rehearse a study without people.
/// What it answers depends on study, participant, condition and trial alone, so that a study which was interrupted ends
/// in the same answers.
///
///   exact      answers the actual distance
///   noisy      the same with Gaussian noise of 10 mm
///   biased     the same noise, and 25 mm farther under every condition that is `conventional`, or where shows were
///   given
///              under every condition but the first
///   gives-up   as noisy, but gives up every seventh trial of a block, training included
class ScriptedParticipant {
 public:
  /// Fault "study.scripted" lists the names there are.
  static Result<ScriptedParticipant> named(const std::string& name);
  static std::vector<std::string> names();

  const std::string& name() const { return name_; }

  /// The answer in metres, within the pointer's range; nothing: gives up.
  std::optional<double> answer(const Study& study, const std::string& participant, const TrialBlock& block,
                               const Trial& trial) const;

  /// To every question.
  bool says_yes() const { return false; }

 private:
  ScriptedParticipant(std::string name, double noise_m, double bias_m, int gives_up_every)
      : name_(std::move(name)), noise_m_(noise_m), bias_m_(bias_m), gives_up_every_(gives_up_every) {}

  std::string name_;
  double noise_m_;
  double bias_m_;
  int gives_up_every_;  ///< 0: never
};

}  // namespace focalstage
