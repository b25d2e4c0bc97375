#include "core/sensitivity/light_path.h"

#include <cmath>

#include "core/optics/look.h"
#include "core/optics/vergence.h"

namespace focalstage {
namespace {

/// Axial distance from the lens centre of a point in eye space.
double before_lens_m(const Eye& eye, const glm::dvec3& eye_point_m) { return -eye_point_m.z - eye.lens_to_pupil_m; }

/// Where a straight look meets a surface, in eye space.
std::optional<glm::dvec3> met(const RoomOfLight& room, const Eye& eye, const glm::dvec2& straight) {
  const Rigid world_from_eye = eye.eye_from_world.inverse();
  const glm::dvec3 along(straight, -1.0);
  const auto distance =
      room.surfaces.first(world_from_eye.position_m, world_from_eye.direction(along), eye.lens_to_pupil_m);
  if (!distance) return std::nullopt;
  return *distance * along;
}

double nearest(const std::vector<double>& powers_d, double wanted_d) {
  double best_d = powers_d.front();
  for (const double power_d : powers_d) {
    if (std::abs(power_d - wanted_d) < std::abs(best_d - wanted_d)) best_d = power_d;
  }
  return best_d;
}

}  // namespace

Result<RoomOfLight> RoomOfLight::of(const Project& project, const Assets& assets, double time_s) {
  Result<Stage> stood = focalstage::stage(project, assets, time_s);
  if (!stood) return stood.fault();
  Result<RayRoom> rays = RayRoom::of(stood->surfaces);
  if (!rays) return rays.fault();
  const PerEye<Eye> eyes =
      eyes_of(stood->world_from_viewer, stood->interpupillary_m, project.glasses.lens_to_pupil_mm * 1e-3);
  return RoomOfLight{*std::move(stood), *std::move(rays), eyes, projector_model(project.projectors.front())};
}

std::optional<Seen> meant(const RoomOfLight& room, Side side, const Depth& depth, const glm::dvec3& point_m) {
  const Eye& eye = room.eyes[side];
  const glm::dvec3 at_m = eye.eye_from_world.point(point_m);
  const double placed_m = before_lens_m(eye, at_m);
  if (!(placed_m > 0.0)) return std::nullopt;
  return Seen{straight_look(at_m), wanted_vergence_d(depth, placed_m)};
}

std::optional<Exposed> exposed(const RoomOfLight& room, Side side, const Depth& depth,
                               const std::vector<double>& powers_d, const Seen& wanted) {
  constexpr int most_rounds = 30;
  constexpr double still = 1e-9;
  const Eye& eye = room.eyes[side];
  glm::dvec2 straight = wanted.look;
  Exposed made;
  glm::dvec3 at_m(0.0);
  for (int round = 0; round < most_rounds; ++round) {
    const auto hit = met(room, eye, straight);
    if (!hit) return std::nullopt;
    at_m = *hit;
    const double surface_m = before_lens_m(eye, at_m);
    // The slice is chosen once: where two are as near, steps could go between them for ever.
    if (round == 0) {
      const bool pinned = depth.mode == DepthMode::slice && static_cast<std::size_t>(depth.index) < powers_d.size();
      made.power_d = pinned ? powers_d[static_cast<std::size_t>(depth.index)]
                            : nearest(powers_d, 1.0 / surface_m - wanted.vergence_d);
    }
    const glm::dvec2 next = wanted.look / look_stretch(made.power_d, surface_m, eye.lens_to_pupil_m);
    const bool stands = glm::length(next - straight) < still;
    straight = next;
    if (stands) break;
  }
  const auto pixel = pixel_of_world(room.projector, eye.eye_from_world.inverse().point(at_m));
  const bool inside = pixel && pixel->x >= 0.0 && pixel->y >= 0.0 && pixel->x < room.projector.width_px &&
                      pixel->y < room.projector.height_px;
  if (!inside) return std::nullopt;
  made.pixel = *pixel;
  return made;
}

std::optional<Seen> arrived(const RoomOfLight& room, Side side, const glm::dvec2& pixel, double power_d) {
  const Rigid& light = room.projector.world_from_projector;
  const glm::dvec3 along = light.direction(glm::dvec3(tangent_of_pixel(room.projector, pixel), -1.0));
  const auto distance = room.surfaces.first(light.position_m, along, 0.0);
  if (!distance) return std::nullopt;
  const Eye& eye = room.eyes[side];
  const glm::dvec3 at_m = eye.eye_from_world.point(light.position_m + *distance * along);
  const double surface_m = before_lens_m(eye, at_m);
  if (!(surface_m > 0.0)) return std::nullopt;
  return Seen{straight_look(at_m) * look_stretch(power_d, surface_m, eye.lens_to_pupil_m),
              image_vergence_d(surface_m, power_d)};
}

}  // namespace focalstage
