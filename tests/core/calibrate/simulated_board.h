#pragma once

#include <opencv2/aruco.hpp>

#include "core/calibrate/charuco.h"
#include "tests/core/stripes/simulated_room.h"

namespace own {

/// The cells of a marker, black frame and all: rows from the top, true is white. Only the bits come from OpenCV.
inline std::vector<std::vector<bool>> marker_cells(int marker) {
  const auto words = cv::aruco::getPredefinedDictionary(cv::aruco::DICT_4X4_50);
  const int side = words->markerSize + 2;
  cv::Mat image;
  words->drawMarker(marker, side, image, 1);
  std::vector<std::vector<bool>> cells(static_cast<std::size_t>(side));
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) cells[static_cast<std::size_t>(y)].push_back(image.at<std::uint8_t>(y, x) > 127);
  }
  return cells;
}

/// A ChArUco board as charuco.h tells it, with a white rim, printed on paper that is never quite white or black.
inline Paint charuco(const focalstage::CharucoBoard& board) {
  std::vector<std::vector<std::vector<bool>>> markers;
  for (int i = 0; i < board.squares_x * board.squares_y / 2; ++i) markers.push_back(marker_cells(i));
  return [=](double x, double y) -> std::optional<double> {
    const double white = 0.85;
    const double black = 0.08;
    const double square = board.square_m;
    const double rim = 0.4 * square;
    if (x < -rim || y < -rim || x > board.squares_x * square + rim || y > board.squares_y * square + rim) {
      return std::nullopt;
    }
    if (x < 0.0 || y < 0.0 || x >= board.squares_x * square || y >= board.squares_y * square) return white;
    const int column = static_cast<int>(x / square);
    const int row = board.squares_y - 1 - static_cast<int>(y / square);  // from the top
    if ((row + column) % 2 == 0) return black;
    // White squares are counted along the rows from the top: of an odd board each square's number is half its own.
    const auto& cells = markers[static_cast<std::size_t>((row * board.squares_x + column) / 2)];
    const double gap = 0.5 * (square - board.marker_m);
    const double in_x = (x - column * square - gap) / board.marker_m;
    const double in_y = (y - (board.squares_y - 1 - row) * square - gap) / board.marker_m;
    if (in_x < 0.0 || in_y < 0.0 || in_x >= 1.0 || in_y >= 1.0) return white;
    const auto side = static_cast<double>(cells.size());
    const bool bright = cells[static_cast<std::size_t>((1.0 - in_y) * side)][static_cast<std::size_t>(in_x * side)];
    return bright ? white : black;
  };
}

}  // namespace own
