#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/compile/coverage.h"
#include "core/compile/frame.h"
#include "core/optics/needs.h"
#include "core/percept/conflict_meter.h"
#include "core/percept/contrast.h"
#include "core/percept/lit_surfaces.h"
#include "core/process/report.h"
#include "core/scene/finding.h"
#include "core/scene/project.h"
#include "core/schedule/projector_models.h"
#include "core/schedule/schedule.h"
#include "core/stage/stage.h"

namespace focalstage {

/// How the meshes of a thing are.
struct MeshState {
  std::string list;  ///< "surfaces" or "objects"
  std::size_t index = 0;
  std::vector<MeshFlaw> flaws;
  glm::dvec3 size_m{0.0};  ///< of the box around it, along the room's axes
  /// Where a picture or pattern lies on a mesh without texture coordinates: those that would show all of it.
  std::optional<UvPlaneStep> lacks_uv{};
};

/// Of the things whose mesh comes from a file, as they stand after their steps. Primitives are as they are meant to be,
/// unless a picture lies on one that has no place for it.
std::vector<MeshState> mesh_states(const Project& project, const Stage& stage);

/// What is wrong with them, each with the step, or the scale, that mends it.
std::vector<Finding> mesh_findings(const Project& project, const std::vector<MeshState>& things);

/// What its projector's light falls on at that moment, where contrast is a question: it leaks, or the room is lit.
std::vector<LitSurface> surfaces_in_light(const Project& project, const Stage& stage);

/// What was measured of a project's frames, as far as it was.
struct Measured {
  std::vector<FrameMeasure> frames;                   ///< of the first projector
  std::vector<std::vector<FrameMeasure>> others{};    ///< of the others, each
  std::vector<std::vector<ObjectCoverage>> coverage;  ///< per frame
  std::vector<ObjectConflict> conflicts;
  std::vector<MeshState> meshes;  ///< of the first frame
  std::vector<LitSurface> lit;    ///< of the first frame
  std::optional<Needs> needs;     ///< of all frames: lets remedies come from the solver
};

/// Everything wrong with a project, in a fixed order (errors first, then by code and place), each with its amount if it
/// has one and, where there is one, a remedy of edits that clears it and brings no new error. The codes are those of
/// design section 6 and of docs/formats/findings.md.
///
/// One finding per culprit: the worst of both eyes and all frames. A remedy is tried on the project before it is
/// offered, except for what only compiling can measure. Where no change near the culprit helps and it is known what all
/// frames need, the remedy is the solver's whole proposal. `models`: the projectors that somebody described
/// (io/models).
std::vector<Finding> check(const Project& project, const ScheduleResult& schedule, const Measured& measured,
                           std::span<const ProjectorModelData> models);

/// The same for all projectors of the project, each by its own schedule: what is wrong with a projector is said of it.
std::vector<Finding> check(const Project& project, const std::vector<ScheduleResult>& schedules,
                           const Measured& measured, std::span<const ProjectorModelData> models);

/// Whether `Measured::needs`, where they are not there yet, could give one of the findings a better remedy.
bool needs_would_help(const std::vector<Finding>& findings);

}  // namespace focalstage
