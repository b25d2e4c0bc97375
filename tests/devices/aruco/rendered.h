#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>
#include <random>
#include <vector>

#include <opencv2/aruco.hpp>

#include "core/base/rigid.h"
#include "devices/aruco/settings.h"
#include "devices/roles/camera.h"

namespace focalstage::sample {

/// How bright a point of a flat thing's plane is, 0..1; none where the thing is not. Metres in its own frame.
using Pattern = std::function<std::optional<double>(double x_m, double y_m)>;

struct Sheet {
  Rigid tracker_from_sheet;
  Pattern pattern;
};

struct Shot {
  int width_px = 640;
  int height_px = 480;
  double noise = 0.0;    ///< standard deviation in codes
  double blur_px = 0.0;  ///< standard deviation of a Gaussian
  std::uint32_t seed = 1;
};

/// The cells of a marker, black frame and all: rows from the top, true is white. Only the bits come from OpenCV.
inline std::vector<std::vector<bool>> marker_cells(int dictionary, int marker) {
  const auto words = cv::aruco::getPredefinedDictionary(dictionary);
  const int side = words->markerSize + 2;
  cv::Mat image;
  words->drawMarker(marker, side, image, 1);
  std::vector<std::vector<bool>> cells(static_cast<std::size_t>(side));
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) cells[static_cast<std::size_t>(y)].push_back(image.at<std::uint8_t>(y, x) > 127);
  }
  return cells;
}

/// A marker's brightness at (x, y) from its lower left corner, where it is `size_m` wide.
inline double marker_light(const std::vector<std::vector<bool>>& cells, double size_m, double x_m, double y_m) {
  const auto side = static_cast<double>(cells.size());
  const auto column = static_cast<std::size_t>(std::clamp(x_m / size_m * side, 0.0, side - 1e-9));
  const auto row = static_cast<std::size_t>(std::clamp((size_m - y_m) / size_m * side, 0.0, side - 1e-9));
  return cells[row][column] ? 0.9 : 0.1;
}

/// A marker in the middle of white paper.
inline Pattern marker_pattern(int dictionary, int marker, double size_m) {
  return [=, cells = marker_cells(dictionary, marker)](double x, double y) -> std::optional<double> {
    const double h = 0.5 * size_m;
    const double edge = size_m * 0.7;
    if (std::abs(x) > edge || std::abs(y) > edge) return std::nullopt;
    if (std::abs(x) > h || std::abs(y) > h) return 0.9;
    return marker_light(cells, size_m, x + h, y + h);
  };
}

/// A ChArUco board as settings.h tells it, with a white rim.
inline Pattern charuco_pattern(int dictionary, const CharucoBody& board) {
  std::vector<std::vector<std::vector<bool>>> markers;
  for (int i = 0; i < board.squares_x * board.squares_y / 2; ++i) markers.push_back(marker_cells(dictionary, i));
  return [=](double x, double y) -> std::optional<double> {
    const double width_m = board.squares_x * board.square_m;
    const double height_m = board.squares_y * board.square_m;
    const double rim_m = 0.3 * board.square_m;
    if (x < -rim_m || y < -rim_m || x > width_m + rim_m || y > height_m + rim_m) return std::nullopt;
    if (x < 0.0 || y < 0.0 || x >= width_m || y >= height_m) return 0.9;
    const int column = static_cast<int>(x / board.square_m);
    const int row = board.squares_y - 1 - static_cast<int>(y / board.square_m);  // from the top
    if ((row + column) % 2 == 0) return 0.1;
    // White squares are counted along the rows from the top: of an odd board each square's number is half its own.
    const int number = (row * board.squares_x + column) / 2;
    const double gap_m = 0.5 * (board.square_m - board.marker_m);
    const double in_x = x - column * board.square_m - gap_m;
    const double in_y = y - (board.squares_y - 1 - row) * board.square_m - gap_m;
    if (in_x < 0.0 || in_y < 0.0 || in_x > board.marker_m || in_y > board.marker_m) return 0.9;
    return marker_light(markers[static_cast<std::size_t>(number)], board.marker_m, in_x, in_y);
  };
}

/// What the ray through a place of the picture meets.
inline double light_along(const std::vector<Sheet>& sheets, const glm::dvec3& direction) {
  double nearest = 1e9;
  double light = 0.45;
  for (const Sheet& sheet : sheets) {
    const Rigid sheet_from_tracker = sheet.tracker_from_sheet.inverse();
    const glm::dvec3 from = sheet_from_tracker.position_m;
    const glm::dvec3 along = sheet_from_tracker.direction(direction);
    const double way = -from.z / along.z;
    if (!(way > 0.0) || way >= nearest || from.z <= 0.0) continue;
    const auto seen = sheet.pattern(from.x + way * along.x, from.y + way * along.y);
    if (!seen) continue;
    nearest = way;
    light = *seen;
  }
  return light;
}

inline void blur(std::vector<double>& image, int width, int height, double sigma_px) {
  const int reach = static_cast<int>(std::ceil(3.0 * sigma_px));
  std::vector<double> weights;
  double sum = 0.0;
  for (int i = -reach; i <= reach; ++i) sum += weights.emplace_back(std::exp(-0.5 * i * i / (sigma_px * sigma_px)));
  const auto pass = [&](int dx, int dy) {
    std::vector<double> out(image.size());
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        double value = 0.0;
        for (int i = -reach; i <= reach; ++i) {
          const int px = std::clamp(x + i * dx, 0, width - 1);
          const int py = std::clamp(y + i * dy, 0, height - 1);
          value += weights[static_cast<std::size_t>(i + reach)] * image[static_cast<std::size_t>(py * width + px)];
        }
        out[static_cast<std::size_t>(y * width + x)] = value / sum;
      }
    }
    image = out;
  };
  pass(1, 0);
  pass(0, 1);
}

/// A picture of sheets, four by four rays a pixel, by a camera without distortion that looks along -Z of the tracker's
/// frame.
inline CameraFrame photograph(const CameraModel& camera, const std::vector<Sheet>& sheets, const Shot& shot = {}) {
  constexpr int fine = 4;
  std::vector<double> image;
  for (int y = 0; y < shot.height_px; ++y) {
    for (int x = 0; x < shot.width_px; ++x) {
      double sum = 0.0;
      for (int i = 0; i < fine * fine; ++i) {
        const double u = x + (i % fine + 0.5) / fine;
        const double v = y + (i / fine + 0.5) / fine;
        sum += light_along(sheets, {(u - camera.cx_px) / camera.fx_px, -(v - camera.cy_px) / camera.fy_px, -1.0});
      }
      image.push_back(255.0 * sum / (fine * fine));
    }
  }
  if (shot.blur_px > 0.0) blur(image, shot.width_px, shot.height_px, shot.blur_px);
  std::mt19937 random(shot.seed);
  std::normal_distribution<double> noise(0.0, 1.0);
  CameraFrame frame{shot.width_px, shot.height_px, 1, 0.0, {}};
  for (const double code : image) {
    frame.gray.push_back(static_cast<std::uint8_t>(std::clamp(code + shot.noise * noise(random) + 0.5, 0.0, 255.0)));
  }
  return frame;
}

}  // namespace focalstage::sample
