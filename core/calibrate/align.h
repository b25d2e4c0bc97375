#pragma once

#include <optional>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "core/base/result.h"
#include "core/base/rigid.h"

namespace focalstage {

/// One point as two frames of reference tell it.
struct PointPair {
  std::string name;      ///< for whoever reads the residuals; may be empty
  glm::dvec3 tracker_m;  ///< as the tracker saw it
  glm::dvec3 world_m;    ///< where it stands in the world
};

/// How one pair agrees with the alignment.
struct PairResidual {
  double distance_mm = 0.0;           ///< with the alignment made of all pairs
  std::optional<double> left_out_mm;  ///< with the one made of all others; none where those do not suffice for one
};

/// A rotation and a translation, never a scale: both frames are in metres.
struct Alignment {
  Rigid world_from_tracker;
  std::vector<PairResidual> residuals;  ///< in the order of the pairs
  double rms_mm = 0.0;
  double worst_mm = 0.0;
  std::size_t worst = 0;                  ///< which pair
  std::optional<double> left_out_rms_mm;  ///< over the pairs that have one: what a new point may be off by
};

/// By least squares (Umeyama, "Least-squares estimation of transformation parameters between two point patterns", IEEE
/// PAMI 13(4), 1991). Refuses rather than guesses:
///
/// "align.few"        fewer than three pairs
/// "align.finite"     a coordinate that is no number
/// "align.collinear"  points on one line, so that the turn about it is anyone's: their root mean square distance from
///                    the best line is less than a fiftieth of that along it
/// "align.mirrored"   the mirror image fits five times better: an axis points the wrong way. It takes points that do
/// not
///                    lie in one plane to tell.
/// "align.pair-off"   one pair disagrees with the others beyond chance (an F test of what the fit gains without it,
/// with
///                    Bonferroni's correction, p < 0.001). Named.
Result<Alignment> align(const std::vector<PointPair>& pairs);

/// "3 (left corner)", counted from 1.
std::string pair_label(const std::vector<PointPair>& pairs, std::size_t index);

}  // namespace focalstage
