#include "tests/bench/rays.h"

#include <algorithm>
#include <cmath>

#include <embree3/rtcore.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <glm/geometric.hpp>

#include "core/optics/assignment.h"
#include "core/optics/eye.h"
#include "core/optics/look.h"
#include "tests/bench/ray_tree.h"

namespace focalstage::bench {
namespace {

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
    lit = std::make_unique<RayTree>(device, real, of.settings.projector.world_from_projector.inverse());
    for (const Side side : both_sides) {
      surfaces[side] = std::make_unique<RayTree>(device, real, eyes[side].eye_from_world);
      objects[side] = std::make_unique<RayTree>(device, shown, eyes[side].eye_from_world);
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

  bool meets(int x, int y, RayTree::Hit& hit) const {
    return lit->nearest(tangent_of_pixel(scene->settings.projector, {x + 0.5, y + 0.5}), 0.0f, hit);
  }

  bool sees(Side side, const RayTree::Hit& hit, EyePoint& eye) const {
    const double nearest_m = scene->settings.lens_to_pupil_m + 1e-3;
    eye.point_m = eye_from_projector[side].point(hit.point_m);
    if (-eye.point_m.z < nearest_m) return false;
    eye.normal = eye_from_projector[side].direction(hit.normal);
    eye.straight = straight_look(eye.point_m);
    return true;
  }

  bool hidden(Side side, const EyePoint& eye) const {
    const auto nearest_m = static_cast<float>(scene->settings.lens_to_pupil_m + 1e-3);
    return scene->surfaces_hide && surfaces[side]->hidden(eye.straight, nearest_m, static_cast<float>(-eye.point_m.z));
  }

  std::uint8_t shown(Side side, const EyePoint& eye, std::size_t n) const {
    const double lens_to_pupil_m = scene->settings.lens_to_pupil_m;
    const double own_m = -eye.point_m.z - lens_to_pupil_m;
    const glm::dvec2 look = eye.straight * look_stretch(scene->settings.slices.powers_d[n], own_m, lens_to_pupil_m);
    RayTree::Hit met;
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
  std::unique_ptr<RayTree> lit;
  PerEye<std::unique_ptr<RayTree>> surfaces;
  PerEye<std::unique_ptr<RayTree>> objects;
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
  std::vector<std::uint8_t> hidden(pixels);  // from the eye at work; no slice changes it
  const auto trace = [&](Side side, std::size_t from_slice, std::size_t to_slice) {
    const auto trace_pixel = [&](int x, int y) {
      RayTree::Hit hit;
      State::EyePoint eye;
      if (!state_->meets(x, y, hit) || !state_->sees(side, hit, eye)) return;
      const std::size_t at = static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x);
      if (from_slice == 0) hidden[at] = state_->hidden(side, eye) ? 1 : 0;
      if (hidden[at] != 0) return;
      std::uint8_t* code = &codes[index_of(side) * slices * pixels + at];
      for (std::size_t n = from_slice; n < to_slice; ++n) code[n * pixels] = state_->shown(side, eye, n);
    };
    tbb::parallel_for(tbb::blocked_range<int>(0, projector.height_px, 8), [&](const tbb::blocked_range<int>& rows) {
      for (int y = rows.begin(); y < rows.end(); ++y) {
        for (int x = 0; x < projector.width_px; ++x) trace_pixel(x, y);
      }
    });
  };
  for (const Side side : both_sides) {
    if (hits == Hits::kept) trace(side, 0, slices);
    for (std::size_t n = 0; hits == Hits::anew && n < slices; ++n) trace(side, n, n + 1);
  }
}

}  // namespace focalstage::bench
