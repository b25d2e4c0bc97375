#include "io/show/show.h"

namespace focalstage {

std::string this_compiler() { return "focalstage " FOCALSTAGE_VERSION; }

PoseRow pose_row(const Rigid& world_from_thing) {
  const glm::dvec3& p = world_from_thing.position_m;
  const glm::dquat& q = world_from_thing.rotation;
  return {p.x, p.y, p.z, q.x, q.y, q.z, q.w};
}

}  // namespace focalstage
