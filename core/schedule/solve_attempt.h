#pragma once

#include <optional>
#include <vector>

#include "core/optics/needs.h"
#include "core/scene/project.h"
#include "core/schedule/budget.h"
#include "core/schedule/solve.h"

namespace focalstage {

/// What one attempt keeps to. The solver asks for an answer as wished for; where there is none, it loosens one number
/// after the other to learn which of them is to blame.
struct SolveTerms {
  Project project;                 ///< the rig and what is lit; its slices are not looked at
  PowerHistogram needs;            ///< not empty, or `pinned_d` is not
  std::vector<double> pinned_d{};  ///< slices that must be there
  std::optional<int> count{};
  std::optional<double> max_error_d{};
  double spacing_d = good_spacing_d;
  double smear_d = 0.3;
  std::optional<double> pitch_s{};  ///< how far exposures lie apart; the projector's own if none

  bool light() const;  ///< a surface is lit, which takes an exposure at zero power
  double lowest_d() const;
  double highest_d() const;
};

/// The rig that keeps the terms: nothing needed lies beyond its slices if that can be, up to 0.3 D if it must.
std::optional<SolvedRig> attempt(const SolveTerms& terms, Budget& budget);

/// `project` with the rig's sweep, slices and projector times.
Project with_rig(const Project& project, const SolvedRig& rig);

}  // namespace focalstage
