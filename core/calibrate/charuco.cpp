#include "core/calibrate/charuco.h"

#include <cmath>
#include <map>
#include <set>

#include <opencv2/aruco.hpp>
#include <opencv2/aruco/charuco.hpp>
#include <opencv2/core.hpp>

namespace focalstage {

namespace {

constexpr std::size_t least_corners = 8;

const std::map<std::string, int>& dictionaries() {
  static const std::map<std::string, int> known{
      {"4x4_50", cv::aruco::DICT_4X4_50},   {"4x4_100", cv::aruco::DICT_4X4_100},
      {"4x4_250", cv::aruco::DICT_4X4_250}, {"5x5_50", cv::aruco::DICT_5X5_50},
      {"5x5_100", cv::aruco::DICT_5X5_100}, {"5x5_250", cv::aruco::DICT_5X5_250},
      {"6x6_250", cv::aruco::DICT_6X6_250}, {"apriltag_36h11", cv::aruco::DICT_APRILTAG_36h11}};
  return known;
}

Fault wrong(const std::string& where, const std::string& message, const std::string& remedy) {
  return {"board.settings", where, message, remedy};
}

cv::Ptr<cv::aruco::CharucoBoard> opencv_board(const CharucoBoard& board) {
  return cv::aruco::CharucoBoard::create(board.squares_x, board.squares_y, static_cast<float>(board.square_m),
                                         static_cast<float>(board.marker_m),
                                         cv::aruco::getPredefinedDictionary(dictionaries().at(board.dictionary)));
}

/// Number and place of each corner.
std::vector<BoardCorner> corners_in(const CharucoBoard& board, const CameraPicture& picture) {
  // OpenCV has no views of what it may not write.
  const cv::Mat image(picture.height_px, picture.width_px, CV_8UC1, const_cast<std::uint8_t*>(picture.gray.data()));
  const auto shape = opencv_board(board);
  const auto parameters = cv::aruco::DetectorParameters::create();
  // Between squares a marker's corner would be drawn to the square's: it is left as it was found.
  parameters->cornerRefinementMethod = cv::aruco::CORNER_REFINE_NONE;
  std::vector<std::vector<cv::Point2f>> markers;
  std::vector<int> ids;
  cv::aruco::detectMarkers(image, shape->dictionary, markers, ids, parameters);
  if (ids.empty()) return {};
  std::vector<cv::Point2f> at;
  std::vector<int> numbers;
  cv::aruco::interpolateCornersCharuco(markers, ids, image, shape, at, numbers);
  std::vector<BoardCorner> corners;
  for (std::size_t i = 0; i < at.size(); ++i) {
    const int column = numbers[i] % (board.squares_x - 1) + 1;
    const int row = numbers[i] / (board.squares_x - 1) + 1;
    corners.push_back({numbers[i],
                       {column * board.square_m, (board.squares_y - row) * board.square_m, 0.0},
                       // Unlike all other points of OpenCV 4.6 these count from the first pixel's corner, as ours do.
                       {at[i].x, at[i].y}});
  }
  return corners;
}

}  // namespace

Status check_board(const CharucoBoard& board) {
  const auto known = dictionaries().find(board.dictionary);
  if (known == dictionaries().end()) {
    std::string names;
    for (const auto& [name, id] : dictionaries()) names += (names.empty() ? "" : ", ") + name;
    return wrong("dictionary", "there is none named " + board.dictionary, "one of " + names);
  }
  if (board.squares_x < 4 || board.squares_y < 3 || board.squares_x > 50 || board.squares_y > 49) {
    return wrong("squares", "a board has 4 x 3 to 50 x 49 squares", "");
  }
  if (board.squares_y % 2 == 0) {
    return wrong("squares", "it has an even number of rows, which versions of OpenCV draw differently",
                 "print an odd one");
  }
  if (!(board.marker_m > 0.0 && board.marker_m < board.square_m && board.square_m < 10.0)) {
    return wrong("marker_m", "its markers must be smaller than its squares, and those than 10 m", "");
  }
  const int has = cv::aruco::getPredefinedDictionary(known->second)->bytesList.rows;
  if (board.squares_x * board.squares_y / 2 <= has) return {};
  return wrong("dictionary", "it has " + std::to_string(has) + " markers, the board takes more", "use a larger one");
}

Result<std::vector<BoardCorner>> find_board(const CharucoBoard& board, const CameraPicture& picture) {
  if (Status good = check_board(board); !good) return good.fault();
  std::vector<BoardCorner> corners;
  try {
    corners = corners_in(board, picture);
  } catch (const cv::Exception&) {
    corners.clear();  // pictures of which no detector makes sense
  }
  std::set<double> columns;
  std::set<double> rows;
  for (const BoardCorner& corner : corners) {
    columns.insert(corner.board_m.x);
    rows.insert(corner.board_m.y);
  }
  if (corners.size() >= least_corners && columns.size() >= 2 && rows.size() >= 2) return corners;
  return Fault{"board.unseen", picture.name,
               std::to_string(corners.size()) + " of the board's corners are seen, eight are the least",
               "let the camera see more of the board, sharp and lit by the projector"};
}

Result<CameraPicture> picture_of_board(const CharucoBoard& board, int square_px) {
  if (Status good = check_board(board); !good) return good.fault();
  if (square_px < 8 || square_px > 400) return wrong("square_px", "is not between 8 and 400 pixels", "");
  CameraPicture picture{"board", square_px * (board.squares_x + 1), square_px * (board.squares_y + 1), {}};
  try {
    cv::Mat image;
    opencv_board(board)->draw({picture.width_px, picture.height_px}, image, square_px / 2, 1);
    picture.gray.assign(image.data, image.data + image.total());
  } catch (const cv::Exception&) {
    return wrong("square_px", "the board cannot be drawn with it", "use another size");
  }
  return picture;
}

}  // namespace focalstage
