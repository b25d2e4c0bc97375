#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/base/sides.h"
#include "core/reference/ray_room.h"
#include "editor/pipeline/source.h"
#include "editor/trials/conditions.h"

namespace focalstage {

// Patterns for tests of the viewer are ordinary projects: the room, the glasses and the projector of the one to be
// measured, with other objects, a frame and a cue for each level.

/// Tangent of an angle in degrees.
double tangent_deg(double deg);

/// One eye where the project says it is, and what stands before it, at the project's beginning.
class EyeInRoom {
 public:
  /// Faults of stage and rays.
  static Result<EyeInRoom> of(const Source& source, Side eye);

  Rigid world_from_eye;
  ProjectorModel projector;

  /// How far along the gaze, from the pupil, the first surface lies in direction (x, y, -1) from `from_m`; eye space.
  std::optional<double> depth_m(const glm::dvec3& from_m, double x, double y) const;

  /// The distance from the pupil along the gaze at which surfaces stand, the same to a twentieth up to `around_deg`.
  /// Fault "viewer.surface".
  Result<double> flat_surface_m(double around_deg) const;

  /// How wide a pixel is on the surface at `point_m`, in eye space. Fault "viewer.refused" beyond the picture.
  Result<double> pixel_m(const glm::dvec3& point_m) const;

 private:
  explicit EyeInRoom(RayRoom room) : room_(std::move(room)) {}
  RayRoom room_;
};

/// The project without what moves, shines and is lit, with a frame and a cue for each level.
Project bare_room(const Project& from, const std::string& name, std::size_t frames);

/// An object without lights, shown in one slice alone.
Object slice_object(const std::string& name, MeshShape shape, std::size_t slice);

/// The name of the cue at frame `frame`.
std::string level_cue(std::size_t frame);

/// A source of `project` with the files of `from` and `files`.
Result<Source> pattern_source(const Source& from, Project project, std::vector<AssetFile> files);

/// Compiles a pattern into `show`. Faults "viewer.unreachable" where the sweep does not show its powers,
/// "viewer.refused" where a rig would not play it or where it does not fit on what the projector lights.
Result<ReadyCondition> make_pattern_show(const Source& pattern, const std::filesystem::path& show,
                                         const FrameProgress& progress, const std::stop_token& stop);

}  // namespace focalstage
