#pragma once

#include <span>
#include <vector>

#include "core/check/check.h"
#include "core/scene/finding.h"
#include "core/scene/project.h"
#include "core/schedule/projector_models.h"
#include "core/schedule/schedule.h"

namespace focalstage {

// The rules of design section 6, by what they look at. Each names every culprit once, without a remedy.

/// What the rules allow, beyond which they speak.
inline constexpr double wide_spacing_d = 0.6;
inline constexpr double widest_spacing_d = 1.0;
inline constexpr double most_beyond_d = 0.3;
inline constexpr double slowest_sweep_hz = 50.0;
inline constexpr double least_contrast = 10.0;
inline constexpr double largest_thing_m = 10.0;
inline constexpr double smallest_thing_m = 1e-3;
/// What rounding may add to a number without anybody having meant it.
inline constexpr double rounding = 1e-9;

/// As users read them: errors first, then by code and place.
void sort_findings(std::vector<Finding>& findings);

std::vector<Finding> slice_findings(const Project& project);
std::vector<Finding> sweep_findings(const Project& project);
std::vector<Finding> optics_findings(const Project& project);
std::vector<Finding> projector_findings(const Project& project, std::span<const ProjectorModelData> models);
std::vector<Finding> schedule_findings(const Project& project, const std::vector<SlotTrouble>& troubles);
std::vector<Finding> view_findings(const Project& project, const Measured& measured);
std::vector<Finding> light_findings(const Project& project, const Measured& measured, const Schedule& schedule);

/// All of them that need nothing measured: what a remedy is tried against.
std::vector<Finding> planned_findings(const Project& project, const std::vector<SlotTrouble>& troubles,
                                      std::span<const ProjectorModelData> models);

}  // namespace focalstage
