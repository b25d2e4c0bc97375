#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>

#include "core/compile/view_triangles.h"

namespace focalstage {

/// The looks of a grid in a box; none where a first lies behind its last.
struct LookSpan {
  std::int16_t first_column, last_column, first_row, last_row;
};

/// A regular grid of looks over all that some drawables show to a view point, and what each look meets first. Where
/// looks are few and triangles many, this asks each triangle for the looks in its box: most have none and are not set
/// up at all.
class LookGrid {
 public:
  /// Lays `side` x `side` looks over the drawables and follows them. Keeps the memory of the grid before.
  void lay(const std::vector<ViewDrawable>& drawables, const Rigid& view_from_world, double nearest_m, int side);

  /// Nothing can be seen from the view point.
  bool empty() const { return !(bounds_.min_x <= bounds_.max_x && bounds_.min_y <= bounds_.max_y); }

  glm::dvec2 look(int column, int row) const;

  /// The drawable that a look meets first, or -1.
  std::int32_t met(int column, int row) const { return met_[static_cast<std::size_t>(row * side_ + column)]; }

  /// How far along the axis it was met; infinite where nothing was.
  double depth_m(int column, int row) const { return 1.0 / inverse_m_[static_cast<std::size_t>(row * side_ + column)]; }

  /// The part of the tangent plane that one look stands for.
  double look_area() const;

 private:
  /// Some triangles of one drawable: what one task works on.
  struct Piece {
    std::uint32_t drawable;
    std::size_t first;
    std::size_t end;
  };
  struct Seen {
    ViewPoints points;
    std::vector<LookSpan> spans;  ///< of each point alone, where all are in front
  };
  struct Hit {
    std::size_t look;
    double inverse_m;
  };

  void cut_into_pieces(const std::vector<ViewDrawable>& drawables);
  Box bounds_of(const Piece& piece, const Mesh& mesh) const;
  void find_bounds(const std::vector<ViewDrawable>& drawables);
  void find_spans();
  std::vector<Hit> hits_of(const Piece& piece, const Mesh& mesh) const;
  void keep_nearest(const std::vector<std::vector<Hit>>& hits);

  int side_ = 0;
  Box bounds_{};
  std::vector<std::int32_t> met_;  ///< [row][column]
  std::vector<double> inverse_m_;  ///< likewise, 1 / distance along the axis; 0 where nothing was met
  std::vector<Seen> seen_;         ///< each drawable
  std::vector<Piece> pieces_;
};

}  // namespace focalstage
