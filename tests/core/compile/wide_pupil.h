#pragma once

#include <cmath>
#include <optional>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "core/compile/frame.h"
#include "core/optics/eye.h"
#include "core/stage/stage.h"
#include "tests/support/chance.h"

// An eye with a wide pupil, by rays alone: what it sees of the virtual objects themselves, and what it sees of compiled
// images on real surfaces through a thin lens. No vergence, blur or look of the engine: every ray leaves the pupil at
// its own height, is bent by the lens where it meets it, ends on the nearest triangle and reads the pixel that lights
// that spot. Objects are unlit, flat or checkered, and stand where they come into focus.

namespace focalstage::wide_pupil {

struct Ray {
  glm::dvec3 start_m;
  glm::dvec3 way;
};

struct Met {
  const Drawable* drawable = nullptr;
  double along = 0.0;
  glm::dvec2 uv{0.0};
};

/// Where the ray meets a triangle, by Cramer's rule.
inline std::optional<Met> meet(const Ray& ray, const Drawable& drawable, const glm::uvec3& t) {
  const Mesh& mesh = *drawable.mesh;
  const auto corner = [&](std::uint32_t i) {
    return glm::dvec3(drawable.world_from_mesh * glm::dvec4(mesh.positions_m[i], 1.0));
  };
  const glm::dvec3 a = corner(t.x), ab = corner(t.y) - a, ac = corner(t.z) - a, from = ray.start_m - a;
  const glm::dvec3 across = glm::cross(ray.way, ac), around = glm::cross(from, ab);
  const double volume = glm::dot(ab, across);
  if (std::abs(volume) < 1e-18) return std::nullopt;
  const double b = glm::dot(from, across) / volume, c = glm::dot(ray.way, around) / volume;
  const double along = glm::dot(ac, around) / volume;
  constexpr double rim = 1e-12;
  if (b < -rim || c < -rim || b + c > 1.0 + rim || along <= 0.0) return std::nullopt;
  const auto uv = [&](std::uint32_t i) { return mesh.uvs.empty() ? glm::dvec2(0.0) : mesh.uvs[i]; };
  return Met{&drawable, along, (1.0 - b - c) * uv(t.x) + b * uv(t.y) + c * uv(t.z)};
}

template <class Thing>
std::optional<Met> nearest(const Ray& ray, const std::vector<Thing>& things) {
  std::optional<Met> first;
  for (const Thing& thing : things) {
    for (const Drawable& drawable : thing.drawables) {
      for (const glm::uvec3& t : drawable.mesh->triangles) {
        const auto met = meet(ray, drawable, t);
        if (met && (!first || met->along < first->along)) first = met;
      }
    }
  }
  return first;
}

inline double gray(const Met& met) {
  const Finish& finish = met.drawable->finish;
  if (finish.kind != Finish::Kind::checker) return finish.a.x;
  const auto square = static_cast<long>(std::floor(met.uv.x * finish.squares.x)) +
                      static_cast<long>(std::floor(met.uv.y * finish.squares.y));
  return square % 2 == 0 ? finish.a.x : finish.b.x;
}

class WideEye {
 public:
  WideEye(const Stage& stage, const CompileSettings& settings, Side side)
      : stage_(stage),
        settings_(settings),
        side_(side),
        world_from_eye_(eyes_of(stage.world_from_viewer, stage.interpupillary_m, settings.lens_to_pupil_m)[side]
                            .eye_from_world.inverse()),
        projector_from_world_(settings.projector.world_from_projector.inverse()) {}

  /// The ray that leaves the pupil's point `pupil_m` with slopes `slope`.
  Ray ray(const glm::dvec2& pupil_m, const glm::dvec2& slope) const {
    return {world_from_eye_.point({pupil_m, 0.0}), world_from_eye_.direction({slope, -1.0})};
  }

  double of_objects(const glm::dvec2& pupil_m, const glm::dvec2& slope) const {
    const auto met = nearest(ray(pupil_m, slope), stage_.objects);
    return met ? gray(*met) : 0.0;
  }

  /// The light of all slices of this eye along the same ray, each through its power of the lens.
  double of_images(const FrameImages& images, const glm::dvec2& pupil_m, const glm::dvec2& slope) const {
    const glm::dvec2 at_lens = pupil_m + slope * settings_.lens_to_pupil_m;
    const ImageEye own = side_ == Side::left ? ImageEye::left : ImageEye::right;
    double sum = 0.0;
    for (std::size_t i = 0; i < images.count; ++i) {
      if (settings_.images[i].eye != own) continue;
      const Ray bent{world_from_eye_.point({at_lens, -settings_.lens_to_pupil_m}),
                     world_from_eye_.direction({slope - settings_.images[i].power_d * at_lens, -1.0})};
      const auto met = nearest(bent, stage_.surfaces);
      if (met) sum += pixel(images, i, bent.start_m + bent.way * met->along);
    }
    return sum;
  }

 private:
  /// Gray images of gamma 1.
  double pixel(const FrameImages& images, std::size_t image, const glm::dvec3& world_m) const {
    const glm::dvec3 point_m = projector_from_world_.point(world_m);
    const glm::dvec2 px = pixel_of_tangent(settings_.projector, glm::dvec2(point_m) / -point_m.z);
    if (!(px.x >= 0.0 && px.y >= 0.0 && px.x < images.width_px && px.y < images.height_px)) return 0.0;
    const auto at =
        static_cast<std::size_t>(px.y) * static_cast<std::size_t>(images.width_px) + static_cast<std::size_t>(px.x);
    return images.image(image)[at] / 255.0;
  }

  const Stage& stage_;
  const CompileSettings& settings_;
  Side side_;
  Rigid world_from_eye_;
  Rigid projector_from_world_;
};

/// Sums of squared errors of some images' focal stack against the objects themselves.
struct StackErrors {
  std::vector<double> sums;  ///< one per set of images
  int values = 0;

  double psnr_db(std::size_t i) const { return -10.0 * std::log10(sums[i] / values); }
};

/// Mean light of one spot of the retina, `grain` wide, over the pupil: by the objects, then by each set of images.
inline std::vector<double> seen(const WideEye& eye, const std::vector<const FrameImages*>& sets, const glm::dvec2& look,
                                double grain, double focus_d, double pupil_m, support::Chance& chance) {
  constexpr int rings = 20, sectors = 20;
  std::vector<double> sums(sets.size() + 1, 0.0);
  for (int ring = 0; ring < rings; ++ring) {
    for (int sector = 0; sector < sectors; ++sector) {
      const double radius_m = pupil_m / 2.0 * std::sqrt((ring + chance.between(0.0, 1.0)) / rings);
      const double angle = 2.0 * M_PI * (sector + chance.between(0.0, 1.0)) / sectors;
      const glm::dvec2 height_m = radius_m * glm::dvec2(std::cos(angle), std::sin(angle));
      const glm::dvec2 u = look + grain * glm::dvec2(chance.between(-0.5, 0.5), chance.between(-0.5, 0.5));
      const glm::dvec2 slope = u - height_m * focus_d;  // all rays of u meet at the distance in focus
      sums[0] += eye.of_objects(height_m, slope);
      for (std::size_t i = 0; i < sets.size(); ++i) sums[i + 1] += eye.of_images(*sets[i], height_m, slope);
    }
  }
  for (double& sum : sums) sum /= rings * sectors;
  return sums;
}

/// Errors over `looks` looks within `reach` of a place where the nearest object changes, and over the focuses given
/// (vergences at the pupil).
inline StackErrors errors_near_edges(const WideEye& eye, const Stage& stage,
                                     const std::vector<const FrameImages*>& sets, const glm::dvec2& low,
                                     const glm::dvec2& high, double reach, double grain, int looks,
                                     const std::vector<double>& foci_d, double pupil_m, support::Chance& chance) {
  StackErrors errors{std::vector<double>(sets.size(), 0.0), 0};
  const auto object = [&](const glm::dvec2& look) {
    const auto met = nearest(eye.ray({0.0, 0.0}, look), stage.objects);
    return met ? met->drawable : nullptr;
  };
  for (int found = 0; found < looks;) {
    const glm::dvec2 look{chance.between(low.x, high.x), chance.between(low.y, high.y)};
    const Drawable* const here = object(look);
    bool edge = false;
    for (const glm::dvec2& off :
         {glm::dvec2(reach, 0), glm::dvec2(-reach, 0), glm::dvec2(0, reach), glm::dvec2(0, -reach)}) {
      const Drawable* const there = object(look + off);
      edge = edge || (here != nullptr && there != nullptr && here != there);
    }
    if (!edge) continue;
    ++found;
    for (const double focus_d : foci_d) {
      const std::vector<double> light = seen(eye, sets, look, grain, focus_d, pupil_m, chance);
      for (std::size_t i = 0; i < sets.size(); ++i)
        errors.sums[i] += (light[i + 1] - light[0]) * (light[i + 1] - light[0]);
      ++errors.values;
    }
  }
  return errors;
}

}  // namespace focalstage::wide_pupil
