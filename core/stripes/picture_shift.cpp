#include "core/stripes/picture_shift.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <Eigen/Cholesky>
#include <Eigen/Core>

namespace focalstage {

namespace {

constexpr int looked_at = 150000;  // pixels

// Moved right, moved down, turned, scaled, gain, offset.
using Row = Eigen::Matrix<double, 6, 1>;

struct Grid {
  const std::vector<float>& picture;
  const std::vector<std::uint8_t>& where;
  int width;
  int height;

  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  }

  /// Slopes need neighbours that are looked at too: else the rim of what is lit counts as its texture.
  bool usable(int x, int y) const {
    return where[index(x, y)] && where[index(x - 1, y)] && where[index(x + 1, y)] && where[index(x, y - 1)] &&
           where[index(x, y + 1)];
  }

  /// How brightness changes if the picture is moved by one unit of each.
  Row slopes(int x, int y) const {
    const double right = 0.5 * (picture[index(x + 1, y)] - picture[index(x - 1, y)]);
    const double down = 0.5 * (picture[index(x, y + 1)] - picture[index(x, y - 1)]);
    const double u = (x - 0.5 * width) / width;
    const double v = (y - 0.5 * height) / width;
    Row row;
    row << right, down, down * u - right * v, right * u + down * v, picture[index(x, y)], 1.0;
    return row;
  }

  template <class Visit>
  void each(Visit&& visit) const {
    // Of large pictures every few rows: texture is everywhere.
    const int stride = std::max(1, height * width / looked_at);
    for (int y = 1; y + 1 < height; y += stride) {
      for (int x = 1; x + 1 < width; ++x) {
        if (usable(x, y)) visit(index(x, y), slopes(x, y));
      }
    }
  }
};

}  // namespace

PictureShift picture_shift(const std::vector<float>& first, const std::vector<float>& other,
                           const std::vector<std::uint8_t>& where, int width_px, int height_px) {
  const Grid grid{first, where, width_px, height_px};
  Eigen::Matrix<double, 6, 6> normal = Eigen::Matrix<double, 6, 6>::Zero();
  Row right_side = Row::Zero();
  double count = 0.0;
  grid.each([&](std::size_t i, const Row& row) {
    normal.selfadjointView<Eigen::Lower>().rankUpdate(row);
    right_side += row * static_cast<double>(other[i]);
    count += 1.0;
  });
  if (count < 100.0) return {};
  normal.diagonal() += 1e-9 * Row::Constant(normal.trace());
  const Eigen::LDLT<Eigen::Matrix<double, 6, 6>> solver(normal.selfadjointView<Eigen::Lower>());
  const Row solved = solver.solve(right_side);
  double left = 0.0;
  double sum = 0.0;
  double squares = 0.0;
  grid.each([&](std::size_t i, const Row& row) {
    left += std::pow(other[i] - row.dot(solved), 2);
    sum += first[i];
    squares += static_cast<double>(first[i]) * first[i];
  });
  PictureShift shift;
  shift.gain = solved(4);
  if (!(std::abs(shift.gain) > 1e-3)) return {0.0, 0.0, shift.gain, 1.0};
  const Eigen::Vector4d moved = solved.head<4>() / shift.gain;
  // A turn or scale by s moves places by s times their distance from the middle, a third of the width.
  const Eigen::Vector4d weights(1.0, 1.0, 1.0 / 3.0, 1.0 / 3.0);
  shift.moved_px = moved.cwiseProduct(weights).norm();
  const Eigen::Matrix<double, 6, 6> inverse = solver.solve(Eigen::Matrix<double, 6, 6>::Identity());
  const Eigen::Vector4d variance = inverse.diagonal().head<4>() * (left / count) / (shift.gain * shift.gain);
  shift.doubt_px = std::sqrt(variance.cwiseProduct(weights.cwiseAbs2()).sum());
  const double spread = squares / count - std::pow(sum / count, 2);
  shift.unexplained = std::sqrt(left / count / (shift.gain * shift.gain) / std::max(spread, 1.0));
  return shift;
}

}  // namespace focalstage
