#include "editor/tools/outline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <unordered_map>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace focalstage {
namespace {

/// Which cells of a part of the picture are covered; a ring of empty ones around.
struct Mask {
  glm::ivec2 low{0};  ///< the cell of the first, in cells of the picture
  glm::ivec2 size{0};
  std::vector<std::uint8_t> covered;

  std::uint8_t at(int x, int y) const { return covered[static_cast<std::size_t>(y * size.x + x)]; }
  void cover(const glm::ivec2& cell) {
    const glm::ivec2 p = cell - low;
    if (p.x >= 1 && p.y >= 1 && p.x < size.x - 1 && p.y < size.y - 1) {
      covered[static_cast<std::size_t>(p.y * size.x + p.x)] = 1;
    }
  }
};

constexpr double nowhere = std::numeric_limits<double>::quiet_NaN();

/// Every vertex in cells; NaN before the near plane.
std::vector<glm::dvec2> cells_of(const RoomView& view, const Drawable& drawable, double cell_px) {
  const glm::dmat4 camera_from_mesh = camera_from_world(view) * drawable.world_from_mesh;
  std::vector<glm::dvec2> cells;
  cells.reserve(drawable.mesh->positions_m.size());
  for (const glm::dvec3& mesh_m : drawable.mesh->positions_m) {
    const glm::dvec3 p(camera_from_mesh * glm::dvec4(mesh_m, 1.0));
    cells.push_back(-p.z >= view.near_m ? (view.centre_px + view.focal_px * glm::dvec2(p.x, -p.y) / -p.z) / cell_px
                                        : glm::dvec2(nowhere));
  }
  return cells;
}

void cover_triangle(const std::array<glm::dvec2, 3>& t, Mask& mask) {
  const glm::dvec2 low = glm::min(glm::min(t[0], t[1]), t[2]);
  const glm::dvec2 high = glm::max(glm::max(t[0], t[1]), t[2]);
  const glm::dvec2 first(mask.low + 1);
  const glm::dvec2 last(mask.low + mask.size - 2);
  if (!(low.x <= last.x + 1.0 && low.y <= last.y + 1.0 && high.x >= first.x && high.y >= first.y)) return;
  mask.cover(glm::ivec2(glm::floor(glm::clamp((t[0] + t[1] + t[2]) / 3.0, first, last))));  // even if very small
  const auto turn = [](const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& p) {
    return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
  };
  const double way = turn(t[0], t[1], t[2]) < 0.0 ? -1.0 : 1.0;
  const glm::ivec2 from(glm::floor(glm::clamp(low, first, last)));
  const glm::ivec2 to(glm::floor(glm::clamp(high, first, last)));
  for (int y = from.y; y <= to.y; ++y) {
    for (int x = from.x; x <= to.x; ++x) {
      const glm::dvec2 p(x + 0.5, y + 0.5);
      if (way * turn(t[0], t[1], p) >= 0.0 && way * turn(t[1], t[2], p) >= 0.0 && way * turn(t[2], t[0], p) >= 0.0) {
        mask.cover({x, y});
      }
    }
  }
}

Mask mask_of(const RoomView& view, const std::vector<Drawable>& drawables, double cell_px) {
  std::vector<std::vector<glm::dvec2>> cells;
  glm::dvec2 low(std::numeric_limits<double>::infinity());
  glm::dvec2 high = -low;
  for (const Drawable& drawable : drawables) {
    cells.push_back(cells_of(view, drawable, cell_px));
    for (const glm::dvec2& cell : cells.back()) {
      if (std::isnan(cell.x)) continue;
      low = glm::min(low, cell);
      high = glm::max(high, cell);
    }
  }
  Mask mask;
  const glm::dvec2 end = view.size_px / cell_px;
  low = glm::max(low, glm::dvec2(0.0));
  high = glm::min(high, end);
  if (!(low.x < high.x && low.y < high.y)) return mask;
  mask.low = glm::ivec2(glm::floor(low)) - 1;
  mask.size = glm::ivec2(glm::ceil(high)) - mask.low + 2;
  mask.covered.assign(static_cast<std::size_t>(mask.size.x) * static_cast<std::size_t>(mask.size.y), 0);
  for (std::size_t d = 0; d < drawables.size(); ++d) {
    for (const glm::uvec3& t : drawables[d].mesh->triangles) {
      const std::array<glm::dvec2, 3> corners{cells[d][t.x], cells[d][t.y], cells[d][t.z]};
      if (!std::isnan(corners[0].x + corners[1].x + corners[2].x)) cover_triangle(corners, mask);
    }
  }
  return mask;
}

/// The line between covered and empty cells, walked with the covered ones at its right hand; corners of cells.
std::vector<std::vector<glm::ivec2>> borders(const Mask& mask) {
  const auto key = [&](const glm::ivec2& p) { return p.y * (mask.size.x + 1) + p.x; };
  std::unordered_multimap<int, glm::ivec2> ways;  // from a corner to the next
  std::vector<glm::ivec2> starts;
  const auto add = [&](const glm::ivec2& from, const glm::ivec2& to) {
    ways.emplace(key(from), to);
    starts.push_back(from);
  };
  for (int y = 1; y < mask.size.y - 1; ++y) {
    for (int x = 1; x < mask.size.x - 1; ++x) {
      if (mask.at(x, y) == 0) continue;
      if (mask.at(x, y - 1) == 0) add({x, y}, {x + 1, y});
      if (mask.at(x + 1, y) == 0) add({x + 1, y}, {x + 1, y + 1});
      if (mask.at(x, y + 1) == 0) add({x + 1, y + 1}, {x, y + 1});
      if (mask.at(x - 1, y) == 0) add({x, y + 1}, {x, y});
    }
  }
  std::vector<std::vector<glm::ivec2>> loops;
  for (const glm::ivec2& start : starts) {
    std::vector<glm::ivec2> loop;
    glm::ivec2 at = start;
    for (auto way = ways.find(key(at)); way != ways.end(); way = ways.find(key(at))) {
      loop.push_back(at);
      at = way->second;
      ways.erase(way);
    }
    if (loop.size() > 3) loops.push_back(std::move(loop));
  }
  return loops;
}

/// Without the stairs: each point the mean of its neighbours' edges, a few times over, and every other one left out.
Outline smoothed(const std::vector<glm::ivec2>& loop, const Mask& mask, double cell_px) {
  std::vector<glm::dvec2> points;
  for (const glm::ivec2& corner : loop) points.emplace_back(corner + mask.low);
  for (int pass = 0; pass < 3 && points.size() > 8; ++pass) {
    std::vector<glm::dvec2> softer(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      const glm::dvec2& before = points[(i + points.size() - 1) % points.size()];
      softer[i] = 0.25 * before + 0.5 * points[i] + 0.25 * points[(i + 1) % points.size()];
    }
    points = std::move(softer);
  }
  Outline outline;
  const std::size_t step = points.size() > 24 ? 2 : 1;
  for (std::size_t i = 0; i < points.size(); i += step) outline.push_back(points[i] * cell_px);
  return outline;
}

}  // namespace

std::vector<Outline> outlines(const RoomView& view, const std::vector<Drawable>& drawables, double cell_px) {
  const Mask mask = mask_of(view, drawables, cell_px);
  std::vector<Outline> found;
  if (mask.covered.empty()) return found;
  for (const std::vector<glm::ivec2>& loop : borders(mask)) found.push_back(smoothed(loop, mask, cell_px));
  return found;
}

}  // namespace focalstage
