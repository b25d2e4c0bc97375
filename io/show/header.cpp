#include "io/show/show.h"

namespace focalstage {

std::string this_compiler() { return "focalstage " FOCALSTAGE_VERSION; }

std::string projector_group(std::size_t i) { return "/projector/" + std::to_string(i); }

ShowProjector ShowHeader::projector(std::size_t i) const {
  if (i > 0) return others.at(i - 1);
  return {frames_per_second, width_px, height_px, channels, images, schedule.slots};
}

PoseRow pose_row(const Rigid& world_from_thing) {
  const glm::dvec3& p = world_from_thing.position_m;
  const glm::dquat& q = world_from_thing.rotation;
  return {p.x, p.y, p.z, q.x, q.y, q.z, q.w};
}

}  // namespace focalstage
