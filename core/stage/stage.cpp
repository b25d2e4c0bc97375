#include "core/stage/stage.h"

#include <optional>
#include <utility>

#include <glm/gtc/matrix_transform.hpp>

#include "core/process/process.h"
#include "core/stage/animation.h"
#include "core/stage/deformed_meshes.h"
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

/// The look of a thing's parts: of an object its appearance, of a surface its albedo, which is what it is itself.
struct Look {
  const Appearance* appearance = nullptr;
  const Albedo* albedo = nullptr;
  std::shared_ptr<const Texture> picture{};
};

Finish finish_for(const Look& look, const Material* material, const Mesh& mesh, const Setting& setting) {
  Finish finish = look.albedo ? finish_of(*look.albedo, material, look.picture)
                              : finish_of(*look.appearance, material, setting.has_lights, look.picture);
  finish.vertex_colors = finish.vertex_colors && !mesh.colors.empty();
  return finish;
}

/// What the source's steps make of a mesh of it.
Result<std::shared_ptr<const Mesh>> finished(const MeshSource& source, const std::shared_ptr<const Mesh>& mesh,
                                             double scale, const glm::dmat4& thing_from_mesh = glm::dmat4(1.0)) {
  Result<std::shared_ptr<const Mesh>> made = processed_once(mesh, source.process, scale, thing_from_mesh);
  if (made) return made;
  Fault fault = made.fault();
  fault.where = "/process" + fault.where;
  return fault;
}

/// The nodes of a model at one moment; what moves vertices is looked up where there is some.
class StoodModel {
 public:
  StoodModel(const Model& model, double time_s)
      : model_(model), time_s_(time_s), model_from_node_(model_from_nodes(model, poses_at(model, time_s))) {}

  /// A part's mesh and where it stands.
  Drawable place(std::size_t node, const ModelPart& part) {
    if (!part.deformation) return {part.mesh, model_from_node_[node], {}};
    if (!weights_) weights_ = morph_weights_at(model_, time_s_);
    const int skin = model_.nodes[node].skin;
    const bool carried = skin >= 0 && !part.deformation->first_share.empty();
    Deformed state{(*weights_)[node], carried ? mesh_from_joints(skin) : std::vector<glm::dmat4>()};
    return {deformed_mesh(part, std::move(state)), carried ? glm::dmat4(1.0) : model_from_node_[node], {}};
  }

 private:
  std::vector<glm::dmat4> mesh_from_joints(int index) const {
    const Skin& skin = model_.skins[static_cast<std::size_t>(index)];
    std::vector<glm::dmat4> matrices;
    for (std::size_t i = 0; i < skin.joints.size(); ++i) {
      matrices.push_back(model_from_node_[static_cast<std::size_t>(skin.joints[i])] * skin.joint_from_mesh[i]);
    }
    return matrices;
  }

  const Model& model_;
  double time_s_;
  std::vector<glm::dmat4> model_from_node_;
  std::optional<std::vector<std::vector<double>>> weights_;
};

/// Where the nodes lie as long as nothing moves them: what is done to a mesh is done there.
std::vector<glm::dmat4> resting_nodes(const Model& model) {
  std::vector<NodePose> poses;
  for (const Node& node : model.nodes) poses.push_back(node.pose);
  return model_from_nodes(model, poses);
}

Result<std::vector<Drawable>> model_drawables(const Model& model, const MeshSource& source, double scale,
                                              const glm::dmat4& world_from_thing, const Look& look,
                                              const Setting& setting) {
  StoodModel stood(model, setting.time_s);
  const std::vector<glm::dmat4> resting = source.process.empty() ? std::vector<glm::dmat4>() : resting_nodes(model);
  std::vector<Drawable> drawables;
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    for (const ModelPart& part : model.nodes[i].parts) {
      const Material* material =
          part.material < 0 ? nullptr : &model.materials[static_cast<std::size_t>(part.material)];
      if (part.deformation && !source.process.empty()) {
        return Fault{"process.deforming", "/process/0",
                     "its vertices move, and steps are for a mesh that keeps its shape",
                     "remove the steps, or process the file where it was made"};
      }
      Drawable& drawable = drawables.emplace_back(stood.place(i, part));
      Result<std::shared_ptr<const Mesh>> mesh =
          source.process.empty() ? drawable.mesh : finished(source, drawable.mesh, scale, resting[i]);
      if (!mesh) return mesh.fault();
      drawable.mesh = *std::move(mesh);
      drawable.world_from_mesh = world_from_thing * drawable.world_from_mesh;
      drawable.finish = finish_for(look, material, *drawable.mesh, setting);
    }
  }
  return drawables;
}

/// `scale`: of the thing, which is in `world_from_thing` already.
Result<std::vector<Drawable>> drawables_of(const MeshSource& source, double scale, const glm::dmat4& world_from_thing,
                                           const Look& look, const Setting& setting) {
  if (const auto* file = std::get_if<FileMesh>(&source.shape)) {
    const auto found = setting.assets.models.find(file->file);
    if (found == setting.assets.models.end() || !found->second) {
      return Fault{"stage.asset-missing", "/file", "the file " + file->file + " is not among the loaded assets",
                   "put it beside the project"};
    }
    return model_drawables(*found->second, source, scale, world_from_thing, look, setting);
  }
  Result<std::shared_ptr<const Mesh>> mesh = primitive_mesh(source.shape);
  if (!mesh) {
    Fault fault = mesh.fault();
    fault.where = "/" + fault.where;
    return fault;
  }
  mesh = finished(source, *mesh, scale);
  if (!mesh) return mesh.fault();
  return std::vector<Drawable>{{*mesh, world_from_thing, finish_for(look, nullptr, **mesh, setting)}};
}

/// How an object looks at the moment, `index` being its place in the project's list.
Result<Look> look_of(const Object& object, std::size_t index, const Setting& setting) {
  auto picture = picture_of(object.appearance, setting.assets, setting.time_s);
  if (picture) return Look{&object.appearance, nullptr, *std::move(picture)};
  Fault fault = picture.fault();
  fault.where = "/objects/" + std::to_string(index) + "/appearance" + fault.where;
  return fault;
}

/// What a surface is itself; its picture, if it has one, is read as a still one's.
Result<Look> look_of(const Surface& surface, std::size_t index, const Setting& setting) {
  const auto* file = std::get_if<FileAlbedo>(&surface.albedo);
  if (!file) return Look{nullptr, &surface.albedo, {}};
  ImageAppearance image;
  image.file = file->file;
  auto picture = picture_of(image, setting.assets, setting.time_s);
  if (picture) return Look{nullptr, &surface.albedo, *std::move(picture)};
  Fault fault = picture.fault();
  fault.where = "/surfaces/" + std::to_string(index) + "/albedo/file";
  return fault;
}

/// A surface or an object, but for what only one of them has.
template <class Staged, class Thing>
Result<Staged> stand_up(const Thing& thing, std::size_t index, const std::string& list, const Look& look,
                        const Setting& setting, Rigid Staged::*world_from_thing) {
  Staged staged;
  staged.name = thing.name;
  staged.index = index;
  staged.*world_from_thing = pose_at(thing.placement, setting.time_s);
  const glm::dmat4 matrix = glm::scale((staged.*world_from_thing).matrix(), glm::dvec3(thing.scale));
  Result<std::vector<Drawable>> drawables = drawables_of(thing.mesh, thing.scale, matrix, look, setting);
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
    const Result<Look> look = look_of(surface, i, setting);
    if (!look) return look.fault();
    Result<StagedSurface> staged = stand_up(surface, i, "surfaces", *look, setting, &StagedSurface::world_from_surface);
    if (!staged) return staged.fault();
    staged->illumination = surface.illumination;
    stage.surfaces.push_back(*std::move(staged));
  }
  for (std::size_t i = 0; i < project.objects.size(); ++i) {
    const Object& object = project.objects[i];
    if (object.hidden) continue;
    const Result<Look> look = look_of(object, i, setting);
    if (!look) return look.fault();
    Result<StagedObject> staged = stand_up(object, i, "objects", *look, setting, &StagedObject::world_from_object);
    if (!staged) return staged.fault();
    if (shows_nothing(object.appearance, time_s)) staged->drawables.clear();
    staged->depth = object.depth;
    stage.objects.push_back(*std::move(staged));
  }
  return stage;
}

}  // namespace focalstage
