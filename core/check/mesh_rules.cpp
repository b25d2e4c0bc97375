#include <algorithm>

#include "core/check/candidates.h"
#include "core/check/rules.h"
#include "core/check/words.h"
#include "core/scene/process_codec.h"
#include "core/stage/texture_maps.h"
#include "core/stage/world_bounds.h"

namespace focalstage {
namespace {

/// `visit` with the surface or object itself.
template <class Visit>
auto with_thing(const Project& project, const MeshState& thing, Visit&& visit) {
  return thing.list == "surfaces" ? visit(project.surfaces[thing.index]) : visit(project.objects[thing.index]);
}

std::string name_of(const Project& project, const MeshState& state) {
  return with_thing(project, state, [](const auto& thing) { return thing.name; });
}

/// One more step after those there are.
Edits step_edit(const Project& project, const MeshState& state, const ProcessKind& step) {
  const auto next = with_thing(project, state, [](const auto& thing) { return thing.mesh.process.size(); });
  return {set_edit(state.list, name_of(project, state), "mesh/process/" + std::to_string(next),
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

/// A picture or pattern that the mesh has no place for is not seen.
bool lacks_uv(const Drawable& drawable) {
  const Finish& finish = drawable.finish;
  const bool pictured =
      finish.kind == Finish::Kind::checker || (finish.kind == Finish::Kind::textured && finish.texture);
  return pictured && drawable.mesh->uvs.empty();
}

template <class Things, class Staged>
void add_things(const std::string& list, const Things& things, const std::vector<Staged>& staged, const Stage& stage,
                Rigid Staged::*world_from_thing, std::vector<MeshState>& all) {
  for (const Staged& thing : staged) {
    MeshState found{list, thing.index, {}, {}};
    if (std::ranges::any_of(thing.drawables, lacks_uv)) {
      found.lacks_uv = facing_plane(thing.drawables, thing.*world_from_thing, stage.world_from_viewer.position_m);
    }
    if (!std::holds_alternative<FileMesh>(things[thing.index].mesh.shape)) {
      if (found.lacks_uv) all.push_back(std::move(found));
      continue;
    }
    found.size_m = world_bounds(thing.drawables).size_m();
    for (const Drawable& drawable : thing.drawables) {
      for (const MeshFlaw& flaw : flaws_once(drawable.mesh)) add_flaw(found.flaws, flaw);
    }
    all.push_back(std::move(found));
  }
}

/// Files do not say their unit: a thing of twenty metres and more was written in millimetres, one that is a little
/// smaller in centimetres; one far too small was made metres twice.
std::optional<Finding> size_finding(const Project& project, const MeshState& thing) {
  const double longest_m = std::max({thing.size_m.x, thing.size_m.y, thing.size_m.z});
  if (!(longest_m > 0.0) || (longest_m <= largest_thing_m && longest_m >= smallest_thing_m)) return std::nullopt;
  const bool large = longest_m > largest_thing_m;
  const double factor = !large ? 1e3 : longest_m > 20.0 ? 1e-3 : 1e-2;
  const double scale = with_thing(project, thing, [](const auto& one) { return one.scale; });
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

std::optional<Finding> uv_finding(const Project& project, const MeshState& thing) {
  if (!thing.lacks_uv) return std::nullopt;
  const char* what = thing.list == "surfaces" ? "albedo" : "appearance";
  return Finding{Severity::warning,
                 "mesh.no-uv",
                 "/" + thing.list + "/" + std::to_string(thing.index) + "/" + what,
                 "the mesh of " + name_of(project, thing) +
                     " has no texture coordinates: nothing says where on it its picture lies",
                 {},
                 step_edit(project, thing, *thing.lacks_uv)};
}

/// What may be meant: it is told, and no more.
bool may_be_meant(const std::string& code) {
  return code == "mesh.holes" || code == "mesh.bits" || code == "mesh.no-area";
}

}  // namespace

std::vector<MeshState> mesh_states(const Project& project, const Stage& stage) {
  std::vector<MeshState> all;
  add_things("surfaces", project.surfaces, stage.surfaces, stage, &StagedSurface::world_from_surface, all);
  add_things("objects", project.objects, stage.objects, stage, &StagedObject::world_from_object, all);
  return all;
}

std::vector<Finding> mesh_findings(const Project& project, const std::vector<MeshState>& things) {
  std::vector<Finding> findings;
  for (const MeshState& thing : things) {
    if (auto size = size_finding(project, thing)) findings.push_back(*std::move(size));
    if (auto unmapped = uv_finding(project, thing)) findings.push_back(*std::move(unmapped));
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
