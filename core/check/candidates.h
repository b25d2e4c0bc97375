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

// What might clear a finding: lists of edits, the best first. They are tried in core/check/remedies.cpp; here nobody
// knows yet whether they work. A list is left out where it cannot be had at all.

using Edits = std::vector<Edit>;

Edit set_edit(const std::string& list, const std::string& name, const std::string& key, Value value);

// The sweep ----------------------------------------------------------------------------------------------------------

/// The least widening of the sweep, in steps of 0.25 D within the lens range, after which both ends of [low_d, high_d]
/// clear the dead windows. Nothing if there is none, no need, or no sine to widen.
std::optional<Edits> widen_sweep(const Project& project, double low_d, double high_d);

/// Widened for all slices and the light, then for [low_d, high_d] alone.
std::vector<Edits> sweep_candidates(const Project& project, double low_d, double high_d);

std::vector<Edits> no_zero_crossing_candidates(const Project& project);
std::vector<Edits> lens_range_candidates(const Project& project, const Finding& finding);
std::vector<Edits> waveform_candidates(const Project& project);
std::vector<Edits> frame_rate_candidates(const Project& project, const Finding& finding);
std::vector<Edits> flicker_candidates(const Project& project);

// The slices ---------------------------------------------------------------------------------------------------------

/// The slice that a finding's `where` names, if it names one.
std::optional<std::size_t> slice_of(const Project& project, const Finding& finding);

/// `added_d` among the slices: in order where the list is in order and no object counts its slices, else at its end.
Edits add_slices(const Project& project, const std::vector<double>& added_d);

/// The list without `dropped`; objects that count slices count on. Nothing where one needs a slice that goes, or where
/// none would be left.
std::optional<Edits> drop_slices(const Project& project, const std::vector<std::size_t>& dropped);

std::vector<Edits> spacing_candidates(const Project& project, const Finding& finding);

// The projector ------------------------------------------------------------------------------------------------------

std::vector<Edits> shorter_exposures(const Project& project, std::span<const ProjectorModelData> models);
std::vector<Edits> overlap_candidates(const Project& project, const Finding& finding,
                                      std::span<const ProjectorModelData> models);
std::vector<Edits> smear_candidates(const Project& project, const Finding& finding,
                                    std::span<const ProjectorModelData> models);
std::vector<Edits> bit_depth_candidates(const Project& project, const Finding& finding,
                                        std::span<const ProjectorModelData> models);

// The objects --------------------------------------------------------------------------------------------------------

std::vector<Edits> depth_candidates(const Project& project, const Finding& finding, const Measured& measured);

}  // namespace focalstage
