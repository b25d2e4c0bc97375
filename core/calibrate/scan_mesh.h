#pragma once

#include <optional>
#include <vector>

#include "core/calibrate/board_view.h"
#include "core/mesh/mesh.h"
#include "core/optics/projector_model.h"
#include "core/stripes/decode.h"

namespace focalstage {

/// Where the ray of a camera's pixel meets that of a projector's.
struct MeetingRays {
  glm::dvec3 world_m{0.0};  ///< half-way where they are nearest to each other
  double off_px = 0.0;      ///< of the projector's pixel from the camera's ray, as the projector would see it
};

/// None where they do not meet before both.
std::optional<MeetingRays> meeting_rays(const ProjectorModel& camera, const ProjectorModel& projector,
                                        const glm::dvec2& camera_px, const glm::dvec2& projector_px);

struct ScanMeshSettings {
  int step_px = 4;           ///< camera pixels between points; those between are averaged
  double most_off_px = 1.0;  ///< rays that miss each other by more are no point
  double steepest = 6.0;     ///< depth over width of a face, above which it is an edge between two surfaces
  int least_triangles = 12;  ///< that hang together
};

/// What the camera sees lit, as a mesh in the world: a grid of the camera's picture, cut where the depth jumps. Faces
/// are turned to the camera.
Mesh scan_mesh(const ProjectorModel& camera, const ProjectorModel& projector, const DecodedCapture& decoded,
               const ScanMeshSettings& settings);

}  // namespace focalstage
