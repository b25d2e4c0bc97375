#include "core/reference/sight.h"

#include <cmath>
#include <limits>
#include <utility>

#include <embree3/rtcore.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace focalstage {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

/// Where a corner lies beside the look, in the plane through it square to the axis.
glm::dvec2 beside(const glm::dvec3& corner_m, const glm::dvec2& look) {
  return glm::dvec2(corner_m) + corner_m.z * look;
}

double turn(const glm::dvec2& from, const glm::dvec2& to) { return from.x * to.y - from.y * to.x; }

/// The look's meeting with one triangle. It passes all edges on one side inside; an edge run the other way gives
/// exactly the negative number, and all triangles of a corner place it alike, so that no look slips between neighbours.
std::optional<Sighting> meeting(const SeenTriangle& corners_m, const glm::dvec2& look, double nearest_m) {
  const glm::dvec2 a = beside(corners_m[0], look);
  const glm::dvec2 b = beside(corners_m[1], look);
  const glm::dvec2 c = beside(corners_m[2], look);
  const glm::dvec3 volumes{turn(b, c), turn(c, a), turn(a, b)};
  const bool outside = glm::min(volumes.x, glm::min(volumes.y, volumes.z)) < 0.0 &&
                       glm::max(volumes.x, glm::max(volumes.y, volumes.z)) > 0.0;
  const double whole = volumes.x + volumes.y + volumes.z;
  if (outside || whole == 0.0) return std::nullopt;
  Sighting seen;
  seen.shares = volumes / whole;
  seen.depth_m = -glm::dot(seen.shares, glm::dvec3(corners_m[0].z, corners_m[1].z, corners_m[2].z));
  if (!(seen.depth_m >= nearest_m)) return std::nullopt;
  return seen;
}

/// What one query carries through Embree's walk.
struct Query : RTCIntersectContext {
  const std::vector<SeenTriangle>* triangles = nullptr;
  double nearest_m = 0.0;
  glm::dvec2 look{0.0};
  const std::function<bool(const Sighting&)>* solid = nullptr;
  std::optional<Sighting> best;
};

void report_bounds(const RTCBoundsFunctionArguments* asked) {
  const auto& triangles = *static_cast<const std::vector<SeenTriangle>*>(asked->geometryUserPtr);
  const auto& [a, b, c] = triangles[asked->primID];
  const glm::dvec3 low = glm::min(a, glm::min(b, c));
  const glm::dvec3 high = glm::max(a, glm::max(b, c));
  // Room for the rounding of the bounds and of the ray to float, which grows with the distance from the origin.
  const double slack = 1e-6 * (glm::length(glm::max(glm::abs(low), glm::abs(high))) + 1e-6);
  RTCBounds& bounds = *asked->bounds_o;
  bounds.lower_x = static_cast<float>(low.x - slack);
  bounds.lower_y = static_cast<float>(low.y - slack);
  bounds.lower_z = static_cast<float>(low.z - slack);
  bounds.upper_x = static_cast<float>(high.x + slack);
  bounds.upper_y = static_cast<float>(high.y + slack);
  bounds.upper_z = static_cast<float>(high.z + slack);
}

void meet(const RTCIntersectFunctionNArguments* asked) {
  Query& query = *static_cast<Query*>(asked->context);
  if (asked->N != 1 || asked->valid[0] == 0) return;
  std::optional<Sighting> seen = meeting((*query.triangles)[asked->primID], query.look, query.nearest_m);
  if (!seen) return;
  seen->triangle = asked->primID;
  const bool nearer = !query.best || seen->depth_m < query.best->depth_m ||
                      (seen->depth_m == query.best->depth_m && seen->triangle < query.best->triangle);
  if (!nearer || (*query.solid && !(*query.solid)(*seen))) return;
  query.best = seen;
  RTCRayHit& walk = *reinterpret_cast<RTCRayHit*>(asked->rayhit);
  walk.ray.tfar = std::nextafter(static_cast<float>(seen->depth_m) * (1.0f + 1e-6f), infinity);  // keeps ties in reach
  walk.hit.geomID = asked->geomID;
  walk.hit.primID = asked->primID;
}

}  // namespace

struct Sight::State {
  std::vector<SeenTriangle> triangles;
  double nearest_m = 0.0;
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;

  ~State() {
    if (scene) rtcReleaseScene(scene);
    if (device) rtcReleaseDevice(device);
  }
};

Result<Sight> Sight::of(std::vector<SeenTriangle> triangles, double nearest_m) {
  const auto state = std::make_shared<State>();
  state->triangles = std::move(triangles);
  state->nearest_m = nearest_m;
  state->device = rtcNewDevice(nullptr);
  if (!state->device) return Fault{"reference.embree", "", "the ray tracing library does not start", ""};
  state->scene = rtcNewScene(state->device);
  rtcSetSceneFlags(state->scene, RTC_SCENE_FLAG_ROBUST);
  RTCGeometry geometry = rtcNewGeometry(state->device, RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(state->triangles.size()));
  rtcSetGeometryUserData(geometry, &state->triangles);
  rtcSetGeometryBoundsFunction(geometry, report_bounds, nullptr);
  rtcSetGeometryIntersectFunction(geometry, meet);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(state->scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(state->scene);
  if (const RTCError error = rtcGetDeviceError(state->device); error != RTC_ERROR_NONE) {
    return Fault{"reference.embree", "", "the ray tracing library reports error " + std::to_string(error), ""};
  }
  return Sight(state);
}

std::optional<Sighting> Sight::nearest(const glm::dvec2& look,
                                       const std::function<bool(const Sighting&)>& solid) const {
  if (state_->triangles.empty() || !std::isfinite(look.x) || !std::isfinite(look.y)) return std::nullopt;
  Query query;
  rtcInitIntersectContext(&query);
  query.triangles = &state_->triangles;
  query.nearest_m = state_->nearest_m;
  query.look = look;
  query.solid = &solid;
  RTCRayHit walk{};
  walk.ray.dir_x = static_cast<float>(look.x);
  walk.ray.dir_y = static_cast<float>(look.y);
  walk.ray.dir_z = -1.0f;
  walk.ray.tfar = infinity;
  walk.ray.mask = ~0u;
  walk.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  walk.hit.primID = RTC_INVALID_GEOMETRY_ID;
  walk.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(state_->scene, &query, &walk);
  return query.best;
}

}  // namespace focalstage
