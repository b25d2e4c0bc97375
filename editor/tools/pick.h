#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/mesh/measure.h"
#include "core/stage/stage.h"
#include "core/stage/world_bounds.h"
#include "editor/tools/mesh_tree.h"
#include "editor/tools/room_view.h"

namespace focalstage {

/// One thing of the stage, as edits name it: list "surfaces" or "objects".
struct StagedName {
  std::string list;
  std::string name;
  bool operator==(const StagedName&) const = default;
};

struct PickHit {
  StagedName thing;
  double distance_m = 0.0;
  glm::dvec3 point_m{0.0};
  glm::dvec3 normal{0.0, 0.0, 1.0};  ///< in the world, of length one, towards where the ray came from
};

/// Whether a thing may be hit: what is locked may not.
using MayPick = std::function<bool(const StagedName&)>;

/// Finds what a ray meets first on a stage. Keeps a tree per mesh, by the mesh's address: moving a thing costs nothing.
/// One thread's.
class Picker {
 public:
  /// The nearest thing beyond `from_m`; an empty `may` lets all be hit.
  std::optional<PickHit> first(const Stage& stage, const Ray& ray, const MayPick& may = {}, double from_m = 0.0);

  /// The same among the real surfaces alone.
  std::optional<PickHit> first_surface(const Stage& stage, const Ray& ray);

  /// Forgets the meshes that the stage no longer has.
  void keep_only(const Stage& stage);

  /// Makes `best` the thing's own hit if that is nearer.
  void nearer(const StagedName& thing, const std::vector<Drawable>& drawables, const Ray& ray, double from_m,
              std::optional<PickHit>& best);

  std::size_t meshes() const { return trees_.size(); }

 private:
  std::map<const Mesh*, MeshTree> trees_;  ///< each holds its mesh, so that no address is used twice
};

/// Around surfaces and objects of the stage for which `wanted` (all, where it is empty); with `with_viewer` also around
/// the viewer's head and half a metre of what it looks at, so that an empty room has a size too.
Bounds stage_bounds(const Stage& stage, const MayPick& wanted = {}, bool with_viewer = false);

/// The things that lie wholly inside the rectangle from `a_px` to `b_px` (any two opposite corners).
std::vector<StagedName> inside_box(const Stage& stage, const RoomView& view, const glm::dvec2& a_px,
                                   const glm::dvec2& b_px, const MayPick& may = {});

}  // namespace focalstage
