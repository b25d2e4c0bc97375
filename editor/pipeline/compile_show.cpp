#include "editor/pipeline/compile_show.h"

#include <algorithm>
#include <chrono>
#include <memory>
#include <string>
#include <utility>

#include "core/check/check.h"
#include "core/optics/image_plan.h"
#include "core/schedule/schedule.h"
#include "editor/pipeline/frame_queue.h"
#include "io/show/writer.h"

namespace focalstage {
namespace {

Fault cancelled(const std::string& where, const std::string& remedy) {
  return {"compile.cancelled", where, "stopped before the end", remedy};
}

Fault cancelled(const CompileJob& job) {
  return cancelled(job.show.string(), "the finished frames are kept; --resume goes on from them");
}

Result<FrameRange> range_of(const Project& project, const std::optional<FrameRange>& asked) {
  if (project.projectors.empty()) {
    return Fault{"project.no-projector", "/projectors", "the project has no projector", "add one"};
  }
  const int count = project.frames.count;
  const FrameRange range = asked.value_or(FrameRange{0, count});
  if (range.begin < 0 || range.end > count || range.end <= range.begin) {
    return Fault{"frames.range", "--frames " + std::to_string(range.begin) + ":" + std::to_string(range.end),
                 "the project has frames 0:" + std::to_string(count) + " (half-open)", "ask for frames inside that"};
  }
  return range;
}

std::vector<Finding> findings_of(const Source& source, const ScheduleResult& schedule, const Measured& measured) {
  std::vector<Finding> findings = check(source.project, schedule, measured);
  findings.insert(findings.end(), source.notes.begin(), source.notes.end());
  return findings;
}

/// Where finished frames go: to a thread of its own, or, with one thread to use, straight to the file.
class FrameSink {
 public:
  FrameSink(ShowWriter& writer, int threads)
      : writer_(writer), queue_(threads == 1 ? nullptr : std::make_unique<FrameQueue>(writer)) {}

  Status add(int frame, const FrameMaker::Made& made) {
    return queue_ ? queue_->add(frame, made.images, made.measure)
                  : writer_.add_frame(frame, *made.images, made.measure);
  }
  Status drain() { return queue_ ? queue_->drain() : Status{}; }

 private:
  ShowWriter& writer_;
  std::unique_ptr<FrameQueue> queue_;
};

/// Frame after frame to the writer; what was measured apart from compiling comes back.
Result<Measured> write_frames(const CompileJob& job, FrameRange range, FrameMaker& maker, ShowWriter& writer,
                              CompileReport& report, const FrameProgress& progress, const std::stop_token& stop) {
  Measured measured;
  FrameSink sink(writer, job.engine.threads);
  for (int k = 0; k < report.frames; ++k) {
    if (stop.stop_requested()) return cancelled(job);
    if (Status stood = maker.stand_up(range.begin + k); !stood) return stood.fault();
    if (writer.has_frame(k)) {
      ++report.resumed;
    } else {
      const auto begun = std::chrono::steady_clock::now();
      const auto made = maker.compile(stop);
      if (!made) return stop.stop_requested() ? cancelled(job) : made.fault();
      const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - begun;
      report.slowest_frame_ms = std::max(report.slowest_frame_ms, took.count());
      if (Status added = sink.add(k, *made); !added) return added.fault();
    }
    measured.coverage.push_back(maker.coverage());
    progress(k + 1, report.frames);
  }
  if (Status drained = sink.drain(); !drained) return drained.fault();
  return measured;
}

}  // namespace

Result<CompileReport> compile_show(const Source& source, const CompileJob& job, const FrameProgress& progress,
                                   std::stop_token stop) {
  const auto range = range_of(source.project, job.frames);
  if (!range) return range.fault();
  FrameMaker maker(source, job.engine);
  const ScheduleResult schedule = make_schedule(source.project, maker.settings().images);
  ShowHeader header =
      make_show_header(source.project, source.text, source.loaded, schedule.schedule, maker.settings(), *range);
  // The two compilers may differ by a code somewhere: a show, and a part to resume, is wholly of one of them.
  if (job.engine.reference) header.compiler += " reference";
  auto writer = ShowWriter::start(job.show, header, job.resume, job.engine.threads);
  if (!writer) return writer.fault();

  CompileReport report;
  report.frames = header.frames;
  report.images = header.images.size();
  report.slots = schedule.schedule.slots.size();
  auto measured = write_frames(job, *range, maker, *writer, report, progress, stop);
  if (!measured) return measured.fault();
  measured->frames = writer->measures();
  for (const FrameMeasure& frame : measured->frames) {
    for (const Side side : both_sides) report.optimal[side] = report.optimal[side] + frame.optimal[side];
  }
  if (Status finished = writer->finish(stop); !finished) {
    return stop.stop_requested() ? cancelled(job) : finished.fault();
  }
  report.findings = findings_of(source, schedule, *measured);
  return report;
}

Result<std::vector<Finding>> check_project(const Source& source, const EngineChoice& engine,
                                           const FrameProgress& progress, std::stop_token stop) {
  const auto range = range_of(source.project, std::nullopt);
  if (!range) return range.fault();
  FrameMaker maker(source, engine);
  const ScheduleResult schedule = make_schedule(source.project, maker.settings().images);
  Measured measured;
  for (int k = 0; k < range->end; ++k) {
    if (stop.stop_requested()) return cancelled(source.project.name, "");
    if (Status stood = maker.stand_up(k); !stood) return stood.fault();
    auto made = maker.compile(stop);
    if (!made) return made.fault();
    measured.coverage.push_back(maker.coverage());
    measured.frames.push_back(std::move(made->measure));
    progress(k + 1, range->end);
  }
  return findings_of(source, schedule, measured);
}

Result<std::vector<Finding>> check_show(const Source& source, const ShowReader& show, const FrameProgress& progress,
                                        std::stop_token stop) {
  const ShowHeader& header = show.header();
  FrameMaker maker(source, {});
  const ScheduleResult schedule = make_schedule(source.project, maker.settings().images);
  Measured measured;
  measured.frames = show.measures();
  for (int k = 0; k < header.frames; ++k) {
    if (stop.stop_requested()) return cancelled(source.project.name, "");
    if (Status stood = maker.stand_up(header.first_frame + k); !stood) return stood.fault();
    measured.coverage.push_back(maker.coverage());
    progress(k + 1, header.frames);
  }
  return findings_of(source, schedule, measured);
}

}  // namespace focalstage
