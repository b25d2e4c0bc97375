#include "editor/tools/pick.h"

#include <algorithm>
#include <limits>
#include <set>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_inverse.hpp>

namespace focalstage {
namespace {

constexpr double looked_at_m = 0.5;

/// Calls `visit(name, drawables)` for surfaces and then objects.
template <class Visit>
void each_thing(const Stage& stage, Visit&& visit) {
  for (const StagedSurface& surface : stage.surfaces) visit(StagedName{"surfaces", surface.name}, surface.drawables);
  for (const StagedObject& object : stage.objects) visit(StagedName{"objects", object.name}, object.drawables);
}

glm::dvec3 world_normal(const Drawable& drawable, std::uint32_t triangle, const glm::dvec3& seen_along) {
  const glm::dvec3 normal = glm::normalize(glm::dmat3(glm::inverseTranspose(drawable.world_from_mesh)) *
                                           doubled_area(*drawable.mesh, drawable.mesh->triangles[triangle]));
  return glm::dot(normal, seen_along) > 0.0 ? -normal : normal;
}

bool inside(const RoomView& view, const std::vector<Drawable>& drawables, const glm::dvec2& low_px,
            const glm::dvec2& high_px) {
  bool any = false;
  for (const Drawable& drawable : drawables) {
    for (const glm::dvec3& p : drawable.mesh->positions_m) {
      const std::optional<glm::dvec2> pixel = pixel_of(view, glm::dvec3(drawable.world_from_mesh * glm::dvec4(p, 1.0)));
      if (!pixel || pixel->x < low_px.x || pixel->y < low_px.y || pixel->x > high_px.x || pixel->y > high_px.y) {
        return false;
      }
      any = true;
    }
  }
  return any;
}

}  // namespace

void Picker::nearer(const StagedName& thing, const std::vector<Drawable>& drawables, const Ray& ray, double from_m,
                    std::optional<PickHit>& best) {
  for (const Drawable& drawable : drawables) {
    const auto tree = trees_.try_emplace(drawable.mesh.get(), drawable.mesh).first;
    const glm::dmat4 mesh_from_world = glm::affineInverse(drawable.world_from_mesh);
    const double to_m = best ? best->distance_m : std::numeric_limits<double>::infinity();
    const std::optional<TreeHit> hit = tree->second.first(glm::dvec3(mesh_from_world * glm::dvec4(ray.origin_m, 1.0)),
                                                          glm::dmat3(mesh_from_world) * ray.direction, from_m, to_m);
    if (hit) best = PickHit{thing, hit->t, ray.at(hit->t), world_normal(drawable, hit->triangle, ray.direction)};
  }
}

std::optional<PickHit> Picker::first(const Stage& stage, const Ray& ray, const MayPick& may, double from_m) {
  std::optional<PickHit> best;
  each_thing(stage, [&](const StagedName& thing, const std::vector<Drawable>& drawables) {
    if (!may || may(thing)) nearer(thing, drawables, ray, from_m, best);
  });
  return best;
}

std::optional<PickHit> Picker::first_surface(const Stage& stage, const Ray& ray) {
  std::optional<PickHit> best;
  for (const StagedSurface& surface : stage.surfaces) {
    nearer({"surfaces", surface.name}, surface.drawables, ray, 0.0, best);
  }
  return best;
}

void Picker::keep_only(const Stage& stage) {
  std::set<const Mesh*> used;
  each_thing(stage, [&](const StagedName&, const std::vector<Drawable>& drawables) {
    for (const Drawable& drawable : drawables) used.insert(drawable.mesh.get());
  });
  std::erase_if(trees_, [&](const auto& tree) { return !used.contains(tree.first); });
}

Bounds stage_bounds(const Stage& stage, const MayPick& wanted, bool with_viewer) {
  Bounds bounds;
  each_thing(stage, [&](const StagedName& thing, const std::vector<Drawable>& drawables) {
    if (wanted && !wanted(thing)) return;
    const Bounds own = world_bounds(drawables);
    if (own.empty()) return;
    bounds.include(own.min_m);
    bounds.include(own.max_m);
  });
  if (with_viewer) {
    for (const glm::dvec3& point :
         {glm::dvec3(-0.09, -0.13, 0.18), glm::dvec3(0.09, 0.12, 0.0), glm::dvec3(0.0, 0.0, -looked_at_m)}) {
      bounds.include(stage.world_from_viewer.point(point));
    }
  }
  return bounds;
}

std::vector<StagedName> inside_box(const Stage& stage, const RoomView& view, const glm::dvec2& a_px,
                                   const glm::dvec2& b_px, const MayPick& may) {
  std::vector<StagedName> found;
  each_thing(stage, [&](const StagedName& thing, const std::vector<Drawable>& drawables) {
    if (may && !may(thing)) return;
    if (inside(view, drawables, glm::min(a_px, b_px), glm::max(a_px, b_px))) found.push_back(thing);
  });
  return found;
}

}  // namespace focalstage
