#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/base/result.h"

namespace focalstage {

/// What a condition makes of its project. A show that is there already is shown as it is.
enum class ConditionVariant {
  multifocal,   ///< the project's own slices: every target in focus where it stands
  conventional  ///< one slice at 0 D: right to both eyes together, but in focus on the screen
};

const char* name_of(ConditionVariant variant);

/// One way of showing the targets; one block of trials per participant.
struct Condition {
  std::string name;
  std::string project;  ///< a NAME.focal or its folder, relative to the study file; empty where `show` is named
  std::string show;     ///< a SHOW.h5, relative to the study file
  ConditionVariant variant = ConditionVariant::multifocal;  ///< of `project`

  bool operator==(const Condition&) const = default;
};

/// What is to be matched, and how far from the lens centre it truly stands.
struct StudyTarget {
  std::string name;
  std::string cue;  ///< of the shows; empty where `frame` says which
  int frame = -1;   ///< of the shows
  double actual_m = 0.0;

  bool operator==(const StudyTarget&) const = default;
};

/// The pointer that a participant moves: where its reading may lie.
struct StudyPointer {
  double from_m = 0.0;
  double to_m = 1.0;
  double step_m = 0.001;

  bool operator==(const StudyPointer&) const = default;
};

/// Asked once, after the last block; answered with yes or no.
struct StudyQuestion {
  std::string name;
  std::string text;

  bool operator==(const StudyQuestion&) const = default;
};

/// What becomes of a participant for whom all repetitions of one condition and target were given up.
enum class MissingRule {
  answered_repetitions,  ///< means are of what was answered; a mean of nothing is left out
  complete_participants  ///< a participant who lacks a mean is left out of every statistic
};

const char* name_of(MissingRule rule);

/// A depth-matching study: a value, all of it decided before the first trial.
struct Study {
  std::string name;
  std::uint64_t seed = 1;
  std::vector<std::string> participants;
  std::vector<Condition> conditions;
  std::vector<StudyTarget> targets;
  int repetitions = 4;
  int training_trials = 1;  ///< at the start of each block
  StudyPointer pointer;
  MissingRule missing = MissingRule::answered_repetitions;
  std::vector<StudyQuestion> questions;

  bool operator==(const Study&) const = default;
};

/// What a schema cannot say: names are told apart, targets lie within the pointer's range and differ, numbers are
/// finite. Faults "study.*" carry the JSON pointer in `where`.
Status check(const Study& study);

/// The place of a participant in the study's list; fault "study.participant".
Result<int> participant_index(const Study& study, const std::string& participant);

}  // namespace focalstage
