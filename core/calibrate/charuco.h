#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "core/base/result.h"
#include "core/stripes/capture.h"

namespace focalstage {

/// A ChArUco board: markers 0, 1, .. in the white squares, row by row from the top left, black squares in the corners.
/// Its frame: X right, Y up and Z out of the board, from its lower left corner.
struct CharucoBoard {
  int squares_x = 9;
  int squares_y = 7;  ///< odd: even ones changed between versions of OpenCV
  double square_m = 0.0;
  double marker_m = 0.0;  ///< of a marker's black side
  std::string dictionary = "4x4_50";

  bool operator==(const CharucoBoard&) const = default;
};

/// A corner between squares.
struct BoardCorner {
  int number = 0;  ///< along the rows from the top left
  glm::dvec3 board_m{0.0};
  glm::dvec2 pixel{0.0};  ///< of the camera; pixel i covers [i, i + 1)
};

/// "board.settings": sizes that cannot be, a dictionary that is not there or has too few markers.
Status check_board(const CharucoBoard& board);

/// The board's corners in a picture; "board.unseen" with the picture's name where there are fewer than eight, or they
/// lie on one line.
Result<std::vector<BoardCorner>> find_board(const CharucoBoard& board, const CameraPicture& picture);

/// 8-bit gray from the top, to print: `square_px` pixels a square, with a rim of half a square.
Result<CameraPicture> picture_of_board(const CharucoBoard& board, int square_px);

}  // namespace focalstage
