#pragma once

#include <optional>

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "core/base/rigid.h"
#include "core/optics/eye.h"
#include "core/optics/projector_model.h"

namespace focalstage {

/// A half line in the world; `direction` is of length one.
struct Ray {
  glm::dvec3 origin_m{0.0};
  glm::dvec3 direction{0.0, 0.0, -1.0};

  glm::dvec3 at(double distance_m) const { return origin_m + distance_m * direction; }
};

/// What a picture of the room is taken with: a pinhole that looks along its own -Z with +Y up, its axis anywhere in the
/// picture. Pixels as everywhere: the origin is the top left corner, centres are at halves.
struct RoomView {
  Rigid world_from_camera;
  glm::dvec2 size_px{1.0};
  glm::dvec2 focal_px{1.0};
  glm::dvec2 centre_px{0.5};  ///< where the axis meets the picture
  double near_m = 0.01;
  double far_m = 100.0;

  bool operator==(const RoomView&) const = default;
};

/// Where a point of the world lies before the camera, along its axis; negative behind it.
double depth_m(const RoomView& view, const glm::dvec3& world_m);

/// The pixel on which a point lands; none for what is nearer than the near plane.
std::optional<glm::dvec2> pixel_of(const RoomView& view, const glm::dvec3& world_m);

/// The half line that lands on `pixel`, from the camera.
Ray ray_through(const RoomView& view, const glm::dvec2& pixel);

/// How many metres square to the axis one pixel covers at the point's depth (at the near plane, if it is nearer).
double metres_per_px(const RoomView& view, const glm::dvec3& world_m);

glm::dmat4 camera_from_world(const RoomView& view);

/// OpenGL's: near at -1, far at 1, y up.
glm::dmat4 clip_from_camera(const RoomView& view);

/// What one eye sees without its lens, over `fov_deg` from left to right.
RoomView eye_view(const Eye& eye, const glm::dvec2& size_px, double fov_deg);

/// What a projector lights, its whole picture inside the view; its distortion is left out.
RoomView projector_view(const ProjectorModel& projector, const glm::dvec2& size_px);

}  // namespace focalstage
