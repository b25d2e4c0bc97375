#include "devices/aruco/marker_finder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include <opencv2/aruco.hpp>
#include <opencv2/aruco/charuco.hpp>
#include <opencv2/core.hpp>

#include "devices/aruco/board_pose.h"

namespace focalstage {

namespace {

using Corners = std::vector<cv::Point2f>;

const std::map<std::string, int>& dictionaries() {
  static const std::map<std::string, int> known{{"4x4_50", cv::aruco::DICT_4X4_50},
                                                {"4x4_100", cv::aruco::DICT_4X4_100},
                                                {"4x4_250", cv::aruco::DICT_4X4_250},
                                                {"5x5_50", cv::aruco::DICT_5X5_50},
                                                {"5x5_100", cv::aruco::DICT_5X5_100},
                                                {"5x5_250", cv::aruco::DICT_5X5_250},
                                                {"6x6_50", cv::aruco::DICT_6X6_50},
                                                {"6x6_250", cv::aruco::DICT_6X6_250},
                                                {"apriltag_36h11", cv::aruco::DICT_APRILTAG_36h11},
                                                {"aruco_original", cv::aruco::DICT_ARUCO_ORIGINAL}};
  return known;
}

Fault wrong(const std::string& where, const std::string& message, const std::string& remedy = "") {
  return {"aruco.settings", where, message, remedy};
}

Status check_camera(const CameraModel& camera) {
  const bool good = camera.fx_px > 0.0 && camera.fy_px > 0.0 && std::isfinite(camera.fx_px + camera.fy_px) &&
                    std::isfinite(camera.cx_px + camera.cy_px);
  if (!good) return wrong("camera", "its focal length or centre cannot be");
  const std::size_t count = camera.distortion.size();
  if (count == 0 || count == 4 || count == 5 || count == 8) return {};
  return wrong("camera", "it has " + std::to_string(count) + " distortion coefficients", "give 0, 4, 5 or 8");
}

Status check_board(const CharucoBody& board) {
  const std::string where = "board " + board.name;
  if (board.squares_x < 3 || board.squares_y < 3) return wrong(where, "it needs three squares each way");
  if (board.squares_y % 2 == 0) {
    return wrong(where, "it has an even number of rows, which versions of OpenCV draw differently", "print an odd one");
  }
  if (!(board.marker_m > 0.0 && board.marker_m < board.square_m)) {
    return wrong(where, "its markers must be smaller than its squares");
  }
  return {};
}

/// Each marker belongs to one body, and is in the dictionary.
Status check_ids(const ArucoSettings& settings, int dictionary_size) {
  std::set<int> taken;
  const auto take = [&](int marker, const std::string& where) -> Status {
    if (marker < 0 || marker >= dictionary_size) {
      return wrong(where, "the dictionary has no marker " + std::to_string(marker), "use a larger dictionary");
    }
    if (taken.insert(marker).second) return {};
    return wrong(where, "marker " + std::to_string(marker) + " is on another body, or twice on this one");
  };
  for (const CharucoBody& board : settings.boards) {
    for (int i = 0; i < board.squares_x * board.squares_y / 2; ++i) {
      if (Status done = take(i, "board " + board.name); !done) return done;
    }
  }
  for (const MarkerBody& body : settings.bodies) {
    if (body.markers.empty()) return wrong("body " + body.name, "it carries no marker");
    for (const MarkerOnBody& marker : body.markers) {
      if (!(marker.size_m > 0.0)) return wrong("body " + body.name, "a marker has no size");
      if (Status done = take(marker.marker, "body " + body.name); !done) return done;
    }
  }
  return {};
}

/// A marker's corners as OpenCV lists them: from its upper left one, clockwise.
std::array<glm::dvec3, 4> marker_corners(double size_m) {
  const double h = 0.5 * size_m;
  return {{{-h, h, 0.0}, {h, h, 0.0}, {h, -h, 0.0}, {-h, -h, 0.0}}};
}

}  // namespace

struct MarkerFinder::State {
  ArucoSettings settings;
  cv::Ptr<cv::aruco::Dictionary> dictionary;
  cv::Ptr<cv::aruco::DetectorParameters> parameters;
  std::vector<cv::Ptr<cv::aruco::CharucoBoard>> boards;

  /// Markers in one picture.
  std::vector<int> ids;
  std::vector<Corners> corners;

  void detect(const cv::Mat& image, int refinement);
  SeenPoints points_of(const MarkerBody& body) const;
  SeenPoints points_of(std::size_t board, const cv::Mat& image) const;
  TrackedBody tracked(std::int32_t id, const std::string& name, const SeenPoints& seen) const;
};

void MarkerFinder::State::detect(const cv::Mat& image, int refinement) {
  ids.clear();
  corners.clear();
  parameters->cornerRefinementMethod = refinement;
  try {
    cv::aruco::detectMarkers(image, dictionary, corners, ids, parameters);
  } catch (const cv::Exception&) {
    ids.clear();
    corners.clear();
  }
}

SeenPoints MarkerFinder::State::points_of(const MarkerBody& body) const {
  SeenPoints seen;
  for (const MarkerOnBody& marker : body.markers) {
    // One that is seen twice is a picture of itself somewhere: neither is believed.
    if (std::ranges::count(ids, marker.marker) != 1) continue;
    const auto index = static_cast<std::size_t>(std::ranges::find(ids, marker.marker) - ids.begin());
    const auto at = marker_corners(marker.size_m);
    for (std::size_t i = 0; i < at.size(); ++i) {
      const glm::dvec3 p = marker.body_from_marker.point(at[i]);
      seen.body_m.emplace_back(p.x, p.y, p.z);
      seen.image_px.emplace_back(corners[index][i].x, corners[index][i].y);
    }
  }
  return seen;
}

/// The corners between its squares: told to a fraction of a pixel, and by no marker's size.
SeenPoints MarkerFinder::State::points_of(std::size_t board, const cv::Mat& image) const {
  SeenPoints seen;
  if (ids.empty()) return seen;
  std::vector<int> corner_ids;
  Corners at;
  try {
    cv::aruco::interpolateCornersCharuco(corners, ids, image, boards[board], at, corner_ids);
  } catch (const cv::Exception&) {
    return seen;
  }
  // Corners are counted along the rows from the top; OpenCV's own coordinates of them point down in some versions.
  const CharucoBody& it = settings.boards[board];
  for (std::size_t i = 0; i < corner_ids.size(); ++i) {
    const int column = corner_ids[i] % (it.squares_x - 1) + 1;
    const int row = corner_ids[i] / (it.squares_x - 1) + 1;
    seen.body_m.emplace_back(column * it.square_m, (it.squares_y - row) * it.square_m, 0.0);
    // Markers are counted from the middle of the first pixel, these (OpenCV 4.6) from its corner.
    seen.image_px.emplace_back(at[i].x - 0.5, at[i].y - 0.5);
  }
  return seen;
}

TrackedBody MarkerFinder::State::tracked(std::int32_t id, const std::string& name, const SeenPoints& seen) const {
  TrackedBody body;
  body.id = id;
  body.name = name;
  const auto pose = board_pose(seen, settings);
  if (!pose) return body;
  body.tracked = true;
  body.tracker_from_body = pose->tracker_from_body;
  const double focal_px = std::sqrt(settings.camera.fx_px * settings.camera.fy_px);
  body.mean_error_m = pose->error_px * -pose->tracker_from_body.position_m.z / focal_px;
  return body;
}

MarkerFinder::MarkerFinder(std::unique_ptr<State> state) : state_(std::move(state)) {}
MarkerFinder::MarkerFinder(MarkerFinder&&) noexcept = default;
MarkerFinder& MarkerFinder::operator=(MarkerFinder&&) noexcept = default;
MarkerFinder::~MarkerFinder() = default;

Result<MarkerFinder> MarkerFinder::make(const ArucoSettings& settings) {
  const auto known = dictionaries().find(settings.dictionary);
  if (known == dictionaries().end()) {
    std::string names;
    for (const auto& [name, id] : dictionaries()) names += (names.empty() ? "" : ", ") + name;
    return wrong("dictionary", "there is none named " + settings.dictionary, "one of " + names);
  }
  if (Status good = check_camera(settings.camera); !good) return good.fault();
  auto state = std::make_unique<State>();
  state->settings = settings;
  state->dictionary = cv::aruco::getPredefinedDictionary(known->second);
  for (const CharucoBody& board : settings.boards) {
    if (Status good = check_board(board); !good) return good.fault();
  }
  if (Status good = check_ids(settings, state->dictionary->bytesList.rows); !good) return good.fault();
  state->parameters = cv::aruco::DetectorParameters::create();
  for (const CharucoBody& board : settings.boards) {
    state->boards.push_back(cv::aruco::CharucoBoard::create(board.squares_x, board.squares_y,
                                                            static_cast<float>(board.square_m),
                                                            static_cast<float>(board.marker_m), state->dictionary));
  }
  return MarkerFinder(std::move(state));
}

std::vector<TrackedBody> MarkerFinder::find(const CameraFrame& frame) {
  State& state = *state_;
  std::vector<TrackedBody> bodies;
  // OpenCV has no views of what it may not write.
  const cv::Mat image(frame.height_px, frame.width_px, CV_8UC1, const_cast<std::uint8_t*>(frame.gray.data()));
  if (!state.settings.bodies.empty()) state.detect(image, cv::aruco::CORNER_REFINE_SUBPIX);
  for (const MarkerBody& body : state.settings.bodies) {
    bodies.push_back(state.tracked(body.id, body.name, state.points_of(body)));
  }
  // Between the squares of a board a marker's corner would be drawn to the square's: it is left as it was found.
  if (!state.boards.empty()) state.detect(image, cv::aruco::CORNER_REFINE_NONE);
  for (std::size_t i = 0; i < state.boards.size(); ++i) {
    const CharucoBody& board = state.settings.boards[i];
    bodies.push_back(state.tracked(board.id, board.name, state.points_of(i, image)));
  }
  return bodies;
}

}  // namespace focalstage
