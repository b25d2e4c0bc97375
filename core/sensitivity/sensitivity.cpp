#include "core/sensitivity/sensitivity.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "core/mesh/circle.h"
#include "core/sensitivity/light_path.h"

namespace focalstage {
namespace {

constexpr std::size_t most_points = 24;  // of an object

/// A vertex of an object; the stage of another project with the same things has it at the same place.
struct Sample {
  std::size_t object = 0;  ///< in the stage's list
  std::size_t drawable = 0;
  std::size_t vertex = 0;
};

glm::dvec3 place_m(const Stage& stage, const Sample& sample) {
  const Drawable& drawable = stage.objects[sample.object].drawables[sample.drawable];
  return glm::dvec3(drawable.world_from_mesh * glm::dvec4(drawable.mesh->positions_m[sample.vertex], 1.0));
}

/// Some vertices of each object, evenly out of all.
std::vector<Sample> samples_of(const Stage& stage) {
  std::vector<Sample> samples;
  for (std::size_t object = 0; object < stage.objects.size(); ++object) {
    const std::vector<Drawable>& drawables = stage.objects[object].drawables;
    std::size_t all = 0;
    for (const Drawable& drawable : drawables) all += drawable.mesh->positions_m.size();
    const std::size_t step = std::max<std::size_t>(1, all / most_points);
    std::size_t before = 0;
    for (std::size_t k = 0; k < drawables.size(); ++k) {
      const std::size_t count = drawables[k].mesh->positions_m.size();
      for (std::size_t i = 0; i < count; ++i) {
        if ((before + i) % step == 0) samples.push_back({object, k, i});
      }
      before += count;
    }
  }
  return samples;
}

/// What one eye is shown of a sample, by the rig as the project has it.
struct Shown {
  Sample sample;
  Side eye = Side::left;
  Exposed exposed;
  double off_d = 0.0;  ///< of its accommodation, with nothing wrong: the slices are what they are
};

std::vector<Shown> shown_in(const RoomOfLight& room, const std::vector<double>& powers_d) {
  std::vector<Shown> all;
  for (const Sample& sample : samples_of(room.stage)) {
    const Depth& depth = room.stage.objects[sample.object].depth;
    for (const Side eye : both_sides) {
      const auto wanted = meant(room, eye, depth, place_m(room.stage, sample));
      if (!wanted) continue;
      const auto exposure = exposed(room, eye, depth, powers_d, *wanted);
      if (!exposure) continue;
      const auto seen = arrived(room, eye, exposure->pixel, exposure->power_d);
      if (!seen || glm::distance(seen->look, wanted->look) > 1e-3) continue;  // something stands before the surface
      all.push_back({sample, eye, *exposure, seen->vergence_d - wanted->vergence_d});
    }
  }
  return all;
}

double angle_arcmin(const glm::dvec2& a, const glm::dvec2& b) {
  const glm::dvec3 u(a, 1.0);
  const glm::dvec3 v(b, 1.0);
  return std::atan2(glm::length(glm::cross(u, v)), glm::dot(u, v)) * 180.0 / pi * 60.0;
}

/// Adds what a rig that is really `room` makes of what is shown.
void add_effect(const RoomOfLight& room, const std::vector<Shown>& shown, ErrorEffect& effect) {
  struct Turn {
    Sample sample;
    Side eye = Side::left;
    double aside = 0.0;
  };
  std::optional<Turn> before;  // of the same sample's other eye
  for (const Shown& one : shown) {
    const StagedObject& object = room.stage.objects[one.sample.object];
    const auto wanted = meant(room, one.eye, object.depth, place_m(room.stage, one.sample));
    const auto seen =
        arrived(room, one.eye, one.exposed.pixel, one.exposed.power_d + effect.error.power_d * effect.error.amount);
    if (!wanted || !seen) continue;
    const double shift_arcmin = angle_arcmin(seen->look, wanted->look);
    if (shift_arcmin > effect.shift_arcmin || effect.object.empty()) effect.object = object.name;
    effect.shift_arcmin = std::max(effect.shift_arcmin, shift_arcmin);
    effect.focus_d = std::max(effect.focus_d, std::abs(seen->vergence_d - wanted->vergence_d - one.off_d));
    const Turn turn{one.sample, one.eye, seen->look.x - wanted->look.x};
    const bool same = before && before->eye != turn.eye && before->sample.object == turn.sample.object &&
                      before->sample.drawable == turn.sample.drawable && before->sample.vertex == turn.sample.vertex;
    if (same && room.stage.interpupillary_m > 0.0) {
      const double vergence_d = std::abs(turn.aside - before->aside) / room.stage.interpupillary_m;
      effect.vergence_d = std::max(effect.vergence_d, vergence_d);
    }
    before = turn;
  }
}

}  // namespace

Result<std::vector<ErrorEffect>> sensitivity(const Project& project, const Assets& assets, int frames) {
  if (project.projectors.empty()) {
    return Fault{"project.no-projector", "/projectors", "the project has no projector", "add one"};
  }
  if (project.slices.powers_d.empty()) {
    return Fault{"project.no-slices", "/slices/powers_d", "the project has no slices", "add one"};
  }
  std::vector<ErrorEffect> effects;
  for (RigError& error : rig_errors(project)) effects.push_back({std::move(error), 0.0, 0.0, 0.0, {}});
  const int looked_at = std::max(1, std::min(frames, project.frames.count));
  for (int k = 0; k < looked_at; ++k) {
    const int frame = static_cast<int>(static_cast<long long>(k) * project.frames.count / looked_at);
    const double time_s = frame / project.frames.rate_hz;
    const auto room = RoomOfLight::of(project, assets, time_s);
    if (!room) return room.fault();
    const std::vector<Shown> shown = shown_in(*room, project.slices.powers_d);
    for (ErrorEffect& effect : effects) {
      Project real = project;
      effect.error.make(real, effect.error.amount);
      const auto real_room = RoomOfLight::of(real, assets, time_s + effect.error.late_s * effect.error.amount);
      if (!real_room) return real_room.fault();
      add_effect(*real_room, shown, effect);
    }
  }
  return effects;
}

}  // namespace focalstage
