#include "core/stage/stage.h"

#include <utility>

#include <glm/gtc/matrix_transform.hpp>

#include "core/process/process.h"
#include "core/stage/animation.h"
#include "core/stage/finish.h"
#include "core/stage/interpolate.h"
#include "core/stage/primitive_cache.h"

namespace focalstage {
namespace {

/// What all things of a project are stood up with.
struct Setting {
  const Assets& assets;
  double time_s;
  bool has_lights;
};

/// The look of a thing's parts; without one (a surface) every part is plain.
using Look = const Appearance*;

Finish finish_for(Look look, const Material* material, const Setting& setting) {
  return look == nullptr ? Finish{} : finish_of(*look, material, setting.has_lights);
}

/// What the source's steps make of a mesh of it.
Result<std::shared_ptr<const Mesh>> finished(const MeshSource& source, const std::shared_ptr<const Mesh>& mesh) {
  Result<std::shared_ptr<const Mesh>> made = processed_once(mesh, source.process);
  if (made) return made;
  Fault fault = made.fault();
  fault.where = "/process" + fault.where;
  return fault;
}

Result<std::vector<Drawable>> model_drawables(const Model& model, const MeshSource& source,
                                              const glm::dmat4& world_from_thing, Look look, const Setting& setting) {
  const std::vector<glm::dmat4> thing_from_node = model_from_nodes(model, poses_at(model, setting.time_s));
  std::vector<Drawable> drawables;
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    for (const ModelPart& part : model.nodes[i].parts) {
      const Material* material =
          part.material < 0 ? nullptr : &model.materials[static_cast<std::size_t>(part.material)];
      Result<std::shared_ptr<const Mesh>> mesh = finished(source, part.mesh);
      if (!mesh) return mesh.fault();
      drawables.push_back(
          {*std::move(mesh), world_from_thing * thing_from_node[i], finish_for(look, material, setting)});
    }
  }
  return drawables;
}

Result<std::vector<Drawable>> drawables_of(const MeshSource& source, const glm::dmat4& world_from_thing, Look look,
                                           const Setting& setting) {
  if (const auto* file = std::get_if<FileMesh>(&source.shape)) {
    const auto found = setting.assets.models.find(file->file);
    if (found == setting.assets.models.end() || !found->second) {
      return Fault{"stage.asset-missing", "/file", "the file " + file->file + " is not among the loaded assets",
                   "put it beside the project"};
    }
    return model_drawables(*found->second, source, world_from_thing, look, setting);
  }
  Result<std::shared_ptr<const Mesh>> mesh = primitive_mesh(source.shape);
  if (!mesh) {
    Fault fault = mesh.fault();
    fault.where = "/" + fault.where;
    return fault;
  }
  mesh = finished(source, *mesh);
  if (!mesh) return mesh.fault();
  return std::vector<Drawable>{{*mesh, world_from_thing, finish_for(look, nullptr, setting)}};
}

/// A surface or an object, but for what only one of them has.
template <class Staged, class Thing>
Result<Staged> stand_up(const Thing& thing, std::size_t index, const std::string& list, Look look,
                        const Setting& setting, Rigid Staged::*world_from_thing) {
  Staged staged;
  staged.name = thing.name;
  staged.index = index;
  staged.*world_from_thing = pose_at(thing.placement, setting.time_s);
  const glm::dmat4 matrix = glm::scale((staged.*world_from_thing).matrix(), glm::dvec3(thing.scale));
  Result<std::vector<Drawable>> drawables = drawables_of(thing.mesh, matrix, look, setting);
  if (!drawables) {
    Fault fault = drawables.fault();
    fault.where = "/" + list + "/" + std::to_string(index) + "/mesh" + fault.where;
    return fault;
  }
  staged.drawables = *std::move(drawables);
  return staged;
}

}  // namespace

Rigid pose_at(const Placement& placement, double time_s) {
  const std::vector<Keyframe>& keys = placement.keys;
  if (keys.empty()) return placement.pose;
  const Between at = between(keys.size(), time_s, [&](std::size_t i) { return keys[i].time_s; });
  const Rigid& from = keys[at.from].pose;
  const Rigid& to = keys[at.to].pose;
  if (at.share == 0.0) return from;
  return {from.position_m + at.share * (to.position_m - from.position_m), slerp(from.rotation, to.rotation, at.share)};
}

Result<Stage> stage(const Project& project, const Assets& assets, double time_s) {
  const Setting setting{assets, time_s, !project.lights.empty()};
  Stage stage;
  stage.time_s = time_s;
  stage.world_from_viewer = pose_at(project.viewer.placement, time_s);
  stage.interpupillary_m = project.viewer.interpupillary_mm * 1e-3;
  stage.lights = project.lights;
  for (std::size_t i = 0; i < project.surfaces.size(); ++i) {
    const Surface& surface = project.surfaces[i];
    if (surface.hidden) continue;
    Result<StagedSurface> staged =
        stand_up(surface, i, "surfaces", nullptr, setting, &StagedSurface::world_from_surface);
    if (!staged) return staged.fault();
    staged->illumination = surface.illumination;
    stage.surfaces.push_back(*std::move(staged));
  }
  for (std::size_t i = 0; i < project.objects.size(); ++i) {
    const Object& object = project.objects[i];
    if (object.hidden) continue;
    Result<StagedObject> staged =
        stand_up(object, i, "objects", &object.appearance, setting, &StagedObject::world_from_object);
    if (!staged) return staged.fault();
    staged->depth = object.depth;
    stage.objects.push_back(*std::move(staged));
  }
  return stage;
}

}  // namespace focalstage
