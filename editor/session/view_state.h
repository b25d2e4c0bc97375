#pragma once

#include <optional>
#include <string>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "core/base/sides.h"
#include "core/sensitivity/rig_errors.h"
#include "editor/preview/preview_values.h"
#include "editor/session/thing.h"
#include "editor/tools/handle_frame.h"
#include "editor/tools/motion_steer.h"
#include "editor/tools/room_camera.h"

namespace focalstage {

enum class PaneId { room, projector, eye, time };
enum class LookThrough { nothing, left_eye, right_eye, projector };
/// Whose images the projector view shows: with breathing compensated, without, or how the two differ.
enum class ShownBreathing { on, off, difference };
enum class ProjectorPicture { slice, assignment };

/// A six-axis input (a SpaceMouse) at this editor.
struct SteeringState {
  bool present = false;         ///< it is plugged in; where not, nothing is shown of it
  bool moves_selected = false;  ///< else the room's camera
  SteerSettings how;

  bool operator==(const SteeringState&) const = default;
};

/// What the views show and how: nothing of this is the project's.
struct ViewState {
  std::optional<PaneId> filled;  ///< the one pane that fills the centre

  RoomCamera camera;
  LookThrough look_through = LookThrough::nothing;
  bool show_sheets = true;
  bool show_frusta = true;
  bool tint_by_slice = false;
  HandleTool tool = HandleTool::move;
  HandleSpace space = HandleSpace::world;
  bool snap = false;
  double snap_m = 0.01;
  double snap_deg = 5.0;
  SteeringState steering;

  Side side = Side::left;  ///< whose images the projector view shows
  int image = 0;           ///< in the image plan
  ProjectorPicture picture = ProjectorPicture::slice;
  ShownBreathing compensation = ShownBreathing::on;
  double zoom = 0.0;  ///< screen pixels per projector pixel; 0: fit
  glm::dvec2 pan_px{0.0};

  EyeLook eye = EyeLook::left;
  double focus_d = 2.0;  ///< accommodation, as a vergence from the lens centre
  double pupil_mm = 4.0;
  EyeProjection projection = EyeProjection::multifocal;
  bool conflict = false;          ///< tint what vergence and accommodation disagree about, in eye and room
  glm::dvec3 head_offset_m{0.0};  ///< in the viewer's axes, at most 5 cm
  double fov_deg = 40.0;
  ErrorAmounts rig_errors;  ///< by how much the rig that the eye's view shows is off

  std::optional<double> sweep_time_s;  ///< the moment of the sweep that all views follow; none: the whole period
  int frame = 0;
  bool playing = false;              ///< the timeline, not the rig
  std::optional<double> key_time_s;  ///< the chosen key of the selected thing: what Delete removes

  std::optional<Thing> renaming;  ///< whose name is being typed in the outline

  std::string bottom_tab = "findings";  ///< the panel shown below the views

  bool operator==(const ViewState&) const = default;
};

/// What the eye's view asks for, as a picture of `size_px`; over the whole period, in the rig that the project says.
inline EyeWish eye_wish(const ViewState& view, const glm::ivec2& size_px) {
  return {view.eye,
          view.focus_d,
          view.pupil_mm,
          view.projection,
          view.conflict,
          view.head_offset_m,
          view.fov_deg,
          size_px.x,
          size_px.y,
          {},
          {}};
}

}  // namespace focalstage
