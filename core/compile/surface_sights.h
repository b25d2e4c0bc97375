#pragma once

#include <array>
#include <optional>
#include <vector>

#include "core/compile/cells.h"
#include "core/compile/tile.h"
#include "core/compile/view_triangles.h"
#include "core/optics/eye.h"
#include "core/optics/projector_model.h"
#include "core/stage/stage.h"

namespace focalstage {

/// Triangles of one view in cells, to be asked for the nearest along looks.
class Sight {
 public:
  Sight(const std::vector<ViewDrawable>& drawables, const Rigid& view_from_world, double nearest_m, int cells_across);

  /// 64 looks; those that are not a number meet nothing.
  struct Looks {
    double x[tile_samples];
    double y[tile_samples];
  };
  struct Met {
    std::int32_t triangle[tile_samples];  ///< -1: nothing
    double depth_m[tile_samples];         ///< along the axis; NaN: nothing

    bool at(int i) const { return triangle[i] >= 0; }
  };
  Met nearest(const Looks& looks) const;

  const ViewTriangle& triangle(const Met& met, int i) const {
    return view_.triangles[static_cast<std::size_t>(met.triangle[i])];
  }

 private:
  bool empty() const { return !(bounds_.min_x <= bounds_.max_x && bounds_.min_y <= bounds_.max_y); }

  ViewTriangles view_;
  Cells cells_;
  Box bounds_{};
};

/// How both eyes and the projectors see the real surfaces; kept while surfaces and viewer stand still.
class SurfaceSights {
 public:
  SurfaceSights(std::vector<ProjectorModel> projectors, double lens_to_pupil_m, int cells_across);

  void look(const Stage& stage, const PerEye<Eye>& eyes);

  const Sight& from_eye(Side side) const { return *of_surfaces_[side]; }

  /// Which of the points on surfaces that `looks` of an eye meet some projector's light reaches.
  std::array<bool, tile_samples> reached(const Rigid& eye_from_world, const Sight::Looks& looks,
                                         const Sight::Met& met) const;

 private:
  void add_reached(std::size_t projector, const Rigid& eye_from_world, const Sight::Looks& looks, const Sight::Met& met,
                   std::array<bool, tile_samples>& lit) const;

  std::vector<ProjectorModel> projectors_;
  double lens_to_pupil_m_;
  int cells_across_;
  std::vector<StagedSurface> surfaces_before_;
  Rigid viewer_before_;
  double interpupillary_before_m_ = 0.0;
  std::vector<Sight> from_projectors_;
  PerEye<std::optional<Sight>> of_surfaces_;
};

}  // namespace focalstage
