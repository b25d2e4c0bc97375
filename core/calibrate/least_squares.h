#pragma once

#include <functional>
#include <optional>
#include <vector>

#include <Eigen/Core>

namespace focalstage {

// The room's own: what includes this sees Eigen.

/// Fills in the residuals of unknowns; false where those cannot be (a point behind what looks at it).
using Residuals = std::function<bool(const Eigen::VectorXd& unknowns, Eigen::VectorXd& residuals)>;

/// Residuals that some of the unknowns alone decide: the slopes by all others are none, and are not looked for.
struct ResidualBlock {
  std::vector<Eigen::Index> unknowns;
  Residuals residuals;  ///< of all unknowns
};

struct LeastSquares {
  Eigen::VectorXd unknowns;
  Eigen::VectorXd residuals;
  Eigen::MatrixXd covariance;  ///< of the unknowns, for residuals of variance one

  double square_sum() const { return residuals.squaredNorm(); }
};

/// The unknowns of least square sum near `first`, by Levenberg and Marquardt with central differences (K. Madsen, H. B.
/// Nielsen, O. Tingleff, "Methods for non-linear least squares problems", 2004, algorithm 3.16). `scale`: a change of
/// each unknown that matters alike. None where the residuals of `first` cannot be, or the unknowns are not determined.
std::optional<LeastSquares> least_squares(const Residuals& residuals, const Eigen::VectorXd& first,
                                          const Eigen::VectorXd& scale);

/// The same of residuals that come in blocks, one after the other.
std::optional<LeastSquares> least_squares(const std::vector<ResidualBlock>& blocks, const Eigen::VectorXd& first,
                                          const Eigen::VectorXd& scale);

}  // namespace focalstage
