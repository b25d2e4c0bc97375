#include "core/percept/conflict_meter.h"

#include <cmath>
#include <utility>

#include "core/percept/conflict.h"
#include "core/percept/things.h"

namespace focalstage {
namespace {

constexpr int most_looks = 12;

/// As much as the lens shows, at about a third of a degree a pixel: conflict changes slowly over a thing.
RetinaView view_of(Side side) {
  RetinaView view;
  view.eye = side;
  view.width_px = 180;
  view.height_px = 180;
  view.fov_deg = 60.0;
  return view;
}

}  // namespace

bool looked_at_for_conflict(int frame, int frames) {
  if (frames <= most_looks) return true;
  const auto chosen = [&](int look) {
    return static_cast<int>(std::lround(static_cast<double>(look) * (frames - 1) / (most_looks - 1)));
  };
  for (int look = 0; look < most_looks; ++look) {
    if (chosen(look) == frame) return true;
  }
  return false;
}

ConflictMeter::ConflictMeter(const Project& project, CompileSettings settings, Schedule schedule)
    : ConflictMeter(project, std::vector{std::move(settings)}, std::vector{std::move(schedule)}) {}

ConflictMeter::ConflictMeter(const Project& project, std::vector<CompileSettings> settings,
                             std::vector<Schedule> schedules)
    : settings_(std::move(settings)),
      schedules_(std::move(schedules)),
      glasses_(worn_glasses(project.glasses)),
      sums_(project.objects.size()) {}

Status ConflictMeter::add(const Stage& stage, const FrameImages& images, std::stop_token stop) {
  return add(stage, std::vector{&images}, std::move(stop));
}

Status ConflictMeter::add(const Stage& stage, const std::vector<const FrameImages*>& images, std::stop_token stop) {
  for (const Side side : both_sides) {
    std::vector<RetinaInput> inputs;
    for (std::size_t i = 0; i < images.size(); ++i)
      inputs.push_back(seen_frame(stage, settings_[i], *images[i], schedules_[i], glasses_, side));
    const RetinaView view = view_of(side);
    const auto focus = retinas_[side].driven_focus(inputs, view, stop);
    if (!focus) return focus.fault();
    const ThingMap things = things_seen(inputs.front(), view, {}, stop);
    if (stop.stop_requested()) return Fault{"retina.cancelled", "", "stopped before the end", ""};
    for (const ThingConflict& conflict : thing_conflicts(things, *focus)) {
      const SeenThing& thing = things.things[conflict.thing];
      if (thing.kind != SeenThing::Kind::object || !(conflict.light > 0.0) || thing.index >= sums_.size()) continue;
      Sum& sum = sums_[thing.index];
      sum.light += conflict.light;
      sum.mean_d += conflict.light * conflict.mean_d;
      sum.beyond += conflict.light * conflict.beyond_comfort;
      if (std::abs(conflict.worst_d) > std::abs(sum.worst_d)) sum.worst_d = conflict.worst_d;
    }
  }
  return {};
}

std::vector<ObjectConflict> ConflictMeter::conflicts() const {
  std::vector<ObjectConflict> all;
  for (std::size_t i = 0; i < sums_.size(); ++i) {
    const Sum& sum = sums_[i];
    if (sum.light > 0.0) all.push_back({i, sum.mean_d / sum.light, sum.worst_d, sum.beyond / sum.light});
  }
  return all;
}

}  // namespace focalstage
