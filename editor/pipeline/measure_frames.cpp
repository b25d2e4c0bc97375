#include "editor/pipeline/measure_frames.h"

#include <iterator>
#include <memory>
#include <utility>

#include "core/percept/conflict_meter.h"

namespace focalstage {
namespace {

/// The images of a frame, of each projector: those of a show, or freshly compiled.
class FrameOfAll {
 public:
  Status read(const ShowReader& show, int k) {
    for (std::size_t i = 0; i < show.header().projectors(); ++i) {
      auto images = show.frame(k, i);
      if (!images) return images.fault();
      images_.push_back(std::make_shared<const FrameImages>(*std::move(images)));
    }
    return {};
  }
  Status compile(FrameMaker& maker, std::vector<std::vector<FrameMeasure>>& measures, const std::stop_token& stop) {
    for (std::size_t i = 0; i < maker.projectors(); ++i) {
      auto made = maker.compile(stop, i);
      if (!made) return made.fault();
      images_.push_back(std::move(made->images));
      measures[i].push_back(std::move(made->measure));
    }
    return {};
  }
  std::vector<const FrameImages*> images() const {
    std::vector<const FrameImages*> all;
    for (const auto& one : images_) all.push_back(one.get());
    return all;
  }

 private:
  std::vector<std::shared_ptr<const FrameImages>> images_;
};

std::vector<CompileSettings> settings_of(const FrameMaker& maker, std::size_t projectors) {
  std::vector<CompileSettings> all;
  for (std::size_t i = 0; i < projectors; ++i) all.push_back(maker.settings(i));
  return all;
}

}  // namespace

std::vector<ScheduleResult> schedules_of(const FrameMaker& maker) {
  std::vector<ScheduleResult> all;
  for (std::size_t i = 0; i < maker.projectors(); ++i)
    all.push_back(make_schedule(maker.project(), maker.settings(i).images, i));
  return all;
}

std::vector<Schedule> plain(const std::vector<ScheduleResult>& results) {
  std::vector<Schedule> all;
  for (const ScheduleResult& result : results) all.push_back(result.schedule);
  return all;
}

Result<Measured> measure_frames(FrameMaker& maker, const FramesToMeasure& what, const FrameProgress& progress,
                                const std::stop_token& stop) {
  ConflictMeter conflict(maker.project(), settings_of(maker, what.schedules.size()), what.schedules);
  Measured measured;
  std::vector<std::vector<FrameMeasure>> measures(what.schedules.size());
  for (std::size_t i = 0; what.show && i < measures.size(); ++i) measures[i] = what.show->measures(i);
  const int count = what.frames.end - what.frames.begin;
  for (int k = 0; k < count; ++k) {
    if (stop.stop_requested()) {
      return Fault{"compile.cancelled", maker.project().name, "stopped before the end", ""};
    }
    if (Status stood = maker.stand_up(what.frames.begin + k); !stood) return stood.fault();
    if (k == 0) {
      measured.meshes = mesh_states(maker.project(), maker.staged());
      measured.lit = surfaces_in_light(maker.project(), maker.staged());
    }
    const bool looked_at = looked_at_for_conflict(k, count);
    FrameOfAll frame;
    Status there;
    if (!what.show) there = frame.compile(maker, measures, stop);
    if (what.show && looked_at) there = frame.read(*what.show, k);
    if (!there) return there.fault();
    if (looked_at) {
      if (Status seen = conflict.add(maker.staged(), frame.images(), stop); !seen) return seen.fault();
    }
    measured.coverage.push_back(maker.coverage());
    progress(k + 1, count);
  }
  measured.frames = std::move(measures.at(0));
  measured.others.assign(std::make_move_iterator(measures.begin() + 1), std::make_move_iterator(measures.end()));
  measured.conflicts = conflict.conflicts();
  return measured;
}

}  // namespace focalstage
