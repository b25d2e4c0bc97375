#include "editor/window/views/room_frame.h"

#include "core/optics/eye.h"

namespace focalstage {

RoomView room_view(const Session& session, glm::ivec2 size_px) {
  const ViewState& state = session.view();
  const Project& project = session.project();
  const glm::dvec2 size(size_px);
  switch (state.look_through) {
    case LookThrough::left_eye:
    case LookThrough::right_eye: {
      if (!session.stage()) break;
      const PerEye<Eye> eyes = eyes_of(session.stage()->world_from_viewer, session.stage()->interpupillary_m,
                                       project.glasses.lens_to_pupil_mm * 1e-3);
      const Side side = state.look_through == LookThrough::left_eye ? Side::left : Side::right;
      return eye_view(eyes[side], size, state.fov_deg);
    }
    case LookThrough::projector:
      if (project.projectors.empty()) break;
      return projector_view(projector_model(project.projectors.front()), size);
    case LookThrough::nothing:
      break;
  }
  return view_of(state.camera, size);
}

}  // namespace focalstage
