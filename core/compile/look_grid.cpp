#include "core/compile/look_grid.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace focalstage {
namespace {

constexpr std::size_t piece_size = 4096;
constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr Box nowhere{infinity, infinity, -infinity, -infinity};

// What reaches behind the viewer reaches to infinity in the tangent plane; nobody looks that far aside.
constexpr float widest = 4.0f;

LookSpan hull(const LookSpan& a, const LookSpan& b, const LookSpan& c) {
  return {std::min(std::min(a.first_column, b.first_column), c.first_column),
          std::max(std::max(a.last_column, b.last_column), c.last_column),
          std::min(std::min(a.first_row, b.first_row), c.first_row),
          std::max(std::max(a.last_row, b.last_row), c.last_row)};
}

bool within(const Box& box, const Box& all) {
  return all.min_x <= box.min_x && box.max_x <= all.max_x && all.min_y <= box.min_y && box.max_y <= all.max_y;
}

/// Looks along one axis, at (i + 0.5) / count of the way across the bounds.
struct Axis {
  float low;
  float per;  ///< looks per tangent unit
  float count;

  Axis(float from, float to, int of)
      : low(from), per(static_cast<float>(of) / std::max(to - from, 1e-12f)), count(static_cast<float>(of)) {}

  // Wider than single precision can be wrong in some hundred looks; whether a look is met is asked in double.
  static constexpr float slack = 1e-3f;

  std::int16_t first_from(float at) const { return static_cast<std::int16_t>(before((at - low) * per + 0.5f - slack)); }
  std::int16_t last_to(float at) const {
    return static_cast<std::int16_t>(before((at - low) * per + 0.5f + slack) - 1);
  }

  /// How many looks lie before a position counted in looks from half a look before the first.
  int before(float position) const {
    return position > 0.0f ? static_cast<int>(position < count ? position : count) : 0;
  }
};

struct Axes {
  Axis x, y;

  Axes(const Box& bounds, int side) : x(bounds.min_x, bounds.max_x, side), y(bounds.min_y, bounds.max_y, side) {}

  LookSpan span_of(const Box& box) const {
    return {x.first_from(box.min_x), x.last_to(box.max_x), y.first_from(box.min_y), y.last_to(box.max_y)};
  }
};

bool holds(const ViewTriangle& triangle, const glm::dvec2& look) {
  return triangle.edge(0, look.x, look.y) >= 0.0 && triangle.edge(1, look.x, look.y) >= 0.0 &&
         triangle.edge(2, look.x, look.y) >= 0.0;
}

}  // namespace

glm::dvec2 LookGrid::look(int column, int row) const {
  return {bounds_.min_x + (static_cast<double>(bounds_.max_x) - bounds_.min_x) * (column + 0.5) / side_,
          bounds_.min_y + (static_cast<double>(bounds_.max_y) - bounds_.min_y) * (row + 0.5) / side_};
}

double LookGrid::look_area() const {
  return (static_cast<double>(bounds_.max_x) - bounds_.min_x) * (static_cast<double>(bounds_.max_y) - bounds_.min_y) /
         (static_cast<double>(side_) * side_);
}

void LookGrid::cut_into_pieces(const std::vector<ViewDrawable>& drawables) {
  pieces_.clear();
  for (std::uint32_t i = 0; i < drawables.size(); ++i) {
    const std::size_t count = drawables[i].drawable->mesh->triangles.size();
    for (std::size_t first = 0; first < count; first += piece_size) {
      pieces_.push_back({i, first, std::min(count, first + piece_size)});
    }
  }
}

/// Triangles seen edge-on show nothing and do not count.
Box LookGrid::bounds_of(const Piece& piece, const Mesh& mesh) const {
  const ViewPoints& points = seen_[piece.drawable].points;
  Box bounds = nowhere;
  ViewTriangle unused;
  for (std::size_t i = piece.first; i < piece.end; ++i) {
    const Box box = front_bounds(points, mesh.triangles[i]).box;
    if (within(box, bounds) || !set_up_triangle(points, mesh.triangles[i], false, unused)) continue;
    bounds = hull(bounds, box);
  }
  return bounds;
}

void LookGrid::find_bounds(const std::vector<ViewDrawable>& drawables) {
  std::vector<Box> each(pieces_.size());
  tbb::parallel_for(std::size_t{0}, pieces_.size(), [&](std::size_t i) {
    each[i] = bounds_of(pieces_[i], *drawables[pieces_[i].drawable].drawable->mesh);
  });
  bounds_ = nowhere;
  for (const Box& box : each) bounds_ = hull(bounds_, box);
  bounds_ = {std::max(bounds_.min_x, -widest), std::max(bounds_.min_y, -widest), std::min(bounds_.max_x, widest),
             std::min(bounds_.max_y, widest)};
}

/// Which looks lie in the box of each point alone; those in a triangle's box follow without another division.
void LookGrid::find_spans() {
  const Axes axes(bounds_, side_);
  for (Seen& seen : seen_) {
    if (!seen.points.all_in_front) continue;
    seen.spans.resize(seen.points.bounds.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, seen.spans.size(), piece_size), [&](const auto& range) {
      for (std::size_t i = range.begin(); i != range.end(); ++i)
        seen.spans[i] = axes.span_of(seen.points.bounds[i].box);
    });
  }
}

std::vector<LookGrid::Hit> LookGrid::hits_of(const Piece& piece, const Mesh& mesh) const {
  const Seen& seen = seen_[piece.drawable];
  const Axes axes(bounds_, side_);
  const double highest = 1.0 / seen.points.nearest_m;
  std::vector<Hit> hits;
  ViewTriangle triangle;
  for (std::size_t i = piece.first; i < piece.end; ++i) {
    const glm::uvec3& t = mesh.triangles[i];
    const LookSpan span = seen.points.all_in_front ? hull(seen.spans[t.x], seen.spans[t.y], seen.spans[t.z])
                                                   : axes.span_of(cut_bounds(seen.points, t).box);
    if (span.first_column > span.last_column || span.first_row > span.last_row) continue;
    if (!set_up_triangle(seen.points, t, false, triangle)) continue;
    for (int row = span.first_row; row <= span.last_row; ++row) {
      for (int column = span.first_column; column <= span.last_column; ++column) {
        const glm::dvec2 at = look(column, row);
        if (!holds(triangle, at)) continue;
        const double inverse_m = triangle.inverse_depth(at.x, at.y);
        if (inverse_m <= highest) hits.push_back({static_cast<std::size_t>(row * side_ + column), inverse_m});
      }
    }
  }
  return hits;
}

void LookGrid::keep_nearest(const std::vector<std::vector<Hit>>& hits) {
  met_.assign(static_cast<std::size_t>(side_) * static_cast<std::size_t>(side_), -1);
  inverse_m_.assign(met_.size(), 0.0);
  for (std::size_t i = 0; i < hits.size(); ++i) {
    for (const Hit& hit : hits[i]) {
      if (!(hit.inverse_m > inverse_m_[hit.look])) continue;
      inverse_m_[hit.look] = hit.inverse_m;
      met_[hit.look] = static_cast<std::int32_t>(pieces_[i].drawable);
    }
  }
}

void LookGrid::lay(const std::vector<ViewDrawable>& drawables, const Rigid& view_from_world, double nearest_m,
                   int side) {
  side_ = side;
  seen_.resize(drawables.size());
  for (std::size_t i = 0; i < drawables.size(); ++i) {
    const Drawable& drawable = *drawables[i].drawable;
    project_points(seen_[i].points, *drawable.mesh, view_from_world.matrix() * drawable.world_from_mesh, nearest_m);
  }
  cut_into_pieces(drawables);
  find_bounds(drawables);
  find_spans();
  std::vector<std::vector<Hit>> hits(pieces_.size());
  tbb::parallel_for(std::size_t{0}, pieces_.size(), [&](std::size_t i) {
    hits[i] = hits_of(pieces_[i], *drawables[pieces_[i].drawable].drawable->mesh);
  });
  keep_nearest(hits);
}

}  // namespace focalstage
