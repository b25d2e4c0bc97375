#pragma once

#include <array>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "core/base/rigid.h"

namespace focalstage {

enum class HandleTool { move, turn, scale, measure };
/// Along which axes handles act. `sight`: along the line of sight from the viewer, which is what depth means here.
enum class HandleSpace { world, local, sight };

/// Something that handles can act on, as edits name it, with what it is now.
struct HandleThing {
  std::string list;
  std::string name;
  Rigid pose;
  double scale = 1.0;
  bool turns = true;   ///< false: a point has no direction
  bool scales = true;  ///< false: a projector or the viewer has no size to set

  bool operator==(const HandleThing&) const = default;
};

/// Where handles stand and along which axes they act. In sight space x and y are the viewer's right and up, square to
/// the line from the midpoint of the pupils; z runs along that line, away from the viewer.
struct HandleFrame {
  HandleSpace space = HandleSpace::world;
  glm::dvec3 origin_m{0.0};
  std::array<glm::dvec3, 3> axes{glm::dvec3(1.0, 0.0, 0.0), glm::dvec3(0.0, 1.0, 0.0), glm::dvec3(0.0, 0.0, 1.0)};
  /// The number that snapping rounds along each axis: the coordinate in the world, the distance along the sight; zero
  /// where an axis has no natural zero.
  glm::dvec3 coordinates_m{0.0};

  bool operator==(const HandleFrame&) const = default;
};

/// The frame at the middle of the things' origins; local axes are those of the last. `things` must not be empty.
HandleFrame handle_frame(HandleSpace space, const std::vector<HandleThing>& things, const Rigid& world_from_viewer);

/// The viewer's line of sight to a point, of length one; straight ahead for the midpoint itself.
glm::dvec3 sight_to(const Rigid& world_from_viewer, const glm::dvec3& point_m);

}  // namespace focalstage
