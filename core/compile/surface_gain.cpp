#include "core/compile/surface_gain.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "core/base/luminance.h"
#include "core/compile/blend.h"
#include "core/optics/pixel_density.h"
#include "core/stage/albedo.h"

namespace focalstage {
namespace {

/// Less than this comes back from nothing real: it keeps what is asked of a black surface finite.
constexpr double least_return = 1e-6;

/// One drawable of a surface as the projector sees it.
class LitDrawable {
 public:
  LitDrawable(const Drawable& drawable, const ProjectorModel& projector, double reference_per_m2, bool painted)
      : drawable_(drawable),
        projector_(projector),
        projector_from_mesh_(projector.world_from_projector.inverse().matrix() * drawable.world_from_mesh),
        even_(painted ? even_albedo(drawable) : glm::dvec3(1.0)),
        reference_per_m2_(reference_per_m2) {}

  glm::dvec3 albedo(std::uint32_t triangle, const glm::dvec3& point_m) const {
    if (even_) return *even_;
    const Corners at = corners(triangle);
    return albedo_at(drawable_, triangle, corner_weights(at.a, at.b, at.c, point_m));
  }

  /// How densely pixels lie against the reference; 1 where nobody asks.
  double density(std::uint32_t triangle, const glm::dvec3& point_m) const {
    if (!(reference_per_m2_ > 0.0)) return 1.0;
    const Corners at = corners(triangle);
    const glm::dvec3 normal = glm::normalize(glm::cross(at.b - at.a, at.c - at.a));
    return pixels_per_m2(projector_, point_m, normal) / reference_per_m2_;
  }

 private:
  struct Corners {
    glm::dvec3 a, b, c;
  };
  Corners corners(std::uint32_t triangle) const {
    const Mesh& mesh = *drawable_.mesh;
    const glm::uvec3& t = mesh.triangles[triangle];
    const auto point = [&](std::uint32_t i) {
      return glm::dvec3(projector_from_mesh_ * glm::dvec4(mesh.positions_m[i], 1.0));
    };
    return {point(t.x), point(t.y), point(t.z)};
  }

  const Drawable& drawable_;
  const ProjectorModel& projector_;
  glm::dmat4 projector_from_mesh_;
  std::optional<glm::dvec3> even_;
  double reference_per_m2_;
};

/// What comes back of the light of the pixels of one tile: means over their samples that meet a surface.
struct TileReturn {
  glm::dvec3 back[tile_samples];
  double density[tile_samples];
  double weight[tile_samples];  ///< the projector's share of what is shown
  double black[tile_samples];   ///< Blend::Tile's
  int count[tile_samples];
};

void add_blend(const Blend::Tile& shared, const TileMet& met, TileReturn& sum) {
  for (int i = 0; i < tile_samples; ++i) {
    if (met.drawable[i] < 0) continue;
    sum.weight[i] += shared.weight[i];
    sum.black[i] += shared.black[i];
  }
}

void add(const TileMet& met, const std::vector<LitDrawable>& surfaces, TileReturn& sum) {
  if (!met.any) return;
  for (int i = 0; i < tile_samples; ++i) {
    if (met.drawable[i] < 0) continue;
    const LitDrawable& surface = surfaces[static_cast<std::size_t>(met.drawable[i])];
    const glm::dvec3 point_m(met.x[i], met.y[i], met.z[i]);
    const double density = surface.density(met.triangle[i], point_m);
    sum.back[i] += surface.albedo(met.triangle[i], point_m) * density;
    sum.density[i] += density;
    ++sum.count[i];
  }
}

float gain(double white, double back) { return static_cast<float>(white / std::max(back, least_return)); }

void set_gains(const CompileSettings& settings, const TileReturn& sum, TileGain& out) {
  const bool off = settings.slices.compensation.mode == CompensationMode::off;
  const bool alone = settings.blend.empty();
  const double white = off ? 1.0 : settings.slices.compensation.white;
  const double content = off ? 1.0 : white / (1.0 - settings.black_level);
  for (int i = 0; i < tile_samples; ++i) {
    const bool lit = sum.count[i] > 0;
    const double count = std::max(sum.count[i], 1);
    const glm::dvec3 back = lit ? sum.back[i] / count : glm::dvec3(0.0);
    const double weight = alone ? 1.0 : sum.weight[i] / count;
    out.light[i] = lit ? gain(white * weight, sum.density[i] / count) : 0.0f;
    out.leak[i] = alone || !lit ? 1.0f : gain(weight * sum.black[i] / count, sum.density[i] / count);
    for (int c = 0; c < 3; ++c) {
      const double returned = settings.channels == 1 ? luminance(back.r, back.g, back.b) : back[c];
      out.content[c][i] = lit ? gain(content * weight, returned) : 0.0f;
    }
  }
}

/// A projector alone takes off its own black; of several each takes off its part of what all leak, point by point.
float leak_of(const CompileSettings& settings, Side side) {
  if (!makes_up_for_black(settings)) return 0.0f;
  const double black = settings.blend.empty() ? settings.black_level : 1.0;
  return static_cast<float>(black * exposures_of(settings, side) / (1.0 - settings.black_level));
}

/// The density that counts as 1; 0 where nobody asks for it.
double reference_of(const CompileSettings& settings) {
  if (settings.slices.compensation.mode != CompensationMode::even) return 0.0;
  const double per_m2 = pixels_per_m2_on_axis(settings.projector, settings.reference_m);
  return settings.blend.empty() ? per_m2 : per_m2 / settings.blend.at(settings.blend_own).level;
}

}  // namespace

int exposures_of(const CompileSettings& settings, Side side) {
  const ImageEye own = side == Side::left ? ImageEye::left : ImageEye::right;
  return static_cast<int>(std::count_if(settings.images.begin(), settings.images.end(), [&](const ImageSpec& image) {
    return image.eye == own || image.eye == ImageEye::both;
  }));
}

bool makes_up_for_black(const CompileSettings& settings) {
  if (settings.slices.compensation.mode == CompensationMode::off) return false;
  return settings.black_level > 0.0 || std::any_of(settings.blend.begin(), settings.blend.end(),
                                                   [](const BlendProjector& one) { return one.black_level > 0.0; });
}

std::optional<SurfaceGains> surface_gains(const CompileSettings& settings, const ProjectorRays& rays,
                                          const ProjectorHits& met, const std::vector<ViewDrawable>& surfaces,
                                          const Kernel& kernel) {
  const CompensationMode mode = settings.slices.compensation.mode;
  if (mode == CompensationMode::off && settings.blend.empty()) return std::nullopt;
  std::vector<LitDrawable> lit;
  for (const ViewDrawable& surface : surfaces) {
    lit.emplace_back(*surface.drawable, settings.projector, reference_of(settings), mode != CompensationMode::off);
  }
  std::optional<Blend> blend;
  if (!settings.blend.empty()) blend.emplace(settings.blend, surfaces, kernel);
  SurfaceGains gains;
  gains.counts = mode != CompensationMode::off;
  gains.tiles.resize(rays.grid.count());
  for (const Side side : both_sides) gains.leak[side] = leak_of(settings, side);
  tbb::parallel_for(std::size_t{0}, gains.tiles.size(), [&](std::size_t tile) {
    TileReturn sum{};
    for (int s = 0; s < rays.subsamples; ++s) {
      const TileMet& here = met.tiles[static_cast<std::size_t>(s) * gains.tiles.size() + tile];
      add(here, lit, sum);
      if (!blend || !here.any) continue;
      Blend::Tile shared;
      blend->share(settings.blend_own, here, mode == CompensationMode::even, shared);
      add_blend(shared, here, sum);
    }
    set_gains(settings, sum, gains.tiles[tile]);
  });
  return gains;
}

}  // namespace focalstage
