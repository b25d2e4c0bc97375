#include "core/tracking/placed.h"

namespace focalstage {

namespace {

/// Calls `visit(placement, place)` for the viewer and each visible thing that is tracked, until one answers a fault.
template <class ProjectLike, class Visit>
Status each_tracked(ProjectLike& project, Visit visit) {
  if (!project.viewer.placement.track.empty()) {
    if (Status done = visit(project.viewer.placement, "/viewer/track"); !done) return done;
  }
  const auto each = [&](auto& things, const std::string& list) -> Status {
    for (std::size_t i = 0; i < things.size(); ++i) {
      if (things[i].hidden || things[i].placement.track.empty()) continue;
      if (Status done = visit(things[i].placement, "/" + list + "/" + std::to_string(i) + "/track"); !done) return done;
    }
    return {};
  };
  if (Status done = each(project.surfaces, "surfaces"); !done) return done;
  return each(project.objects, "objects");
}

std::string names_of(const BodyPoses& bodies) {
  std::string names;
  for (const auto& [name, pose] : bodies) names += (names.empty() ? "" : ", ") + name;
  return names.empty() ? "none" : names;
}

}  // namespace

std::set<std::string> bodies_of(const Project& project) {
  std::set<std::string> names;
  (void)each_tracked(project, [&](const Placement& placement, const std::string&) -> Status {
    names.insert(placement.track);
    return {};
  });
  return names;
}

Result<Project> placed(const Project& project, const BodyPoses& world_from_body, const BodyMounts& body_from_thing) {
  Project result = project;
  const Status done = each_tracked(result, [&](Placement& placement, const std::string& place) -> Status {
    const auto body = world_from_body.find(placement.track);
    if (body == world_from_body.end()) {
      return Fault{"track.unknown", place, "the tracker knows no body named " + placement.track,
                   "its bodies: " + names_of(world_from_body)};
    }
    if (!body->second) {
      return Fault{"track.unseen", place, "the tracker does not see " + placement.track + " now",
                   "see that nothing covers its markers"};
    }
    const auto mount = body_from_thing.find(placement.track);
    placement.pose = mount == body_from_thing.end() ? *body->second : *body->second * mount->second;
    placement.keys.clear();
    return {};
  });
  if (!done) return done.fault();
  return result;
}

}  // namespace focalstage
