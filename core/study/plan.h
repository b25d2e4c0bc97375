#pragma once

#include <vector>

#include "core/study/study.h"

namespace focalstage {

/// One thing a participant is asked to match.
struct Trial {
  int number = 0;  ///< within its block, training first, from 1
  bool training = false;
  int target = 0;                ///< of the study's
  int repetition = 0;            ///< from 1; 0 in training
  double pointer_start_m = 0.0;  ///< where the pointer is put before it: chance, on the pointer's steps

  bool operator==(const Trial&) const = default;
};

/// All trials under one condition, in order.
struct TrialBlock {
  int number = 0;     ///< from 1
  int condition = 0;  ///< of the study's
  std::vector<Trial> trials;

  bool operator==(const TrialBlock&) const = default;
};

/// What the participant at `participant` of the study's list does, in order: the same for the same study, always.
///
/// Conditions follow a Williams design over the participants (two conditions: AB, BA, AB, ...). Within a block each
/// repetition is one pass over all targets in the order of a Williams row. Over a full set of participants (`full_set`)
/// each target stands at each place of each pass equally often, also among those with the same order of conditions, and
/// within the passes each target follows each other one equally often. The seed says which target is which of the
/// design and at which row each pass begins. No target comes twice in a row, also from one pass to the next; only the
/// training trial is free in that.
std::vector<TrialBlock> plan_of(const Study& study, int participant);

/// How many participants make the design balanced: any multiple of it does.
int full_set(const Study& study);

}  // namespace focalstage
