#include "tests/bench/rays.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <embree3/rtcore.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <glm/geometric.hpp>

#include "core/optics/assignment.h"
#include "core/optics/eye.h"
#include "core/optics/look.h"

namespace focalstage::bench {
namespace {

/// Drawables as one Embree scene, in the space of who looks.
class Tree {
 public:
  Tree(RTCDevice device, const std::vector<const Drawable*>& drawables, const Rigid& view_from_world)
      : drawables_(drawables), scene_(rtcNewScene(device)) {
    rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(scene_, RTC_BUILD_QUALITY_HIGH);
    for (const Drawable* drawable : drawables)
      add(device, *drawable, view_from_world.matrix() * drawable->world_from_mesh);
    rtcCommitScene(scene_);
  }
  ~Tree() { rtcReleaseScene(scene_); }
  Tree(const Tree&) = delete;
  Tree& operator=(const Tree&) = delete;

  struct Hit {
    const Drawable* drawable;
    glm::dvec3 point_m;
    glm::dvec3 normal;
    glm::dvec2 uv;
  };

  bool nearest(const glm::dvec2& look, float nearest_m, Hit& hit) const {
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
    const double u = static_cast<double>(walk.hit.u), v = static_cast<double>(walk.hit.v);
    if (!mesh.uvs.empty()) hit.uv = mesh.uvs[t.x] * (1.0 - u - v) + mesh.uvs[t.y] * u + mesh.uvs[t.z] * v;
    return true;
  }

  bool hidden(const glm::dvec2& look, float nearest_m, float depth_m) const {
    RTCRayHit walk = ray(look, nearest_m, depth_m * (1.0f - 1e-4f));
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcOccluded1(scene_, &context, &walk.ray);
    return walk.ray.tfar < 0.0f;
  }

 private:
  static RTCRayHit ray(const glm::dvec2& look, float from_m, float to_m) {
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

  void add(RTCDevice device, const Drawable& drawable, const glm::dmat4& view_from_mesh) {
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

  std::vector<const Drawable*> drawables_;
  std::vector<std::vector<glm::dvec3>> points_;
  RTCScene scene_;
};

template <class Thing>
std::vector<const Drawable*> drawables_of(const std::vector<Thing>& things) {
  std::vector<const Drawable*> all;
  for (const Thing& thing : things) {
    for (const Drawable& drawable : thing.drawables) all.push_back(&drawable);
  }
  return all;
}

double gray_of(const Finish& finish, const glm::dvec2& uv) {
  const bool first =
      finish.kind != Finish::Kind::checker ||
      ((static_cast<int>(std::floor(uv.x * finish.squares.x)) + static_cast<int>(std::floor(uv.y * finish.squares.y))) &
       1) == 0;
  const glm::dvec3& colour = first ? finish.a : finish.b;
  return 0.2126 * colour.x + 0.7152 * colour.y + 0.0722 * colour.z;
}

}  // namespace

struct NaiveRays::State {
  State(const BenchScene& of, RTCDevice made)
      : scene(&of),
        device(made),
        rule(of.settings.slices.powers_d, of.settings.slices.assignment),
        eyes(eyes_of(of.stage.world_from_viewer, of.stage.interpupillary_m, of.settings.lens_to_pupil_m)) {
    const std::vector<const Drawable*> real = drawables_of(of.stage.surfaces);
    const std::vector<const Drawable*> shown = drawables_of(of.stage.objects);
    lit = std::make_unique<Tree>(device, real, of.settings.projector.world_from_projector.inverse());
    for (const Side side : both_sides) {
      surfaces[side] = std::make_unique<Tree>(device, real, eyes[side].eye_from_world);
      objects[side] = std::make_unique<Tree>(device, shown, eyes[side].eye_from_world);
      eye_from_projector[side] = eyes[side].eye_from_world * of.settings.projector.world_from_projector;
    }
  }
  ~State() {
    lit.reset();
    surfaces = {};
    objects = {};
    rtcReleaseDevice(device);
  }

  /// Where the ray of a pixel ends, as an eye sees it.
  struct EyePoint {
    glm::dvec3 point_m;
    glm::dvec3 normal;
    glm::dvec2 straight;
  };

  bool meets(int x, int y, Tree::Hit& hit) const {
    return lit->nearest(tangent_of_pixel(scene->settings.projector, {x + 0.5, y + 0.5}), 0.0f, hit);
  }

  bool sees(Side side, const Tree::Hit& hit, EyePoint& eye) const {
    const double nearest_m = scene->settings.lens_to_pupil_m + 1e-3;
    eye.point_m = eye_from_projector[side].point(hit.point_m);
    if (-eye.point_m.z < nearest_m) return false;
    eye.normal = eye_from_projector[side].direction(hit.normal);
    eye.straight = straight_look(eye.point_m);
    return !scene->surfaces_hide ||
           !surfaces[side]->hidden(eye.straight, static_cast<float>(nearest_m), static_cast<float>(-eye.point_m.z));
  }

  std::uint8_t shown(Side side, const EyePoint& eye, std::size_t n) const {
    const double lens_to_pupil_m = scene->settings.lens_to_pupil_m;
    const double own_m = -eye.point_m.z - lens_to_pupil_m;
    const glm::dvec2 look = eye.straight * look_stretch(scene->settings.slices.powers_d[n], own_m, lens_to_pupil_m);
    Tree::Hit met;
    if (!objects[side]->nearest(look, static_cast<float>(lens_to_pupil_m + 1e-3), met)) return 0;
    const double plane_m = plane_distance_m(look, eye.point_m, eye.normal, lens_to_pupil_m);
    const double weight = rule.weight(n, 1.0 / plane_m - 1.0 / (-met.point_m.z - lens_to_pupil_m));
    if (!(weight > 0.0)) return 0;
    return static_cast<std::uint8_t>(255.0 * std::min(1.0, weight * gray_of(met.drawable->finish, met.uv)) + 0.5);
  }

  const BenchScene* scene;
  RTCDevice device;
  SliceRule rule;
  PerEye<Eye> eyes;
  PerEye<Rigid> eye_from_projector;
  std::unique_ptr<Tree> lit;
  PerEye<std::unique_ptr<Tree>> surfaces;
  PerEye<std::unique_ptr<Tree>> objects;
};

NaiveRays::NaiveRays(std::unique_ptr<State> state) : state_(std::move(state)) {}
NaiveRays::~NaiveRays() = default;

Result<std::shared_ptr<NaiveRays>> NaiveRays::of(const BenchScene& scene) {
  RTCDevice device = rtcNewDevice(nullptr);
  if (!device) return Fault{"bench.embree", "", "the ray tracing library does not start", ""};
  return std::shared_ptr<NaiveRays>(new NaiveRays(std::make_unique<State>(scene, device)));
}

void NaiveRays::frame(Hits hits, std::vector<std::uint8_t>& codes) const {
  const ProjectorModel& projector = state_->scene->settings.projector;
  const auto width = static_cast<std::size_t>(projector.width_px);
  const std::size_t slices = state_->rule.count(), pixels = width * static_cast<std::size_t>(projector.height_px);
  codes.assign(2 * slices * pixels, 0);
  const auto rows = [&](Side side, std::size_t from_slice, std::size_t to_slice) {
    tbb::parallel_for(tbb::blocked_range<int>(0, projector.height_px, 8), [&](const tbb::blocked_range<int>& range) {
      for (int y = range.begin(); y < range.end(); ++y) {
        std::uint8_t* row = &codes[index_of(side) * slices * pixels + static_cast<std::size_t>(y) * width];
        for (int x = 0; x < projector.width_px; ++x, ++row) {
          Tree::Hit hit;
          State::EyePoint eye;
          if (!state_->meets(x, y, hit) || !state_->sees(side, hit, eye)) continue;
          for (std::size_t n = from_slice; n < to_slice; ++n) row[n * pixels] = state_->shown(side, eye, n);
        }
      }
    });
  };
  for (const Side side : both_sides) {
    if (hits == Hits::kept) rows(side, 0, slices);
    for (std::size_t n = 0; hits == Hits::anew && n < slices; ++n) rows(side, n, n + 1);
  }
}

}  // namespace focalstage::bench
