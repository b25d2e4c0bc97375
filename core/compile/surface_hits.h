#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "core/compile/kernel.h"
#include "core/compile/tile.h"
#include "core/optics/eye.h"
#include "core/optics/projector_model.h"
#include "core/stage/stage.h"

namespace focalstage {

/// Where the samples of one tile leave the projector: positions in its tangent plane, NaN outside the image.
struct TileRays {
  double x[tile_samples];
  double y[tile_samples];
};

/// Tiles in rows, once per sample of a pixel: [subsample][tile].
struct ProjectorRays {
  TileGrid grid;
  int subsamples = 1;
  std::vector<TileRays> tiles;
};

/// The rays of every sample; the samples of a pixel lie on a regular square grid in it.
ProjectorRays projector_rays(const ProjectorModel& projector, int samples_per_pixel);

/// What the rays of one tile meet first: a triangle of a surface and the point on it, in projector space.
struct TileMet {
  std::int32_t drawable[tile_samples];  ///< -1: nothing
  std::uint32_t triangle[tile_samples];
  double x[tile_samples];
  double y[tile_samples];
  double z[tile_samples];
  bool any = false;
};

/// The points that the projector lights: [subsample][tile], as ProjectorRays.
struct ProjectorHits {
  std::vector<TileMet> tiles;
};

/// The surfaces as a projector sees them, to be asked along any look within `bounds` of its tangent plane.
class ProjectorSight {
 public:
  ProjectorSight(const ProjectorModel& projector, const std::vector<ViewDrawable>& surfaces, const Box& bounds,
                 int columns, int rows);

  void meet(const TileRays& rays, const Kernel& kernel, TileMet& met) const;

 private:
  ViewTriangles view_;
  Cells cells_;
};

/// Around all that leaves the projector.
Box bounds_of(const ProjectorRays& rays);

ProjectorHits projector_hits(const ProjectorRays& rays, const ProjectorSight& sight, const Kernel& kernel);
ProjectorHits projector_hits(const ProjectorRays& rays, const ProjectorModel& projector,
                             const std::vector<ViewDrawable>& surfaces, const Kernel& kernel);

/// One tile of an eye: its hits and their bounds.
struct EyeTile {
  TileHits hits;
  double origin_x = 0.0;  ///< of the tile in the eye's tangent plane
  double origin_y = 0.0;
  Box straight{};  ///< straight looks, in the tangent plane
  float min_surface_m = 0.0f;
  float max_surface_m = 0.0f;
  float min_inverse_m = 0.0f;
  float max_inverse_m = 0.0f;
  float max_slope = 0.0f;  ///< largest absolute value
  bool any = false;
};

struct EyeHits {
  std::vector<EyeTile> tiles;
};

/// The projector's points as `eye` sees them, without those that a surface hides from it.
EyeHits eye_hits(const ProjectorHits& met, const TileGrid& grid, const Rigid& world_from_projector, const Eye& eye,
                 const std::vector<ViewDrawable>& surfaces, Breathing breathing, const Kernel& kernel);

/// Single-precision looks of one tile about the first that is a number; where there is none, `any` stays false.
struct LocalLooks {
  TileLooks looks;
  double origin_x = 0.0;
  double origin_y = 0.0;
  bool any = false;
};

LocalLooks local_looks(const double* x, const double* y, const Kernel& kernel);

/// Nearer to the pupil than this nobody sees anything: just before the lens.
double nearest_seen_m(double lens_to_pupil_m);

/// The cells' and triangles' pointers for the kernel.
KernelView kernel_view(const ViewTriangles& view, const Cells& cells);

}  // namespace focalstage
