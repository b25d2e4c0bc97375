#include <algorithm>
#include <cmath>

#include <glm/common.hpp>

#include "core/check/candidates.h"
#include "core/check/rules.h"
#include "core/check/words.h"
#include "core/scene/process_codec.h"

namespace focalstage {
namespace {

const MeshSource& source_of(const Project& project, const MeshState& thing) {
  return thing.list == "surfaces" ? project.surfaces[thing.index].mesh : project.objects[thing.index].mesh;
}

const std::string& name_of(const Project& project, const MeshState& thing) {
  return thing.list == "surfaces" ? project.surfaces[thing.index].name : project.objects[thing.index].name;
}

/// One more step after those there are.
Edits step_edit(const Project& project, const MeshState& thing, const ProcessKind& step) {
  const std::size_t next = source_of(project, thing).process.size();
  return {set_edit(thing.list, name_of(project, thing), "mesh/process/" + std::to_string(next),
                   Codec<ProcessStep>::write({step, {}}))};
}

/// A file of several meshes has each flaw once, with all that is wrong in them.
void add_flaw(std::vector<MeshFlaw>& flaws, const MeshFlaw& flaw) {
  const auto same = std::ranges::find(flaws, flaw.code, &MeshFlaw::code);
  if (same == flaws.end()) {
    flaws.push_back(flaw);
    return;
  }
  const double sum = same->count + flaw.count;
  if (flaw.count > same->count) *same = flaw;
  if (!same->message.ends_with("and others")) same->message += " in one of its meshes, and others";
  same->count = sum;
}

/// The box around the thing's triangles in the room.
glm::dvec3 size_m(const std::vector<Drawable>& drawables) {
  glm::dvec3 low_m(INFINITY);
  glm::dvec3 high_m(-INFINITY);
  for (const Drawable& drawable : drawables) {
    for (const glm::uvec3& triangle : drawable.mesh->triangles) {
      for (int k = 0; k < 3; ++k) {
        const glm::dvec3 at_m(drawable.world_from_mesh * glm::dvec4(drawable.mesh->positions_m[triangle[k]], 1.0));
        low_m = glm::min(low_m, at_m);
        high_m = glm::max(high_m, at_m);
      }
    }
  }
  return drawables.empty() ? glm::dvec3(0.0) : high_m - low_m;
}

template <class Things, class Staged>
void add_things(const std::string& list, const Things& things, const std::vector<Staged>& staged,
                std::vector<MeshState>& all) {
  for (const Staged& thing : staged) {
    if (!std::holds_alternative<FileMesh>(things[thing.index].mesh.shape)) continue;
    MeshState found{list, thing.index, {}, size_m(thing.drawables)};
    for (const Drawable& drawable : thing.drawables) {
      for (const MeshFlaw& flaw : flaws_once(drawable.mesh)) add_flaw(found.flaws, flaw);
    }
    all.push_back(std::move(found));
  }
}

/// Files do not say their unit: a thing far too large was written in millimetres, or (if that makes nothing of it)
/// centimetres; one far too small was made metres twice.
std::optional<Finding> size_finding(const Project& project, const MeshState& thing) {
  const double longest_m = std::max({thing.size_m.x, thing.size_m.y, thing.size_m.z});
  if (!(longest_m > 0.0) || (longest_m <= largest_thing_m && longest_m >= smallest_thing_m)) return std::nullopt;
  const bool large = longest_m > largest_thing_m;
  const double factor = !large ? 1e3 : longest_m * 1e-3 >= smallest_thing_m && longest_m > 20.0 ? 1e-3 : 1e-2;
  const double scale =
      thing.list == "surfaces" ? project.surfaces[thing.index].scale : project.objects[thing.index].scale;
  const char* guess = !large           ? "made metres twice?"
                      : factor == 1e-3 ? "a file in millimetres?"
                                       : "a file in centimetres?";
  return Finding{Severity::warning,
                 "mesh.size",
                 "/" + thing.list + "/" + std::to_string(thing.index) + "/scale",
                 name_of(project, thing) + " is " + words(longest_m) + " m long: " + guess,
                 Amount{longest_m, large ? largest_thing_m : smallest_thing_m, "m"},
                 {set_edit(thing.list, name_of(project, thing), "scale", Value(scale * factor))}};
}

/// What may be meant: it is told, and no more.
bool may_be_meant(const std::string& code) {
  return code == "mesh.holes" || code == "mesh.bits" || code == "mesh.no-area";
}

}  // namespace

std::vector<MeshState> mesh_states(const Project& project, const Stage& stage) {
  std::vector<MeshState> all;
  add_things("surfaces", project.surfaces, stage.surfaces, all);
  add_things("objects", project.objects, stage.objects, all);
  return all;
}

std::vector<Finding> mesh_findings(const Project& project, const std::vector<MeshState>& things) {
  std::vector<Finding> findings;
  for (const MeshState& thing : things) {
    if (auto size = size_finding(project, thing)) findings.push_back(*std::move(size));
    for (const MeshFlaw& flaw : thing.flaws) {
      findings.push_back({may_be_meant(flaw.code) ? Severity::info : Severity::warning, flaw.code,
                          "/" + thing.list + "/" + std::to_string(thing.index) + "/mesh",
                          "the mesh of " + name_of(project, thing) + ": " + flaw.message, Amount{flaw.count, 0.0, ""},
                          flaw.step ? step_edit(project, thing, *flaw.step) : Edits{}});
    }
  }
  return findings;
}

}  // namespace focalstage
