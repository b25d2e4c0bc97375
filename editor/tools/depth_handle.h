#pragma once

#include <array>
#include <optional>
#include <string>

#include "core/scene/edit.h"
#include "editor/tools/room_view.h"
#include "editor/tools/sight_frame.h"

namespace focalstage {

/// More than this between where the eyes turn and where they focus tires most people (Shibata et al. 2011 speak of
/// half a dioptre at usual distances).
inline constexpr double comfortable_conflict_d = 0.5;

/// What an object's depth comes to for the viewer.
struct DepthReading {
  double vergence_d = 0.0;          ///< where the eyes turn: 1 / axial distance of the object's centre
  double accommodation_d = 0.0;     ///< where it comes into focus; 0 or less: at infinity and beyond
  double conflict_d = 0.0;          ///< accommodation less vergence
  std::optional<double> surface_m;  ///< the real surface behind it: what a pinned slice's depth depends on

  bool tires() const { return conflict_d > comfortable_conflict_d || conflict_d < -comfortable_conflict_d; }
};

/// None for what lies behind the lenses or has no shape, and for a slice pinned where no surface is behind the object.
std::optional<DepthReading> read_depth(const Project& project, const Stage& stage, const StagedObject& object,
                                       Picker& picker);

/// The wanted image depth of an object as a sheet square to the gaze, as large as the object is seen.
struct DepthSheet {
  std::array<glm::dvec3, 4> corners_m;  ///< lower left, lower right, upper right, upper left as the viewer sees it
  glm::dvec3 centre_m{0.0};
  glm::dvec2 look{0.0};  ///< from the viewer to the centre
};

/// None where the wanted depth is farther than `farthest_m` (infinity and beyond included).
std::optional<DepthSheet> depth_sheet(const SightFrame& sight, const StagedObject& object, double accommodation_d,
                                      double farthest_m = 20.0);

/// A hand that holds the sheet.
struct DepthDrag {
  std::string object;
  SightFrame sight;
  RoomView view;
  glm::dvec2 look{0.0};
  double offset_m = 0.0;  ///< along the line of sight, from what is under the pointer to the sheet
  double start_d = 0.0;
};

DepthDrag start_depth_drag(const StagedObject& object, const SightFrame& sight, const DepthSheet& sheet,
                           double accommodation_d, const RoomView& view, const glm::dvec2& pixel);

/// The wanted depth with the pointer at `pixel`: between 20 D and 0.05 D, in steps of `snap_d` where above zero.
double vergence_dragged_d(const DepthDrag& drag, const glm::dvec2& pixel, double snap_d = 0.0);

/// All of the object into focus at that vergence, to a thousandth of a dioptre.
Edit depth_edit(const std::string& object, double vergence_d);

}  // namespace focalstage
