#include "core/stage/deformed_meshes.h"

#include <doctest/doctest.h>

#include <glm/geometric.hpp>

#include "core/mesh/primitives.h"
#include "core/stage/stage.h"

using namespace focalstage;

namespace {

/// A strip of 2 m along X, its left end on joint 1 and its right end on joint 2, which rises to 1 m in the second
/// second; a morph target that lifts all of it by 1 m, driven from 0 to 1 in the same time.
Assets strip(bool morphs) {
  auto mesh = std::make_shared<Mesh>();
  mesh->positions_m = {{-1, 0, 0}, {1, 0, 0}, {1, 0, 1}, {-1, 0, 1}};
  mesh->triangles = {{0, 1, 2}, {0, 2, 3}};
  auto deformation = std::make_shared<Deformation>();
  deformation->shares = {{0, 1.0}, {1, 1.0}, {1, 1.0}, {0, 1.0}};
  deformation->first_share = {0, 1, 2, 3, 4};
  deformation->targets = {{{0, 1, 2, 3}, std::vector<glm::dvec3>(4, {0, 1, 0}), {}}};
  auto model = std::make_shared<Model>();
  model->nodes.resize(3);
  model->nodes[0].pose.translation = {100, 0, 0};  // of a skinned mesh, its node's place means nothing
  model->nodes[0].skin = 0;
  model->nodes[0].parts = {{mesh, -1, deformation}};
  model->nodes[0].morph_weights = {0.0};
  model->nodes[2].pose.translation = {1, 0, 0};
  glm::dmat4 to_right(1.0);
  to_right[3] = {-1, 0, 0, 1};
  model->skins = {{{1, 2}, {glm::dmat4(1.0), to_right}}};
  AnimationChannel channel;
  channel.times_s = {1, 2};
  if (morphs) {
    channel.node = 0;
    channel.target = AnimationChannel::Target::morph_weights;
    channel.morph_weights = {0, 1};
  } else {
    channel.node = 2;
    channel.values = {{1, 0, 0, 0}, {1, 1, 0, 0}};
  }
  model->animations.push_back({"rise", {channel}});
  return {{{"assets/strip.glb", model}}};
}

Project project_with_strip() {
  Project project;
  Object object;
  object.name = "strip";
  object.mesh.shape = FileMesh{"assets/strip.glb"};
  object.placement.pose.position_m = {0, 0, -5};
  project.objects = {object};
  return project;
}

std::vector<glm::dvec3> world_points(const Stage& stage) {
  const Drawable& drawable = stage.objects.at(0).drawables.at(0);
  std::vector<glm::dvec3> points;
  for (const glm::dvec3& p : drawable.mesh->positions_m) {
    points.emplace_back(drawable.world_from_mesh * glm::dvec4(p, 1.0));
  }
  return points;
}

}  // namespace

TEST_CASE("a skin's vertices go where its joints carry them, not where its node stands") {
  const Project project = project_with_strip();
  const Assets assets = strip(false);
  CHECK(world_points(*stage(project, assets, 0.0)) ==
        std::vector<glm::dvec3>{{-1, 0, -5}, {1, 0, -5}, {1, 0, -4}, {-1, 0, -4}});
  CHECK(world_points(*stage(project, assets, 1.25)) ==
        std::vector<glm::dvec3>{{-1, 0, -5}, {1, 0.25, -5}, {1, 0.25, -4}, {-1, 0, -4}});
}

TEST_CASE("a morphing mesh moves by its targets' weights") {
  const Project project = project_with_strip();
  const Stage stood = *stage(project, strip(true), 1.75);
  CHECK(world_points(stood) == std::vector<glm::dvec3>{{-1, 0.75, -5}, {1, 0.75, -5}, {1, 0.75, -4}, {-1, 0.75, -4}});
}

TEST_CASE("what deforms has another address, what does not keeps it") {
  const Project project = project_with_strip();
  for (const bool morphs : {false, true}) {
    const Assets assets = strip(morphs);
    const Stage before = *stage(project, assets, 0.5);
    const Stage still = *stage(project, assets, 0.9);
    const Stage moved = *stage(project, assets, 1.5);
    const Stage again = *stage(project, assets, 1.5);
    const auto mesh = [](const Stage& stage) { return stage.objects[0].drawables[0].mesh; };
    CHECK(mesh(before) == mesh(still));
    CHECK(before.objects == still.objects);
    CHECK(mesh(moved) != mesh(before));
    CHECK_FALSE(moved.objects == before.objects);
    CHECK(mesh(again) == mesh(moved));
    // As a whole it may move without deforming.
    Project elsewhere = project;
    elsewhere.objects[0].placement.pose.position_m = {1, 2, 3};
    CHECK(mesh(*stage(elsewhere, assets, 1.5)) == mesh(moved));
  }
}

TEST_CASE("a deformed mesh is forgotten with its last holder, and files read anew are other meshes") {
  const Project project = project_with_strip();
  std::weak_ptr<const Mesh> seen;
  {
    const Stage stood = *stage(project, strip(false), 1.5);
    seen = stood.objects[0].drawables[0].mesh;
    CHECK(stage(project, strip(false), 1.5)->objects[0].drawables[0].mesh != seen.lock());
  }
  CHECK(seen.expired());
}
