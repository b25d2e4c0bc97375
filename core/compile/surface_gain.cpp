#include "core/compile/surface_gain.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "core/base/luminance.h"
#include "core/optics/pixel_density.h"
#include "core/stage/albedo.h"

namespace focalstage {
namespace {

/// Less than this comes back from nothing real: it keeps what is asked of a black surface finite.
constexpr double least_return = 1e-6;

/// One drawable of a surface as the projector sees it.
class LitDrawable {
 public:
  LitDrawable(const Drawable& drawable, const ProjectorModel& projector, double reference_per_m2)
      : drawable_(drawable),
        projector_(projector),
        projector_from_mesh_(projector.world_from_projector.inverse().matrix() * drawable.world_from_mesh),
        even_(even_albedo(drawable)),
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
  int count[tile_samples];
};

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
  const double white = settings.slices.compensation.white;
  const double content = white / (1.0 - settings.black_level);
  for (int i = 0; i < tile_samples; ++i) {
    const bool lit = sum.count[i] > 0;
    const glm::dvec3 back = lit ? sum.back[i] / static_cast<double>(sum.count[i]) : glm::dvec3(0.0);
    out.light[i] = lit ? gain(white, sum.density[i] / sum.count[i]) : 0.0f;
    for (int c = 0; c < 3; ++c) {
      const double returned = settings.channels == 1 ? luminance(back.r, back.g, back.b) : back[c];
      out.content[c][i] = lit ? gain(content, returned) : 0.0f;
    }
  }
}

}  // namespace

int exposures_of(const CompileSettings& settings, Side side) {
  const ImageEye own = side == Side::left ? ImageEye::left : ImageEye::right;
  return static_cast<int>(std::count_if(settings.images.begin(), settings.images.end(), [&](const ImageSpec& image) {
    return image.eye == own || image.eye == ImageEye::both;
  }));
}

std::optional<SurfaceGains> surface_gains(const CompileSettings& settings, const ProjectorRays& rays,
                                          const ProjectorHits& met, const std::vector<ViewDrawable>& surfaces) {
  const Compensation& asked = settings.slices.compensation;
  if (asked.mode == CompensationMode::off) return std::nullopt;
  const double reference_per_m2 =
      asked.mode == CompensationMode::even ? pixels_per_m2_on_axis(settings.projector, settings.reference_m) : 0.0;
  std::vector<LitDrawable> lit;
  for (const ViewDrawable& surface : surfaces)
    lit.emplace_back(*surface.drawable, settings.projector, reference_per_m2);
  SurfaceGains gains;
  gains.tiles.resize(rays.grid.count());
  for (const Side side : both_sides) {
    gains.leak[side] =
        static_cast<float>(settings.black_level * exposures_of(settings, side) / (1.0 - settings.black_level));
  }
  tbb::parallel_for(std::size_t{0}, gains.tiles.size(), [&](std::size_t tile) {
    TileReturn sum{};
    for (int s = 0; s < rays.subsamples; ++s)
      add(met.tiles[static_cast<std::size_t>(s) * gains.tiles.size() + tile], lit, sum);
    set_gains(settings, sum, gains.tiles[tile]);
  });
  return gains;
}

}  // namespace focalstage
