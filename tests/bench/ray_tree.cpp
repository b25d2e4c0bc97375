#include "tests/bench/ray_tree.h"

#include <algorithm>
#include <limits>
#include <utility>

#include <glm/geometric.hpp>

namespace focalstage::bench {
namespace {

RTCRayHit ray(const glm::dvec2& look, float from_m, float to_m) {
  RTCRayHit walk{};
  walk.ray.dir_x = static_cast<float>(look.x);
  walk.ray.dir_y = static_cast<float>(look.y);
  walk.ray.dir_z = -1.0f;
  walk.ray.tnear = from_m;
  walk.ray.tfar = to_m;
  walk.ray.mask = ~0u;
  walk.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  return walk;
}

}  // namespace

RayTree::RayTree(RTCDevice device, const std::vector<const Drawable*>& drawables, const Rigid& view_from_world)
    : drawables_(drawables), scene_(rtcNewScene(device)) {
  rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(scene_, RTC_BUILD_QUALITY_HIGH);
  for (const Drawable* drawable : drawables)
    add(device, *drawable, view_from_world.matrix() * drawable->world_from_mesh);
  rtcCommitScene(scene_);
}

RayTree::~RayTree() { rtcReleaseScene(scene_); }

bool RayTree::nearest(const glm::dvec2& look, float nearest_m, Hit& hit) const {
  RTCRayHit walk = ray(look, nearest_m, std::numeric_limits<float>::infinity());
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(scene_, &context, &walk);
  if (walk.hit.geomID == RTC_INVALID_GEOMETRY_ID) return false;
  const std::vector<glm::dvec3>& points = points_[walk.hit.geomID];
  hit.drawable = drawables_[walk.hit.geomID];
  const Mesh& mesh = *hit.drawable->mesh;
  const glm::uvec3& t = mesh.triangles[walk.hit.primID];
  const glm::dvec3& a = points[t.x];
  hit.normal = glm::cross(points[t.y] - a, points[t.z] - a);
  const glm::dvec3 along(look, -1.0);
  hit.point_m = along * (glm::dot(hit.normal, a) / glm::dot(hit.normal, along));  // again in double
  if (mesh.uvs.empty()) return true;
  const double whole = glm::dot(hit.normal, hit.normal);
  const double b = glm::dot(glm::cross(hit.point_m - a, points[t.z] - a), hit.normal) / whole;
  const double c = glm::dot(glm::cross(points[t.y] - a, hit.point_m - a), hit.normal) / whole;
  hit.uv = mesh.uvs[t.x] * (1.0 - b - c) + mesh.uvs[t.y] * b + mesh.uvs[t.z] * c;
  return true;
}

bool RayTree::hidden(const glm::dvec2& look, float nearest_m, float depth_m) const {
  RTCRayHit walk = ray(look, nearest_m, depth_m * (1.0f - 1e-4f));
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(scene_, &context, &walk.ray);
  return walk.ray.tfar < 0.0f;
}

void RayTree::add(RTCDevice device, const Drawable& drawable, const glm::dmat4& view_from_mesh) {
  const Mesh& mesh = *drawable.mesh;
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* positions = static_cast<glm::vec3*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3), mesh.positions_m.size()));
  auto* triangles = static_cast<glm::uvec3*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(glm::uvec3), mesh.triangles.size()));
  std::vector<glm::dvec3> points;
  for (const glm::dvec3& position : mesh.positions_m) {
    points.push_back(glm::dvec3(view_from_mesh * glm::dvec4(position, 1.0)));
    *positions++ = glm::vec3(points.back());
  }
  std::copy(mesh.triangles.begin(), mesh.triangles.end(), triangles);
  points_.push_back(std::move(points));
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene_, geometry);
  rtcReleaseGeometry(geometry);
}

}  // namespace focalstage::bench
