#include "tests/exact/room_of.h"

#include <utility>

namespace focalstage::exact {
namespace {

void add(const Drawable& drawable, std::size_t owner, std::vector<forward::Triangle>& triangles) {
  const Mesh& mesh = *drawable.mesh;
  for (const glm::uvec3& corners : mesh.triangles) {
    forward::Triangle triangle;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t corner = corners[static_cast<int>(i)];
      triangle.corner_m[i] = glm::dvec3(drawable.world_from_mesh * glm::dvec4(mesh.positions_m[corner], 1.0));
      triangle.uv[i] = mesh.uvs.empty() ? glm::dvec2(0.0) : mesh.uvs[corner];
    }
    triangle.owner = owner;
    triangles.push_back(triangle);
  }
}

forward::Painted painted(const Finish& finish, const Depth& depth) {
  using Focus = forward::Painted::Focus;
  const bool checker = finish.kind == Finish::Kind::checker;
  forward::Painted paint{finish.squares, finish.a.x,       checker ? finish.b.x : finish.a.x,
                         Focus::placed,  depth.vergence_d, depth.index};
  if (depth.mode == DepthMode::fixed) paint.focus = Focus::fixed;
  if (depth.mode == DepthMode::offset) paint.focus = Focus::offset;
  if (depth.mode == DepthMode::slice) paint.focus = Focus::slice;
  return paint;
}

}  // namespace

forward::Room room_of(const Stage& stage, const CompileSettings& settings) {
  forward::Room room;
  room.width_px = settings.projector.width_px;
  room.height_px = settings.projector.height_px;
  room.diamond = settings.projector.layout == PixelLayout::diamond;
  room.focal_px = settings.projector.focal_px;
  room.centre_px = settings.projector.centre_px;
  room.distortion = settings.projector.distortion;
  room.world_from_projector = settings.projector.world_from_projector.matrix();
  room.world_from_viewer = stage.world_from_viewer.matrix();
  room.interpupillary_m = stage.interpupillary_m;
  room.lens_to_pupil_m = settings.lens_to_pupil_m;
  room.powers_d = settings.slices.powers_d;
  room.nearest_rule = settings.slices.assignment == Assignment::nearest;
  room.bits = settings.bits;
  room.gamma = settings.gamma;

  std::vector<forward::Triangle> surfaces, objects;
  for (const StagedSurface& surface : stage.surfaces) {
    for (const Drawable& drawable : surface.drawables) add(drawable, 0, surfaces);
  }
  for (const StagedObject& object : stage.objects) {
    for (const Drawable& drawable : object.drawables) {
      add(drawable, room.painted.size(), objects);
      room.painted.push_back(painted(drawable.finish, object.depth));
    }
  }
  room.surfaces = forward::Caster(std::move(surfaces));
  room.objects = forward::Caster(std::move(objects));
  return room;
}

}  // namespace focalstage::exact
