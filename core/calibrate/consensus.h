#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/calibrate/projector_fit.h"

namespace focalstage {

// The room's own: what includes this sees Eigen.

/// The largest set of points that agree on a projector, and those that do not.
struct Consensus {
  ProjectorFit fit;  ///< of those that agree
  std::vector<std::size_t> agreeing;
  std::vector<std::size_t> lying;
  std::vector<std::optional<double>> left_out_px;  ///< per agreeing point: how far the others alone put it off
};

/// None where no projector is found from which five points or more, and 60 % of them, agree.
std::optional<Consensus> find_consensus(const ProjectorModel& known, const std::vector<PickedPoint>& points,
                                        LensFreedom freedom);

/// How far the model puts a point from its pixel; infinitely where it is behind.
double distance_px(const ProjectorModel& model, const PickedPoint& point);

/// Below this nothing disagrees: no hand picks so well.
inline constexpr double picking_px = 0.05;

}  // namespace focalstage
