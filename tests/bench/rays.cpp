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

  void eye_pixel(Side side, const Tree::Hit& hit, std::size_t at, std::vector<std::uint8_t>& codes) const {
    const CompileSettings& settings = scene->settings;
    const double lens_to_pupil_m = settings.lens_to_pupil_m;
    const glm::dvec3 point_m = eye_from_projector[side].point(hit.point_m);
    const glm::dvec3 normal = eye_from_projector[side].direction(hit.normal);
    const glm::dvec2 straight = straight_look(point_m);
    const auto nearest_m = static_cast<float>(lens_to_pupil_m + 1e-3);
    if (-point_m.z < lens_to_pupil_m + 1e-3) return;
    if (scene->surfaces_hide && surfaces[side]->hidden(straight, nearest_m, static_cast<float>(-point_m.z))) return;
    const std::size_t pixels =
        static_cast<std::size_t>(settings.projector.width_px) * static_cast<std::size_t>(settings.projector.height_px);
    for (std::size_t n = 0; n < rule.count(); ++n) {
      const double stretch = look_stretch(settings.slices.powers_d[n], -point_m.z - lens_to_pupil_m, lens_to_pupil_m);
      Tree::Hit met;
      if (!objects[side]->nearest(straight * stretch, nearest_m, met)) continue;
      const double plane_m = plane_distance_m(straight * stretch, point_m, normal, lens_to_pupil_m);
      const double weight = rule.weight(n, 1.0 / plane_m - 1.0 / (-met.point_m.z - lens_to_pupil_m));
      if (!(weight > 0.0)) continue;
      const double light = std::min(1.0, weight * gray_of(met.drawable->finish, met.uv));
      codes[(index_of(side) * rule.count() + n) * pixels + at] = static_cast<std::uint8_t>(255.0 * light + 0.5);
    }
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

void NaiveRays::frame(std::vector<std::uint8_t>& codes) const {
  const ProjectorModel& projector = state_->scene->settings.projector;
  codes.assign(state_->scene->settings.images.size() * static_cast<std::size_t>(projector.width_px) *
                   static_cast<std::size_t>(projector.height_px),
               0);
  tbb::parallel_for(tbb::blocked_range<int>(0, projector.height_px, 8), [&](const tbb::blocked_range<int>& rows) {
    for (int y = rows.begin(); y < rows.end(); ++y) {
      for (int x = 0; x < projector.width_px; ++x) {
        Tree::Hit hit;
        if (!state_->lit->nearest(tangent_of_pixel(projector, {x + 0.5, y + 0.5}), 0.0f, hit)) continue;
        const std::size_t at =
            static_cast<std::size_t>(y) * static_cast<std::size_t>(projector.width_px) + static_cast<std::size_t>(x);
        for (const Side side : both_sides) state_->eye_pixel(side, hit, at, codes);
      }
    }
  });
}

}  // namespace focalstage::bench
