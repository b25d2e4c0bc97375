#include "core/calibrate/least_squares.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

namespace focalstage {

namespace {

constexpr double difference = 1e-5;      // of the scale: central differences to 1e-10 of a smooth function
constexpr double smallest_step = 1e-10;  // of the scale
constexpr double smallest_gain = 1e-12;  // of the square sum
constexpr int most_steps = 200;
constexpr double undetermined = 1e-14;  // smallest of the normal matrix's eigenvalues over the largest

/// The sums that a step is made of.
struct Normal {
  Eigen::MatrixXd matrix;
  Eigen::VectorXd gradient;
};

/// By scaled unknowns: all of them matter alike.
class Scaled {
 public:
  Scaled(const std::vector<ResidualBlock>& blocks, const Eigen::VectorXd& scale) : blocks_(blocks), scale_(scale) {}

  bool at(const Eigen::VectorXd& scaled, Eigen::VectorXd& out) const {
    std::vector<Eigen::VectorXd> parts(blocks_.size());
    Eigen::Index rows = 0;
    for (std::size_t i = 0; i < blocks_.size(); ++i) {
      if (!fill(blocks_[i], scaled, parts[i])) return false;
      rows += parts[i].size();
    }
    out.resize(rows);
    rows = 0;
    for (const Eigen::VectorXd& part : parts) {
      out.segment(rows, part.size()) = part;
      rows += part.size();
    }
    return true;
  }

  bool normal(const Eigen::VectorXd& scaled, const Eigen::VectorXd& residuals, Normal& out) const {
    out.matrix = Eigen::MatrixXd::Zero(scaled.size(), scaled.size());
    out.gradient = Eigen::VectorXd::Zero(scaled.size());
    Eigen::Index row = 0;
    Eigen::MatrixXd slope;
    for (const ResidualBlock& block : blocks_) {
      if (!slopes(block, scaled, slope)) return false;
      const Eigen::MatrixXd product = slope.transpose() * slope;
      const Eigen::VectorXd side = slope.transpose() * residuals.segment(row, slope.rows());
      for (std::size_t i = 0; i < block.unknowns.size(); ++i) {
        const auto from = static_cast<Eigen::Index>(i);
        out.gradient(block.unknowns[i]) += side(from);
        for (std::size_t k = 0; k < block.unknowns.size(); ++k) {
          out.matrix(block.unknowns[i], block.unknowns[k]) += product(from, static_cast<Eigen::Index>(k));
        }
      }
      row += slope.rows();
    }
    return true;
  }

 private:
  bool fill(const ResidualBlock& block, const Eigen::VectorXd& scaled, Eigen::VectorXd& out) const {
    return block.residuals(scaled.cwiseProduct(scale_), out) && out.allFinite();
  }

  bool slopes(const ResidualBlock& block, const Eigen::VectorXd& scaled, Eigen::MatrixXd& out) const {
    Eigen::VectorXd above;
    Eigen::VectorXd below;
    Eigen::VectorXd moved = scaled;
    for (std::size_t i = 0; i < block.unknowns.size(); ++i) {
      const Eigen::Index at = block.unknowns[i];
      moved(at) = scaled(at) + difference;
      if (!fill(block, moved, above)) return false;
      moved(at) = scaled(at) - difference;
      if (!fill(block, moved, below)) return false;
      moved(at) = scaled(at);
      if (i == 0) out.resize(above.size(), static_cast<Eigen::Index>(block.unknowns.size()));
      out.col(static_cast<Eigen::Index>(i)) = (above - below) / (2.0 * difference);
    }
    return true;
  }

  const std::vector<ResidualBlock>& blocks_;
  const Eigen::VectorXd& scale_;
};

struct State {
  Eigen::VectorXd at;
  Eigen::VectorXd residuals;
  Normal normal;
};

/// One step that lessens the square sum; false once there is none.
bool step(const Scaled& problem, State& state, double& damping, double& growth) {
  const auto& [normal, gradient] = state.normal;
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

std::optional<LeastSquares> least_squares(const std::vector<ResidualBlock>& blocks, const Eigen::VectorXd& first,
                                          const Eigen::VectorXd& scale) {
  const Scaled problem(blocks, scale);
  State state{first.cwiseQuotient(scale), {}, {}};
  if (!problem.at(state.at, state.residuals)) return std::nullopt;
  if (state.residuals.size() < state.at.size()) return std::nullopt;
  double damping = 1e-3;
  double growth = 2.0;
  for (int i = 0; i < most_steps; ++i) {
    if (!problem.normal(state.at, state.residuals, state.normal)) return std::nullopt;
    if (!step(problem, state, damping, growth)) break;
  }
  if (!problem.normal(state.at, state.residuals, state.normal)) return std::nullopt;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> parts(state.normal.matrix);
  const Eigen::VectorXd& values = parts.eigenvalues();
  if (!(values(0) > undetermined * values(values.size() - 1))) return std::nullopt;
  const Eigen::MatrixXd inverse =
      parts.eigenvectors() * values.cwiseInverse().asDiagonal() * parts.eigenvectors().transpose();
  const Eigen::MatrixXd covariance = scale.asDiagonal() * inverse * scale.asDiagonal();
  return LeastSquares{state.at.cwiseProduct(scale), std::move(state.residuals), covariance};
}

std::optional<LeastSquares> least_squares(const Residuals& residuals, const Eigen::VectorXd& first,
                                          const Eigen::VectorXd& scale) {
  std::vector<Eigen::Index> all(static_cast<std::size_t>(first.size()));
  std::iota(all.begin(), all.end(), Eigen::Index{0});
  return least_squares(std::vector<ResidualBlock>{{std::move(all), residuals}}, first, scale);
}

}  // namespace focalstage
