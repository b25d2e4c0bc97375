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
#include "editor/pipeline/measure_frames.h"
#include "editor/pipeline/measure_needs.h"
#include "io/show/writer.h"

namespace focalstage {
namespace {

Fault cancelled(const CompileJob& job) {
  return {"compile.cancelled", job.show.string(), "stopped before the end",
          "the finished frames are kept; --resume goes on from them"};
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

/// What all frames need is measured only where a remedy may come of it.
Result<std::vector<Finding>> findings_of(const Source& source, const std::vector<ScheduleResult>& schedules,
                                         Measured measured, FrameRange frames, const std::stop_token& stop) {
  std::vector<Finding> findings = check(source.project, schedules, measured, source.models);
  if (needs_would_help(findings)) {
    auto needs = measure_needs(
        source.project, source.loaded.assets, frames, [](int, int) {}, stop);
    if (!needs) return needs.fault();
    measured.needs = *std::move(needs);
    findings = check(source.project, schedules, measured, source.models);
  }
  findings.insert(findings.end(), source.notes.begin(), source.notes.end());
  return findings;
}

Result<CheckReport> checked(const Source& source, const std::vector<ScheduleResult>& schedules, Measured measured,
                            FrameRange frames, const std::stop_token& stop) {
  CheckReport report;
  report.conflicts = measured.conflicts;
  report.contrasts = contrasts_of(source.project, schedules.at(0).schedule, measured.lit);
  auto findings = findings_of(source, schedules, std::move(measured), frames, stop);
  if (!findings) return findings.fault();
  report.findings = *std::move(findings);
  return report;
}

/// Where finished frames go: to a thread of its own, or, with one thread to use, straight to the file.
class FrameSink {
 public:
  FrameSink(ShowWriter& writer, int threads)
      : writer_(writer), queue_(threads == 1 ? nullptr : std::make_unique<FrameQueue>(writer)) {}

  Status add(int frame, const FrameMaker::Made& made, std::size_t projector) {
    return queue_ ? queue_->add(frame, made.images, made.measure, projector)
                  : writer_.add_frame(frame, *made.images, made.measure, projector);
  }
  Status drain() { return queue_ ? queue_->drain() : Status{}; }

 private:
  ShowWriter& writer_;
  std::unique_ptr<FrameQueue> queue_;
};

/// What the projectors show in frame `k`, as far as the writer has not got it.
Status write_frame(const CompileJob& job, int k, FrameMaker& maker, ShowWriter& writer, FrameSink& sink,
                   CompileReport& report, const std::stop_token& stop) {
  const auto begun = std::chrono::steady_clock::now();
  for (std::size_t i = 0; i < maker.projectors(); ++i) {
    if (writer.has_frame(k, i)) continue;
    const auto made = maker.compile(stop, i);
    if (!made) return stop.stop_requested() ? cancelled(job) : made.fault();
    if (i + 1 == maker.projectors()) {
      const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - begun;
      report.slowest_frame_ms = std::max(report.slowest_frame_ms, took.count());
    }
    if (Status added = sink.add(k, *made, i); !added) return added;
  }
  return {};
}

/// Frame after frame to the writer; what was measured apart from compiling comes back.
Result<Measured> write_frames(const CompileJob& job, FrameRange range, FrameMaker& maker, ShowWriter& writer,
                              CompileReport& report, const FrameProgress& progress, const std::stop_token& stop) {
  Measured measured;
  FrameSink sink(writer, job.engine.threads);
  for (int k = 0; k < report.frames; ++k) {
    if (stop.stop_requested()) return cancelled(job);
    if (Status stood = maker.stand_up(range.begin + k); !stood) return stood.fault();
    if (k == 0) {
      measured.meshes = mesh_states(maker.project(), maker.staged());
      measured.lit = surfaces_in_light(maker.project(), maker.staged());
    }
    if (writer.has_frame(k)) {
      ++report.resumed;
    } else {
      if (Status written = write_frame(job, k, maker, writer, sink, report, stop); !written) return written.fault();
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
  FrameMaker maker(source.project, source.loaded.assets, job.engine);
  const std::vector<ScheduleResult> schedules = schedules_of(maker);
  ShowHeader header =
      make_show_header(source.project, source.text, source.loaded, schedules[0].schedule, maker.settings(), *range);
  for (std::size_t i = 1; i < maker.projectors(); ++i)
    header.others.push_back(show_projector(source.project, i, maker.settings(i), schedules[i].schedule));
  // The two compilers may differ by a code somewhere: a show, and a part to resume, is wholly of one of them.
  if (job.engine.reference) header.compiler += " reference";
  auto writer = ShowWriter::start(job.show, header, job.resume, job.engine.threads);
  if (!writer) return writer.fault();

  CompileReport report;
  report.frames = header.frames;
  report.projectors = header.projectors();
  for (std::size_t i = 0; i < header.projectors(); ++i) {
    report.images += header.projector(i).images.size();
    report.slots += header.projector(i).slots.size();
  }
  auto measured = write_frames(job, *range, maker, *writer, report, progress, stop);
  if (!measured) return measured.fault();
  measured->frames = writer->measures();
  for (std::size_t i = 1; i < header.projectors(); ++i) measured->others.push_back(writer->measures(i));
  for (std::size_t i = 0; i < header.projectors(); ++i) {
    for (const FrameMeasure& frame : writer->measures(i)) {
      for (const Side side : both_sides) report.optimal[side] = report.optimal[side] + frame.optimal[side];
    }
  }
  if (Status finished = writer->finish(stop); !finished) {
    return stop.stop_requested() ? cancelled(job) : finished.fault();
  }
  auto findings = findings_of(source, schedules, *std::move(measured), *range, stop);
  if (!findings) return findings.fault();
  report.findings = *std::move(findings);
  return report;
}

Result<CheckReport> check_project(const Source& source, const EngineChoice& engine, const FrameProgress& progress,
                                  std::stop_token stop) {
  const auto range = range_of(source.project, std::nullopt);
  if (!range) return range.fault();
  FrameMaker maker(source.project, source.loaded.assets, engine);
  const std::vector<ScheduleResult> schedules = schedules_of(maker);
  auto measured = measure_frames(maker, {*range, plain(schedules)}, progress, stop);
  if (!measured) return measured.fault();
  return checked(source, schedules, *std::move(measured), *range, stop);
}

Result<CheckReport> check_show(const Source& source, const ShowReader& show, const FrameProgress& progress,
                               std::stop_token stop) {
  const ShowHeader& header = show.header();
  FrameMaker maker(source.project, source.loaded.assets, {});
  const std::vector<ScheduleResult> schedules = schedules_of(maker);
  const FrameRange frames{header.first_frame, header.first_frame + header.frames};
  std::vector<Schedule> shown(header.projectors(), header.schedule);
  for (std::size_t i = 1; i < shown.size(); ++i) shown[i].slots = header.projector(i).slots;
  auto measured = measure_frames(maker, {frames, std::move(shown), &show}, progress, stop);
  if (!measured) return measured.fault();
  return checked(source, schedules, *std::move(measured), frames, stop);
}

}  // namespace focalstage
