#pragma once

#include <vector>

#include "core/compile/frame.h"
#include "core/compile/projector_reach.h"
#include "core/compile/surface_hits.h"

namespace focalstage {

/// How the projectors of a project share the surfaces that several of them light (docs/blending.md).
class Blend {
 public:
  /// Of `projectors` on `surfaces`, in the caller's arena; both must outlive it.
  Blend(const std::vector<BlendProjector>& projectors, const std::vector<ViewDrawable>& surfaces, const Kernel& kernel);

  /// What the projectors do to the points of one tile.
  struct Tile {
    double weight[tile_samples];  ///< the part that the projector asked for has of what is shown there
    double black[tile_samples];   ///< of all that light the point: black level times how densely their light falls
  };

  /// For projector number `own`, whose rays met `met`. The weights of all projectors that light a point sum to one.
  /// `thins`: whether light is counted by how densely pixels lie, else it falls alike from each.
  void share(std::size_t own, const TileMet& met, bool thins, Tile& out) const;

 private:
  SurfacePoint point_of(const TileMet& met, int i, const Rigid& world_from_projector) const;
  double light(std::size_t projector, const SurfacePoint& point, bool thins) const;

  const std::vector<BlendProjector>& projectors_;
  const std::vector<ViewDrawable>& surfaces_;
  const Kernel& kernel_;
  std::vector<ProjectorReach> reaches_;
};

}  // namespace focalstage
