#pragma once

#include <optional>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "core/base/sides.h"
#include "core/optics/eye.h"
#include "core/optics/projector_model.h"
#include "core/reference/ray_room.h"
#include "core/stage/stage.h"

namespace focalstage {

/// A rig at one moment, to send light through.
struct RoomOfLight {
  Stage stage;
  RayRoom surfaces;
  PerEye<Eye> eyes;
  ProjectorModel projector;

  static Result<RoomOfLight> of(const Project& project, const Assets& assets, double time_s);
};

/// How an eye sees something.
struct Seen {
  glm::dvec2 look{0.0};
  double vergence_d = 0.0;  ///< at the lens centre, of its accommodation
};

/// Where `point_m` is, and where its picture is meant to come into focus; none behind the lens.
std::optional<Seen> meant(const RoomOfLight& room, Side side, const Depth& depth, const glm::dvec3& point_m);

/// What the compiler makes of that: the projector's pixel, and the power of the slice, of those there are, nearest to
/// the one needed (a pinned object's own). None where no surface carries it, or the projector does not reach there.
struct Exposed {
  glm::dvec2 pixel{0.0};
  double power_d = 0.0;
};
std::optional<Exposed> exposed(const RoomOfLight& room, Side side, const Depth& depth,
                               const std::vector<double>& powers_d, const Seen& wanted);

/// What becomes of the light of a pixel through a lens of `power_d`. None where it meets no surface, or behind the
/// lens.
std::optional<Seen> arrived(const RoomOfLight& room, Side side, const glm::dvec2& pixel, double power_d);

}  // namespace focalstage
