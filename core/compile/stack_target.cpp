#include "core/compile/stack_target.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/common.hpp>

#include "core/base/luminance.h"
#include "core/compile/cuts.h"
#include "core/compile/ray_samples.h"

namespace focalstage {
namespace {

struct Plane {
  double x, y, rest;
  double at(const glm::dvec2& look) const { return x * look.x + y * look.y + rest; }
};

/// A wanted vergence, affine in the look from the pupil's centre, as a function of the look from `pupil_m`: there the
/// same light is met along `look` + `pupil_m` a.
Plane from_pupil(const Plane& a, const glm::dvec2& pupil_m) {
  const double per = 1.0 / (1.0 - a.x * pupil_m.x - a.y * pupil_m.y);
  return {a.x * per, a.y * per, a.rest * per};
}

/// The triangle as it is met along looks from `pupil_m`, with `a` as from_pupil gave it.
void move(const ViewTriangle& from, const Plane& a, const glm::dvec2& pupil_m, ViewTriangle& to) {
  for (int i = 0; i < 4; ++i) {
    const double along = from.a[i] * pupil_m.x + from.b[i] * pupil_m.y;
    to.a[i] = from.a[i] + along * a.x;
    to.b[i] = from.b[i] + along * a.y;
    to.c[i] = from.c[i] + along * a.rest;
  }
  to.drawable = from.drawable;
  to.triangle = from.triangle;
}

/// Bounds of the moved triangle: its looks shift by at most the pupil's height times its wanted vergences.
ViewBounds moved_bounds(const ViewBounds& from, double low_d, double high_d, const glm::dvec2& pupil_m) {
  const auto [left, right] = std::minmax({-pupil_m.x * low_d, -pupil_m.x * high_d});
  const auto [down, up] = std::minmax({-pupil_m.y * low_d, -pupil_m.y * high_d});
  constexpr double slack = 1e-6;
  ViewBounds to = from;
  to.box.min_x += static_cast<float>(left - slack);
  to.box.max_x += static_cast<float>(right + slack);
  to.box.min_y += static_cast<float>(down - slack);
  to.box.max_y += static_cast<float>(up + slack);
  return to;
}

Box moved(const Box& box, const glm::dvec2& by) {
  constexpr float slack = 1e-6f;
  const auto x = static_cast<float>(by.x);
  const auto y = static_cast<float>(by.y);
  return {box.min_x + x - slack, box.min_y + y - slack, box.max_x + x + slack, box.max_y + y + slack};
}

}  // namespace

struct StackTarget::Seen {
  const std::vector<Candidate>* candidates = nullptr;
  TileLooks looks;
  double origin_x = 0.0;
  double origin_y = 0.0;
  glm::dvec2 pupil_m{0.0};
  std::vector<Plane> wanted;
  std::vector<ViewTriangle> triangles;
  std::vector<ViewBounds> bounds;
  std::vector<std::uint32_t> items;
  std::uint32_t begin[2] = {0, 0};

  /// The look from the pupil's centre that meets the same point of a candidate.
  glm::dvec2 from_centre(std::size_t which, const glm::dvec2& look) const {
    return look + pupil_m * wanted[which].at(look);
  }

  void move_all(const EyeView& all, const glm::dvec2& to) {
    pupil_m = to;
    const std::size_t count = candidates->size();
    for (std::size_t i = 0; i < count; ++i) {
      const Candidate& candidate = (*candidates)[i];
      const Plane centre{candidate.per_x, candidate.per_y, candidate.rest};
      wanted[i] = from_pupil(centre, pupil_m);
      move(all.view.triangles[candidate.triangle], wanted[i], pupil_m, triangles[i]);
      bounds[i] = moved_bounds(all.view.bounds[candidate.triangle], candidate.low_d, candidate.high_d, pupil_m);
    }
  }
};

StackTarget::StackTarget(const EyeView& all, const PixelLooks& looks, const StackPlan& plan,
                         const std::vector<SliceSetup>& slices, int channels, const Kernel& kernel)
    : all_(all), looks_(looks), plan_(plan), slices_(slices), channels_(channels), kernel_(kernel) {}

std::vector<StackTarget::Candidate> StackTarget::candidates(const StackTile& tile, const LookTile& looks) const {
  // Beyond the outermost slices light counts as lying on them, so that no ray goes further aside than this.
  const double low_d = tile.slice_d.back();
  const double high_d = tile.slice_d.front();
  const double aside = plan_.pupil_m / 2.0 * 1.05 * (high_d - low_d);
  const glm::dvec2 pixel = glm::abs(looks.look_per_pixel[0]) + glm::abs(looks.look_per_pixel[1]);
  Box box{std::numeric_limits<float>::infinity(), std::numeric_limits<float>::infinity(),
          -std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity()};
  for (int i = 0; i < tile_samples; ++i) {
    if ((tile.asked >> i & 1) == 0) continue;
    box = hull(box, {looks.x[i], looks.y[i], looks.x[i], looks.y[i]});
  }
  const auto across = static_cast<float>(aside + pixel.x);
  const auto down = static_cast<float>(aside + pixel.y);
  box = {box.min_x - across, box.min_y - down, box.max_x + across, box.max_y + down};

  const CellGrid& grid = all_.cells.grid;
  std::vector<std::uint32_t> found;
  for (int row = row_of(grid, box.min_y); row <= row_of(grid, box.max_y); ++row) {
    for (int column = column_of(grid, box.min_x); column <= column_of(grid, box.max_x); ++column) {
      const auto cell = static_cast<std::size_t>(row * grid.columns + column);
      for (std::uint32_t i = all_.cells.begin[cell]; i < all_.cells.begin[cell + 1]; ++i) {
        const std::uint32_t index = all_.cells.items[i];
        const Box& own = all_.view.bounds[index].box;
        if (own.min_x <= box.max_x && box.min_x <= own.max_x && own.min_y <= box.max_y && box.min_y <= own.max_y) {
          found.push_back(index);
        }
      }
    }
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());

  std::vector<Candidate> out;
  for (const std::uint32_t index : found) {
    const ViewTriangle& triangle = all_.view.triangles[index];
    const ViewBounds& bounds = all_.view.bounds[index];
    const double middle = 0.5 * (static_cast<double>(bounds.min_inverse_m) + bounds.max_inverse_m);
    WantedVergence wanted =
        wanted_vergence(all_.rules[triangle.drawable], slices_, looks.surface_mean_m, middle, all_.lens_to_pupil_m);
    const auto [least, most] = std::minmax({wanted.at(bounds.min_inverse_m), wanted.at(bounds.max_inverse_m)});
    const bool beyond = most <= low_d || least >= high_d;
    if (beyond) wanted = {0.0, most <= low_d ? low_d : high_d};
    out.push_back({index, wanted.per_inverse_m * triangle.a[3], wanted.per_inverse_m * triangle.b[3],
                   wanted.per_inverse_m * triangle.c[3] + wanted.rest_d, beyond ? wanted.rest_d : least,
                   beyond ? wanted.rest_d : most});
  }
  return out;
}

void StackTarget::add_ray(const StackTile& tile, std::size_t focus, const Seen& seen, std::vector<float>& out) const {
  const KernelView view{seen.triangles.data(),  seen.bounds.data(),
                        {{}, 1, 1, 0.0f, 0.0f}, seen.begin,
                        seen.items.data(),      static_cast<float>(all_.view.nearest_m)};
  TileNearest nearest;
  kernel_.cover(view, seen.looks, seen.origin_x, seen.origin_y, nearest);
  if (all_.cuts) {
    const auto is_cut = [&](std::uint32_t which, double x, double y) {
      const ViewTriangle& triangle = all_.view.triangles[(*seen.candidates)[which].triangle];
      const glm::dvec2 centre = seen.from_centre(which, {x, y});
      return all_.shaders[triangle.drawable].is_cut(triangle, centre.x, centre.y);
    };
    pass_cuts(view, seen.looks, seen.origin_x, seen.origin_y, is_cut, nearest);
  }
  for (int i = 0; i < tile_samples; ++i) {
    if (nearest.triangle[i] < 0 || (tile.asked >> i & 1) == 0) continue;
    const auto which = static_cast<std::size_t>(nearest.triangle[i]);
    const ViewTriangle& triangle = all_.view.triangles[(*seen.candidates)[which].triangle];
    const glm::dvec2 look{seen.origin_x + static_cast<double>(seen.looks.x[i]),
                          seen.origin_y + static_cast<double>(seen.looks.y[i])};
    const glm::dvec2 centre = seen.from_centre(which, look);
    const glm::dvec3 color = all_.shaders[triangle.drawable].color(triangle, centre.x, centre.y);
    const std::size_t cell = focus * tile_samples + static_cast<std::size_t>(i);
    if (channels_ == 1) {
      out[cell] += static_cast<float>(luminance(color.r, color.g, color.b));
      continue;
    }
    for (std::size_t c = 0; c < 3; ++c) {
      out[c * plan_.focus_count() * tile_samples + cell] += static_cast<float>(color[static_cast<int>(c)]);
    }
  }
}

void StackTarget::tile(std::size_t slot, std::vector<float>& out) const {
  const StackTile& tile = plan_.tiles[slot];
  out.assign(static_cast<std::size_t>(channels_) * plan_.focus_count() * tile_samples, 0.0f);
  if (tile.asked == 0) return;
  const LookTile& looks = looks_.tiles[static_cast<std::size_t>(tile.row * plan_.grid.columns() + tile.column)];
  const std::vector<Candidate> met = candidates(tile, looks);
  if (met.empty()) return;

  double x[tile_samples];
  double y[tile_samples];
  std::copy_n(looks.x, tile_samples, x);
  std::copy_n(looks.y, tile_samples, y);
  const LocalLooks local = local_looks(x, y, kernel_);
  thread_local Seen seen;
  seen.candidates = &met;
  seen.looks = local.looks;
  seen.wanted.resize(met.size());
  seen.triangles.resize(met.size());
  seen.bounds.resize(met.size());
  seen.items.resize(met.size());
  for (std::size_t i = 0; i < met.size(); ++i) seen.items[i] = static_cast<std::uint32_t>(i);
  seen.begin[1] = static_cast<std::uint32_t>(met.size());
  for (const RaySample& sample : ray_samples()) {
    seen.move_all(all_, sample.pupil * (plan_.pupil_m / 2.0));
    for (std::size_t k = 0; k < plan_.focus_count(); ++k) {
      const glm::dvec2 off = looks.look_per_pixel * sample.pixel - seen.pupil_m * tile.focus_d[k];
      seen.origin_x = local.origin_x + off.x;
      seen.origin_y = local.origin_y + off.y;
      seen.looks.all = moved(local.looks.all, off);
      add_ray(tile, k, seen, out);
    }
  }
  for (float& value : out) value /= static_cast<float>(rays_per_pixel);
}

}  // namespace focalstage
