#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/check/check.h"
#include "core/scene/edit.h"
#include "core/scene/finding.h"
#include "core/scene/project.h"
#include "core/schedule/projector_models.h"

namespace focalstage {

// What might clear a finding, the best first. They are tried in core/check/remedies.cpp; here nobody
// knows yet whether they work. A list is left out where it cannot be had at all.

using Edits = std::vector<Edit>;

struct Candidate {
  Edits edits;
  bool gives_up = false;  ///< takes away something that the designer asked for: only where nothing else helps
};
using Candidates = std::vector<Candidate>;

Edit set_edit(const std::string& list, const std::string& name, const std::string& key, Value value);

// The sweep ----------------------------------------------------------------------------------------------------------

/// The least widening of the sweep, in steps of 0.25 D within the lens range, after which both ends of [low_d, high_d]
/// clear the dead windows. Nothing if there is none, no need, or no sine to widen.
std::optional<Edits> widen_sweep(const Project& project, double low_d, double high_d);

/// Widened for all slices and the light, then for [low_d, high_d] alone.
Candidates sweep_candidates(const Project& project, double low_d, double high_d);

Candidates no_zero_crossing_candidates(const Project& project);
Candidates lens_range_candidates(const Project& project, const Finding& finding);
/// The sine in place of a waveform, and the sweep narrowed about its middle until the lenses bear the drive.
Candidates lens_current_candidates(const Project& project);
Candidates waveform_candidates(const Project& project);
Candidates frame_rate_candidates(const Project& project, const Finding& finding);
Candidates flicker_candidates(const Project& project);

// The slices ---------------------------------------------------------------------------------------------------------

/// The slice that a finding's `where` names, if it names one.
std::optional<std::size_t> slice_of(const Project& project, const Finding& finding);

/// `added_d` among the slices: in order where the list is in order and no object counts its slices, else at its end.
Edits add_slices(const Project& project, const std::vector<double>& added_d);

/// The list without `dropped`; objects that count slices count on. Nothing where one needs a slice that goes, or where
/// none would be left.
std::optional<Edits> drop_slices(const Project& project, const std::vector<std::size_t>& dropped);

Candidates spacing_candidates(const Project& project, const Finding& finding);

// The projector ------------------------------------------------------------------------------------------------------

Candidates shorter_exposures(const Project& project, std::span<const ProjectorModelData> models);
Candidates overlap_candidates(const Project& project, const Finding& finding,
                              std::span<const ProjectorModelData> models);
Candidates smear_candidates(const Project& project, const Finding& finding, std::span<const ProjectorModelData> models);
Candidates bit_depth_candidates(const Project& project, const Finding& finding,
                                std::span<const ProjectorModelData> models);

/// The known model whose name differs by case, blanks or dashes alone; the lattice that the model has.
Candidates model_candidates(const Project& project, const Finding& finding, std::span<const ProjectorModelData> models);
Candidates pixel_layout_candidates(const Project& project, const Finding& finding,
                                   std::span<const ProjectorModelData> models);

// The light ----------------------------------------------------------------------------------------------------------

/// A white that all surfaces can send back; or none of the compensation that asks for more.
Candidates clipped_candidates(const Project& project, const Measured& measured);

// The solver ---------------------------------------------------------------------------------------------------------

/// Whether the solver can have a remedy for findings of this code: what slices and sweep do not reach.
bool solver_answers(const std::string& code);

/// The solver's proposal for all that the frames need; none where that was not measured or there is none.
Candidates solver_candidates(const Project& project, const Measured& measured,
                             std::span<const ProjectorModelData> models);

// The objects --------------------------------------------------------------------------------------------------------

Candidates depth_candidates(const Project& project, const Finding& finding, const Measured& measured);

/// Focus where it stands, for an object that is told to focus elsewhere.
Candidates conflict_candidates(const Project& project, const Finding& finding);

}  // namespace focalstage
