#include "core/reference/seen.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "core/optics/eye.h"
#include "core/optics/transfer.h"
#include "core/reference/chances.h"
#include "core/reference/colour.h"
#include "core/reference/ray_room.h"

namespace focalstage {
namespace {

constexpr double nearest_m = 1e-3;  ///< to the lens and to the projector, as in the compiler

glm::dvec2 in_disc(double radius, double a, double b) {
  const double r = radius * std::sqrt(a), turn = 2.0 * std::numbers::pi * b;
  return {r * std::cos(turn), r * std::sin(turn)};
}

/// Focus of red, green and blue about the view's, in dioptres at the pupil, by the chromatic eye of Thibos et al. 1992.
std::array<double, 3> colour_offsets_d(bool chromatic) {
  if (!chromatic) return {0.0, 0.0, 0.0};
  const auto refraction_d = [](double nm) { return 1.68524 - 633.46 / (nm - 214.102); };
  return {refraction_d(550.0) - refraction_d(610.0), 0.0, refraction_d(550.0) - refraction_d(465.0)};
}

/// The eye, its lens, the room and the projector, with all that is the same for every ray.
class RayEye {
 public:
  RayEye(const RetinaInput& input, const RetinaView& view, RayRoom room)
      : input_(input), view_(view), room_(std::move(room)), offsets_d_(colour_offsets_d(view.chromatic)) {
    const Stage& stage = *input.stage;
    const Rigid moved{view.head_offset_m, {1.0, 0.0, 0.0, 0.0}};
    const PerEye<Eye> eyes = eyes_of(stage.world_from_viewer * moved, stage.interpupillary_m, input.lens_to_pupil_m);
    world_from_eye_ = eyes[view.eye].eye_from_world.inverse();
    projector_from_world_ = input.projector.world_from_projector.inverse();
    // The same accommodation seen from the pupil, d_e further on: 1 / (1/a + d_e).
    focus_at_pupil_d_ = view.focus_d / (1.0 + view.focus_d * input.lens_to_pupil_m);
    if (view.diffraction && view.pupil_m > 0.0) diffraction_ = 2.0 * 0.42 * 550e-9 / view.pupil_m;
    for (int code = 0; code < 256; ++code) {
      light_of_code_[static_cast<std::size_t>(code)] =
          input.black_level + (1.0 - input.black_level) * share_of_code(code, input.bits, input.gamma, input.transfer);
    }
  }

  int colours() const { return view_.chromatic ? 3 : 1; }

  /// Adds what one ray of one colour's focus (all of them: colour 0 of 1) brings of an exposure.
  void add(const RetinaExposure& exposure, const glm::dvec2& pixel, int colour, const Chances& chance, double weight,
           double* rgb) const {
    const auto [power_d, share] = moment_of(exposure.powers, chance[4]);
    if (!(share > 0.0)) return;
    const std::optional<Spot> spot = spot_of(pixel, colour, chance, power_d);
    const std::optional<glm::dvec2> at = spot ? projected(spot->world_m, chance) : std::nullopt;
    if (!at) return;
    const auto x = static_cast<std::size_t>(at->x), y = static_cast<std::size_t>(at->y);
    const auto width = static_cast<std::size_t>(input_.projector.width_px);
    const auto channels = static_cast<std::size_t>(input_.channels);
    const std::uint8_t* const codes = &exposure.codes[(y * width + x) * channels];
    const glm::dvec3 back = albedo(spot->hit) * density(*spot);
    for (std::size_t c = 0; c < 3; ++c) {
      if (view_.chromatic && static_cast<int>(c) != colour) continue;
      rgb[c] += weight * share * light_of_code_[codes[channels == 3 ? c : 0]] * back[static_cast<int>(c)];
    }
  }

  /// The same of the room's own light, which falls on all that is there.
  void add_ambient(const glm::dvec2& pixel, int colour, const Chances& chance, double weight, double* rgb) const {
    const auto [power_d, share] = moment_of(input_.ambient, chance[4]);
    if (!(share > 0.0)) return;
    const std::optional<Spot> spot = spot_of(pixel, colour, chance, power_d);
    if (!spot) return;
    const glm::dvec3 back = albedo(spot->hit);
    for (std::size_t c = 0; c < 3; ++c) {
      if (view_.chromatic && static_cast<int>(c) != colour) continue;
      rgb[c] += weight * share * back[static_cast<int>(c)];
    }
  }

 private:
  /// A moment of the exposure: all moments are as likely as their share, whose sum every ray carries.
  static PowerShare moment_of(const std::vector<PowerShare>& powers, double chance) {
    double all = 0.0;
    for (const PowerShare& part : powers) all += part.share;
    double left = chance * all;
    for (const PowerShare& part : powers) {
      left -= part.share;
      if (left < 0.0) return {part.power_d, all};
    }
    return {powers.empty() ? 0.0 : powers.back().power_d, all};
  }

  /// Where a ray into the eye comes from.
  struct Spot {
    RayHit hit;
    glm::dvec3 world_m;
  };

  const Drawable& drawable(const RayHit& hit) const {
    return input_.stage->surfaces[hit.surface].drawables[hit.drawable];
  }

  glm::dvec3 albedo(const RayHit& hit) const {
    return glm::clamp(colour_at(drawable(hit), hit.triangle, hit.shares, glm::dvec3(0.0), {}), 0.0, 1.0);
  }

  /// Pixels on a little square of the surface there, against one square to the axis at the reference.
  double density(const Spot& spot) const {
    if (!input_.falloff_reference_m) return 1.0;
    constexpr double side_m = 1e-4;
    const Drawable& drawn = drawable(spot.hit);
    const glm::uvec3& corners = drawn.mesh->triangles[spot.hit.triangle];
    const auto point = [&](std::uint32_t i) {
      return glm::dvec3(drawn.world_from_mesh * glm::dvec4(drawn.mesh->positions_m[i], 1.0));
    };
    const glm::dvec3 edge = point(corners.y) - point(corners.x);
    const glm::dvec3 normal = glm::cross(edge, point(corners.z) - point(corners.x));
    const glm::dvec3 u = glm::normalize(edge), v = glm::normalize(glm::cross(normal, edge));
    const auto place = [&](const glm::dvec3& world_m) {
      const glm::dvec3 seen_m = projector_from_world_.point(world_m);
      return place_of_tangent(input_.projector, glm::dvec2(seen_m) / -seen_m.z);
    };
    const glm::dvec2 across = place(spot.world_m + 0.5 * side_m * u) - place(spot.world_m - 0.5 * side_m * u);
    const glm::dvec2 up = place(spot.world_m + 0.5 * side_m * v) - place(spot.world_m - 0.5 * side_m * v);
    const double pixels_per_m2 = std::abs(across.x * up.y - across.y * up.x) / (side_m * side_m);
    const double reference_m = *input_.falloff_reference_m;
    return pixels_per_m2 * reference_m * reference_m / (input_.projector.focal_px.x * input_.projector.focal_px.y);
  }

  /// The spot of a surface that a ray into the eye comes from.
  std::optional<Spot> spot_of(const glm::dvec2& pixel, int colour, const Chances& chance, double power_d) const {
    const double lens_m = input_.lens_to_pupil_m;
    const glm::dvec2 look = look_of_pixel(view_, pixel) + in_disc(diffraction_, chance[5], chance[6]);
    const glm::dvec2 pupil_m = in_disc(view_.pupil_m / 2.0, chance[2], chance[3]);
    // Rays of one retinal point part in the pupil and meet where the eye is focused.
    const glm::dvec2 slope = look - pupil_m * (focus_at_pupil_d_ + offsets_d_[static_cast<std::size_t>(colour)]);
    const glm::dvec2 at_lens_m = pupil_m + lens_m * slope;
    if (glm::length(at_lens_m) > input_.lens_aperture_m / 2.0) return std::nullopt;
    const glm::dvec2 beyond = slope - power_d * at_lens_m;
    const glm::dvec3 from_m = world_from_eye_.point({at_lens_m, -lens_m});
    const glm::dvec3 along = world_from_eye_.direction({beyond, -1.0});
    const std::optional<RayHit> met = room_.hit(from_m, along, nearest_m);
    if (!met) return std::nullopt;
    return Spot{*met, from_m + along * met->along};
  }

  /// The place in the projector's image from which a spot has its light.
  std::optional<glm::dvec2> projected(const glm::dvec3& spot_m, const Chances& chance) const {
    const ProjectorModel& projector = input_.projector;
    const glm::dvec3 seen_m = projector_from_world_.point(spot_m);
    if (!(seen_m.z < -nearest_m)) return std::nullopt;
    const glm::dvec2 tangent = glm::dvec2(seen_m) / -seen_m.z;
    glm::dvec2 place = place_of_tangent(projector, tangent);
    glm::dvec2 pixel = pixel_of_place(projector, place);
    const auto inside = [&] {
      return pixel.x >= 0.0 && pixel.y >= 0.0 && pixel.x < projector.width_px && pixel.y < projector.height_px;
    };
    if (!inside()) return std::nullopt;
    const bool folded =
        !projector.distortion.empty() && glm::length(tangent_of_pixel(projector, pixel) - tangent) > 1e-6;
    if (folded || !room_.free(projector.world_from_projector.position_m, spot_m)) return std::nullopt;
    if (input_.projector_focus.depth_of_field_d > 0.0) {
      const double off_d = std::abs(1.0 / -seen_m.z - input_.projector_focus.focus_d);
      glm::dvec2 aside = in_disc(off_d / input_.projector_focus.depth_of_field_d, chance[7], chance[8]);
      if (projector.layout == PixelLayout::diamond) aside.y *= 2.0;  // round in the room: rows lie half as far apart
      place += aside;
      pixel = pixel_of_place(projector, place);
      if (!inside()) return std::nullopt;
    }
    return pixel;
  }

  const RetinaInput& input_;
  const RetinaView& view_;
  RayRoom room_;
  Rigid world_from_eye_, projector_from_world_;
  std::array<double, 3> offsets_d_;
  double focus_at_pupil_d_ = 0.0;
  double diffraction_ = 0.0;
  std::array<double, 256> light_of_code_{};
};

void see_pixel(const RayEye& eye, const RetinaInput& input, const RetinaView& view, int per_pixel, int index,
               float* rgb) {
  double sum[3] = {0.0, 0.0, 0.0};
  const glm::dvec2 corner(index % view.width_px, index / view.width_px);
  for (int ray = 0; ray < per_pixel; ++ray) {
    const Chances chance = chances_of(index, ray);
    const glm::dvec2 pixel = corner + glm::dvec2(chance[0], chance[1]);
    for (const RetinaExposure& exposure : input.exposures) {
      for (int colour = 0; colour < eye.colours(); ++colour)
        eye.add(exposure, pixel, colour, chance, 1.0 / per_pixel, sum);
    }
    for (int colour = 0; colour < eye.colours(); ++colour) eye.add_ambient(pixel, colour, chance, 1.0 / per_pixel, sum);
  }
  for (int c = 0; c < 3; ++c) rgb[c] = static_cast<float>(sum[c]);
}

}  // namespace

Result<RetinaImage> see_by_rays(const RetinaInput& input, const RetinaView& view, const RayCount& rays,
                                std::stop_token stop) {
  if (Status fits = check_retina(input, view); !fits) return fits.fault();
  if (rays.per_pixel < 1 || rays.per_pixel > 65536) {
    return Fault{"reference.rays", "", "a pixel takes 1 to 65536 rays", "ask for fewer or more"};
  }
  auto room = RayRoom::of(input.stage->surfaces);
  if (!room) return room.fault();
  const RayEye eye(input, view, *std::move(room));
  RetinaImage image{view.width_px, view.height_px, {}};
  image.rgb.resize(static_cast<std::size_t>(view.width_px) * static_cast<std::size_t>(view.height_px) * 3);
  tbb::task_arena arena(rays.threads > 0 ? rays.threads : tbb::task_arena::automatic);
  arena.execute([&] {
    tbb::parallel_for(0, view.width_px * view.height_px, [&](int index) {
      if (!stop.stop_requested())
        see_pixel(eye, input, view, rays.per_pixel, index, &image.rgb[3 * static_cast<std::size_t>(index)]);
    });
  });
  if (stop.stop_requested()) return Fault{"retina.cancelled", "", "stopped before the picture was done", ""};
  if (input.level != 1.0) {
    for (float& value : image.rgb) value *= static_cast<float>(input.level);
  }
  return image;
}

}  // namespace focalstage
