#include "core/calibrate/least_squares.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

namespace focalstage {

namespace {

constexpr double difference = 1e-5;      // of the scale: central differences to 1e-10 of a smooth function
constexpr double smallest_step = 1e-10;  // of the scale
constexpr double smallest_gain = 1e-14;  // of the square sum
constexpr int most_steps = 200;
constexpr double undetermined = 1e-14;  // smallest of the normal matrix's eigenvalues over the largest

/// By scaled unknowns: all of them matter alike.
class Scaled {
 public:
  Scaled(const Residuals& residuals, const Eigen::VectorXd& scale) : residuals_(residuals), scale_(scale) {}

  bool at(const Eigen::VectorXd& scaled, Eigen::VectorXd& out) const {
    return residuals_(scaled.cwiseProduct(scale_), out) && out.allFinite();
  }

  bool slope(const Eigen::VectorXd& scaled, Eigen::MatrixXd& out) const {
    Eigen::VectorXd above;
    Eigen::VectorXd below;
    for (Eigen::Index i = 0; i < scaled.size(); ++i) {
      Eigen::VectorXd moved = scaled;
      moved(i) = scaled(i) + difference;
      if (!at(moved, above)) return false;
      moved(i) = scaled(i) - difference;
      if (!at(moved, below)) return false;
      out.col(i) = (above - below) / (2.0 * difference);
    }
    return true;
  }

 private:
  const Residuals& residuals_;
  const Eigen::VectorXd& scale_;
};

struct State {
  Eigen::VectorXd at;
  Eigen::VectorXd residuals;
  Eigen::MatrixXd slope;
};

/// One step that lessens the square sum; false once there is none.
bool step(const Scaled& problem, State& state, double& damping, double& growth) {
  const Eigen::MatrixXd normal = state.slope.transpose() * state.slope;
  const Eigen::VectorXd gradient = state.slope.transpose() * state.residuals;
  const double now = state.residuals.squaredNorm();
  Eigen::VectorXd residuals;
  for (int attempt = 0; attempt < 60; ++attempt) {
    Eigen::MatrixXd damped = normal;
    damped.diagonal() += damping * normal.diagonal().cwiseMax(1e-12 * normal.diagonal().maxCoeff());
    const Eigen::VectorXd change = damped.ldlt().solve(-gradient);
    if (!change.allFinite() || change.cwiseAbs().maxCoeff() < smallest_step) return false;
    const Eigen::VectorXd next = state.at + change;
    if (problem.at(next, residuals) && residuals.squaredNorm() < now) {
      const double gain = now - residuals.squaredNorm();
      const double foreseen = -change.dot(2.0 * gradient + normal * change);
      damping *= std::max(1.0 / 3.0, 1.0 - std::pow(2.0 * gain / std::max(foreseen, gain) - 1.0, 3.0));
      growth = 2.0;
      state.at = next;
      state.residuals = residuals;
      return gain > smallest_gain * now;
    }
    damping *= growth;
    growth *= 2.0;
  }
  return false;
}

}  // namespace

std::optional<LeastSquares> least_squares(const Residuals& residuals, const Eigen::VectorXd& first,
                                          const Eigen::VectorXd& scale) {
  const Scaled problem(residuals, scale);
  State state{first.cwiseQuotient(scale), {}, {}};
  if (!problem.at(state.at, state.residuals)) return std::nullopt;
  if (state.residuals.size() < state.at.size()) return std::nullopt;
  state.slope.resize(state.residuals.size(), state.at.size());
  double damping = 1e-3;
  double growth = 2.0;
  for (int i = 0; i < most_steps; ++i) {
    if (!problem.slope(state.at, state.slope)) return std::nullopt;
    if (!step(problem, state, damping, growth)) break;
  }
  if (!problem.slope(state.at, state.slope)) return std::nullopt;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> parts(state.slope.transpose() * state.slope);
  const Eigen::VectorXd& values = parts.eigenvalues();
  if (!(values(0) > undetermined * values(values.size() - 1))) return std::nullopt;
  const Eigen::MatrixXd inverse =
      parts.eigenvectors() * values.cwiseInverse().asDiagonal() * parts.eigenvectors().transpose();
  const Eigen::MatrixXd covariance = scale.asDiagonal() * inverse * scale.asDiagonal();
  return LeastSquares{state.at.cwiseProduct(scale), std::move(state.residuals), covariance};
}

}  // namespace focalstage
