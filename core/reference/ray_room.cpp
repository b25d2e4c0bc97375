#include "core/reference/ray_room.h"

#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include <embree3/rtcore.h>

namespace focalstage {
namespace {

constexpr double last_part = 1e-3;  ///< of a way, where the thing itself stands

/// Vertices and corners of all surfaces, handed to Embree.
void add_triangles(RTCDevice device, RTCScene scene, unsigned number, const Drawable& drawn,
                   const glm::dvec3& origin_m) {
  if (drawn.mesh->triangles.empty()) return;
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* const points = static_cast<float*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), drawn.mesh->positions_m.size()));
  auto* const corners = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned), drawn.mesh->triangles.size()));
  if (points && corners) {
    for (std::size_t i = 0; i < drawn.mesh->positions_m.size(); ++i) {
      const glm::dvec3 world_m = glm::dvec3(drawn.world_from_mesh * glm::dvec4(drawn.mesh->positions_m[i], 1.0));
      for (int axis = 0; axis < 3; ++axis)
        points[3 * i + static_cast<std::size_t>(axis)] = static_cast<float>(world_m[axis] - origin_m[axis]);
    }
    for (std::size_t i = 0; i < drawn.mesh->triangles.size(); ++i) {
      for (int c = 0; c < 3; ++c) corners[3 * i + static_cast<std::size_t>(c)] = drawn.mesh->triangles[i][c];
    }
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(scene, geometry, number);
  }
  rtcReleaseGeometry(geometry);
}

glm::dvec3 first_point_m(const std::vector<StagedSurface>& surfaces) {
  for (const StagedSurface& surface : surfaces) {
    for (const Drawable& drawn : surface.drawables) {
      if (!drawn.mesh->positions_m.empty())
        return glm::dvec3(drawn.world_from_mesh * glm::dvec4(drawn.mesh->positions_m.front(), 1.0));
    }
  }
  return glm::dvec3(0.0);
}

RTCRay ray_of(const glm::dvec3& from_m, const glm::dvec3& along, double near, double far) {
  RTCRay ray{};
  ray.org_x = static_cast<float>(from_m.x);
  ray.org_y = static_cast<float>(from_m.y);
  ray.org_z = static_cast<float>(from_m.z);
  ray.dir_x = static_cast<float>(along.x);
  ray.dir_y = static_cast<float>(along.y);
  ray.dir_z = static_cast<float>(along.z);
  ray.tnear = static_cast<float>(near);
  ray.tfar = static_cast<float>(far);
  ray.mask = ~0u;
  return ray;
}

}  // namespace

struct RayRoom::State {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  glm::dvec3 origin_m{0.0};
  std::vector<std::pair<std::size_t, std::size_t>> drawables;  ///< surface and drawable of each geometry

  ~State() {
    if (scene) rtcReleaseScene(scene);
    if (device) rtcReleaseDevice(device);
  }
};

Result<RayRoom> RayRoom::of(const std::vector<StagedSurface>& surfaces) {
  const auto state = std::make_shared<State>();
  state->device = rtcNewDevice(nullptr);
  if (!state->device) return Fault{"reference.embree", "", "the ray tracing library does not start", ""};
  state->scene = rtcNewScene(state->device);
  rtcSetSceneFlags(state->scene, RTC_SCENE_FLAG_ROBUST);
  state->origin_m = first_point_m(surfaces);
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    for (std::size_t k = 0; k < surfaces[i].drawables.size(); ++k) {
      const auto number = static_cast<unsigned>(state->drawables.size());
      add_triangles(state->device, state->scene, number, surfaces[i].drawables[k], state->origin_m);
      state->drawables.emplace_back(i, k);
    }
  }
  rtcCommitScene(state->scene);
  if (const RTCError error = rtcGetDeviceError(state->device); error != RTC_ERROR_NONE) {
    return Fault{"reference.embree", "", "the ray tracing library reports error " + std::to_string(error), ""};
  }
  return RayRoom(state);
}

std::optional<double> RayRoom::first(const glm::dvec3& from_m, const glm::dvec3& along, double beyond) const {
  const std::optional<RayHit> met = hit(from_m, along, beyond);
  return met ? std::optional<double>(met->along) : std::nullopt;
}

std::optional<RayHit> RayRoom::hit(const glm::dvec3& from_m, const glm::dvec3& along, double beyond) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRayHit hit{};
  hit.ray = ray_of(from_m - state_->origin_m, along, beyond, std::numeric_limits<float>::infinity());
  hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  hit.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(state_->scene, &context, &hit);
  if (hit.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  const auto [surface, drawable] = state_->drawables[hit.hit.geomID];
  const double u = hit.hit.u, v = hit.hit.v;
  return RayHit{hit.ray.tfar, surface, drawable, hit.hit.primID, {1.0 - u - v, u, v}};
}

bool RayRoom::free(const glm::dvec3& from_m, const glm::dvec3& to_m) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRay ray = ray_of(from_m - state_->origin_m, to_m - from_m, 0.0, 1.0 - last_part);
  rtcOccluded1(state_->scene, &context, &ray);
  return ray.tfar >= 0.0f;
}

}  // namespace focalstage
