#include <algorithm>

#include "core/check/candidates.h"
#include "core/check/rules.h"
#include "core/scene/process_codec.h"

namespace focalstage {
namespace {

const MeshSource& source_of(const Project& project, const ThingFlaws& thing) {
  return thing.list == "surfaces" ? project.surfaces[thing.index].mesh : project.objects[thing.index].mesh;
}

const std::string& name_of(const Project& project, const ThingFlaws& thing) {
  return thing.list == "surfaces" ? project.surfaces[thing.index].name : project.objects[thing.index].name;
}

/// One more step after those there are.
Edits step_edit(const Project& project, const ThingFlaws& thing, const ProcessKind& step) {
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

template <class Things, class Staged>
void add_things(const std::string& list, const Things& things, const std::vector<Staged>& staged,
                std::vector<ThingFlaws>& all) {
  for (const Staged& thing : staged) {
    if (!std::holds_alternative<FileMesh>(things[thing.index].mesh.shape)) continue;
    ThingFlaws found{list, thing.index, {}};
    for (const Drawable& drawable : thing.drawables) {
      for (const MeshFlaw& flaw : flaws_once(drawable.mesh)) add_flaw(found.flaws, flaw);
    }
    if (!found.flaws.empty()) all.push_back(std::move(found));
  }
}

/// What may be meant: it is told, and no more.
bool may_be_meant(const std::string& code) {
  return code == "mesh.holes" || code == "mesh.bits" || code == "mesh.no-area";
}

}  // namespace

std::vector<ThingFlaws> mesh_flaws(const Project& project, const Stage& stage) {
  std::vector<ThingFlaws> all;
  add_things("surfaces", project.surfaces, stage.surfaces, all);
  add_things("objects", project.objects, stage.objects, all);
  return all;
}

std::vector<Finding> mesh_findings(const Project& project, const std::vector<ThingFlaws>& things) {
  std::vector<Finding> findings;
  for (const ThingFlaws& thing : things) {
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
