#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/calibrate/charuco.h"
#include "core/stripes/decode.h"

namespace focalstage {

/// A corner of a board as the camera sees it and as the projector would light it.
struct SeenCorner {
  int number = 0;
  glm::dvec3 board_m{0.0};
  glm::dvec2 camera_px{0.0};
  glm::dvec2 projector_px{0.0};
};

/// A place on the board's face, wherever on it: the middle of a camera's pixel, which is exact, and what lights it.
struct FacePlace {
  glm::dvec2 camera_px{0.0};
  glm::dvec2 projector_px{0.0};
};

/// One capture of a board.
struct BoardView {
  std::string name;
  std::vector<SeenCorner> corners;
  std::vector<FacePlace> face;
};

/// The projector's place at a place of the camera's picture, from the decoded pixels within `radius_px`: a smooth
/// (quadratic) map through them, those off it left out. None where they do not surround it.
std::optional<glm::dvec2> projector_place(const DecodedCapture& decoded, const glm::dvec2& camera_px, double radius_px);

/// The corners that have a place in the projector's picture; "scan.unlit" where fewer than eight have.
Result<BoardView> board_view(const std::string& name, const std::vector<BoardCorner>& corners,
                             const DecodedCapture& decoded);

}  // namespace focalstage
