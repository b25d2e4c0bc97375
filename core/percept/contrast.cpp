#include "core/percept/contrast.h"

#include <algorithm>
#include <limits>
#include <numbers>

#include "core/percept/seen_frame.h"
#include "core/schedule/seen.h"
#include "core/schedule/slots.h"

namespace focalstage {
namespace {

SurfaceContrast contrast_of(const Project& project, const Schedule& schedule, const LitSurface& surface, Side side) {
  const Projector& projector = project.projectors.front();
  const RoomLight room = room_light_of(project);
  SurfaceContrast contrast;
  contrast.index = surface.index;
  double leaked = 0.0;  // exposures, those of the other eye by how much of them comes through
  for (const SeenExposure& seen : seen_exposures(schedule, shutter_speed(project.glasses), side)) {
    contrast.exposures += seen.own ? 1 : 0;
    for (const PowerShare& part : seen.powers) leaked += part.share;
  }
  contrast.leak = projector.black_level * leaked;
  contrast.knows_ambient = !(room.ambient_lux > 0.0) || room.flux.lumens > 0.0;
  const WornGlasses glasses = worn_glasses(project.glasses);
  const double pixels = static_cast<double>(projector.width_px) * projector.height_px;
  const double white_lux = room.flux.lumens / pixels * surface.pixels_per_m2;
  for (const PowerShare& part : ambient_shares(schedule, glasses, side, room, white_lux))
    contrast.ambient += part.share;
  contrast.white = 1.0 - projector.black_level + contrast.black();
  contrast.white_cd_m2 = contrast.white * white_lux * room.flux.exposure_share * surface.albedo / std::numbers::pi;
  return contrast;
}

}  // namespace

double SurfaceContrast::ratio() const {
  return black() > 0.0 ? white / black() : std::numeric_limits<double>::infinity();
}

std::vector<SurfaceContrast> contrasts_of(const Project& project, const Schedule& schedule,
                                          const std::vector<LitSurface>& surfaces) {
  std::vector<SurfaceContrast> contrasts;
  if (project.projectors.empty()) return contrasts;
  for (const LitSurface& surface : surfaces) {
    const SurfaceContrast left = contrast_of(project, schedule, surface, Side::left);
    const SurfaceContrast right = contrast_of(project, schedule, surface, Side::right);
    contrasts.push_back(right.ratio() < left.ratio() ? right : left);
  }
  return contrasts;
}

}  // namespace focalstage
