#include "core/percept/things.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include <tbb/parallel_for.h>
#include <glm/geometric.hpp>

#include "core/optics/eye.h"
#include "core/optics/pixel_density.h"
#include "core/retina/slice_maps.h"
#include "core/retina/surface_raster.h"

namespace focalstage {
namespace {

constexpr double nearest_m = 1e-3;  ///< to the lens centre, as in the compiler

/// One kind of things as the eye sees them through no power: whose each face is, and the nearest in each pixel.
struct Seen {
  SurfaceMesh mesh;
  std::vector<std::int32_t> owner;  ///< of each face, in the map's things
  SurfaceRaster raster;
};

template <class Staged>
void add_things(const std::vector<Staged>& staged, SeenThing::Kind kind, ThingMap& map, Seen& seen) {
  for (const Staged& one : staged) {
    const auto own = static_cast<std::int32_t>(map.things.size());
    map.things.push_back({kind, one.name, one.index});
    for (const Drawable& drawable : one.drawables) append(seen.mesh, drawable);
    seen.owner.resize(seen.mesh.faces.size(), own);
  }
}

/// How bright a projector makes what it lights.
class Brightness {
 public:
  /// `reference_m`: where light is counted as what would fall there.
  Brightness(const ProjectorModel& projector, const ProjectorFlux& flux, const std::optional<double>& reference_m)
      : projector_from_world_(projector.world_from_projector.inverse()),
        projector_(projector),
        reference_per_m2_(reference_m ? pixels_per_m2_on_axis(projector, *reference_m) : 0.0),
        lumens_per_pixel_(flux.lumens / (static_cast<double>(projector.width_px) * projector.height_px) *
                          flux.exposure_share) {}

  /// Candela per square metre and light of a face's point.
  double at(const SurfaceMesh& mesh, std::uint32_t face, const glm::dvec3& world_m) const {
    const glm::uvec3& corners = mesh.faces[face];
    const glm::dvec3 a = mesh.points_m[corners.x];
    const glm::dvec3 normal = glm::normalize(glm::cross(mesh.points_m[corners.y] - a, mesh.points_m[corners.z] - a));
    const glm::dvec3 point_m = projector_from_world_.point(world_m);
    if (!(point_m.z < 0.0)) return 0.0;
    const double per_m2 = reference_per_m2_ > 0.0
                              ? reference_per_m2_
                              : pixels_per_m2(projector_, point_m, projector_from_world_.direction(normal));
    return lumens_per_pixel_ * per_m2 / std::numbers::pi;
  }

 private:
  Rigid projector_from_world_;
  ProjectorModel projector_;
  double reference_per_m2_;  ///< 0: light is counted where it falls
  double lumens_per_pixel_;  ///< over a whole period, of one exposure at full code
};

}  // namespace

ThingMap things_seen(const RetinaInput& input, const RetinaView& view, const ProjectorFlux& flux,
                     const std::stop_token& stop) {
  const auto pixels = static_cast<std::size_t>(view.width_px) * static_cast<std::size_t>(view.height_px);
  ThingMap map;
  map.width_px = view.width_px;
  map.height_px = view.height_px;
  map.thing.assign(pixels, ThingMap::nothing);
  map.vergence_d.assign(pixels, std::numeric_limits<float>::quiet_NaN());
  map.candela_per_light.assign(pixels, 0.0f);
  const Eye eye = eye_of(input, view);
  const LookGrid grid = grid_of(view, 0);
  Seen objects, surfaces;
  add_things(input.stage->objects, SeenThing::Kind::object, map, objects);
  add_things(input.stage->surfaces, SeenThing::Kind::surface, map, surfaces);
  for (Seen* seen : {&objects, &surfaces}) {
    seen->raster = raster_surfaces(seen->mesh, eye.eye_from_world, grid, eye.lens_to_pupil_m + nearest_m, stop);
    if (stop.stop_requested()) return map;
  }
  const Rigid world_from_eye = eye.eye_from_world.inverse();
  const ProjectorFlux counted{flux.lumens / input.level, flux.exposure_share};  // what counts as 1
  const Brightness brightness(input.projector, counted, input.falloff_reference_m);
  tbb::parallel_for(0, view.height_px, [&](int row) {
    for (int column = 0; column < view.width_px; ++column) {
      const std::size_t pixel =
          static_cast<std::size_t>(row) * static_cast<std::size_t>(view.width_px) + static_cast<std::size_t>(column);
      const glm::dvec2 look = grid.look(column, row);
      for (const Seen* seen : {&surfaces, &objects}) {  // objects are drawn over whatever stands before them
        const std::uint32_t face = seen->raster.at(column, row);
        if (face == SurfaceRaster::nothing) continue;
        const double depth_m = 1.0 / seen->raster.faces[face].inverse_depth(look);
        map.thing[pixel] = seen->owner[face];
        map.vergence_d[pixel] = static_cast<float>(1.0 / (depth_m - eye.lens_to_pupil_m));
        if (seen != &surfaces || !(flux.lumens > 0.0)) continue;
        map.candela_per_light[pixel] =
            static_cast<float>(brightness.at(seen->mesh, face, world_from_eye.point(glm::dvec3(look, -1.0) * depth_m)));
      }
    }
  });
  return map;
}

}  // namespace focalstage
