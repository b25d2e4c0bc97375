#include <CLI/CLI.hpp>
#include <charconv>
#include <memory>

#include "editor/cli/command_list.h"
#include "editor/cli/interrupt.h"
#include "editor/cli/output.h"
#include "editor/cli/progress.h"
#include "editor/pipeline/compile_show.h"

namespace focalstage {
namespace {

struct Options {
  std::string project;
  std::string show;
  std::string frames;
  std::string vectors = "best";
  int threads = 0;
  bool resume = false;
  bool reference = false;
  bool json = false;
};

/// "A:B", half-open. An empty text is no range.
Result<std::optional<FrameRange>> parse_range(const std::string& text) {
  if (text.empty()) return std::optional<FrameRange>{};
  FrameRange range;
  const char* const end = text.data() + text.size();
  const auto [colon, first_problem] = std::from_chars(text.data(), end, range.begin);
  if (first_problem == std::errc{} && colon != end && *colon == ':') {
    const auto [rest, end_problem] = std::from_chars(colon + 1, end, range.end);
    if (end_problem == std::errc{} && rest == end) return std::optional<FrameRange>{range};
  }
  return Fault{"frames.range", "--frames " + text, "this is no range", "write A:B, frames A to B-1, such as 0:60"};
}

void print_summary(const Options& options, const CompileReport& report, bool optimal, double seconds) {
  const std::string by = report.projectors > 1 ? ", " + std::to_string(report.projectors) + " projectors" : "";
  std::printf("%s: %d %s of %zu images, %zu exposures a period%s, compiled in %s", options.show.c_str(), report.frames,
              report.frames == 1 ? "frame" : "frames", report.images, report.slots, by.c_str(),
              duration_text(seconds).c_str());
  if (report.resumed > 0) std::printf(" (%d taken over)", report.resumed);
  if (optimal) {
    const OptimalMeasure both = report.optimal.left + report.optimal.right;
    std::printf("\noptimal: %llu of %llu tiles near depth edges better by %.2f dB than linear",
                static_cast<unsigned long long>(both.accepted_tiles), static_cast<unsigned long long>(both.tiles),
                gain_db(both));
  }
  std::printf("\n%s", findings_text(report.findings).c_str());
}

Value optimal_value(const OptimalMeasure& measure) {
  Value object;
  object.set("tiles", static_cast<double>(measure.tiles));
  object.set("accepted_tiles", static_cast<double>(measure.accepted_tiles));
  object.set("left_tiles", static_cast<double>(measure.left_tiles));
  object.set("linear_psnr_db", psnr_db(measure, measure.linear_error));
  object.set("gain_db", gain_db(measure));
  return object;
}

void print_report(const Options& options, const CompileReport& report, bool optimal) {
  Value object = findings_value(report.findings);
  object.set("show", options.show);
  object.set("frames", report.frames);
  object.set("resumed", report.resumed);
  if (report.projectors > 1) object.set("projectors", static_cast<double>(report.projectors));
  object.set("images", static_cast<double>(report.images));
  object.set("slots", static_cast<double>(report.slots));
  object.set("slowest_frame_ms", report.slowest_frame_ms);
  if (optimal) {
    Value eyes;
    eyes.set("left", optimal_value(report.optimal.left));
    eyes.set("right", optimal_value(report.optimal.right));
    object.set("optimal", eyes);
  }
  print_json(object);
}

Result<CompileReport> compile_with_progress(const Options& options, const Source& source, const CompileJob& job,
                                            std::stop_token stop) {
  Progress bar("Compiling " + source.project.name, options.json ? Progress::Style::quiet : Progress::Style::automatic);
  return compile_show(
      source, job, [&](int done, int of) { bar.update(done, of, "frame"); }, stop);
}

ExitStatus run(const Options& options) {
  const auto started = std::chrono::steady_clock::now();
  const auto frames = parse_range(options.frames);
  if (!frames) {
    report(frames.fault());
    return ExitStatus::usage;
  }
  Interrupt interrupt;
  const auto source = open_project(options.project);
  if (!source) return report(source.fault());
  CompileJob job;
  job.show = options.show;
  job.frames = *frames;
  job.resume = options.resume;
  job.engine.threads = options.threads;
  job.engine.reference = options.reference;
  job.engine.vectors = options.vectors == "portable" ? VectorPath::portable : VectorPath::best;
  const auto compiled = compile_with_progress(options, *source, job, interrupt.token());
  if (!compiled) {
    const ExitStatus status = report(compiled.fault());
    interrupt.end_if_asked();
    return compiled.fault().code == "frames.range" ? ExitStatus::usage : status;
  }
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  const bool optimal = source->project.slices.assignment == Assignment::optimal;
  options.json ? print_report(options, *compiled, optimal) : print_summary(options, *compiled, optimal, seconds);
  return status_of(compiled->findings);
}

}  // namespace

Command::Run declare_compile(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  app.add_option("PROJECT", options->project, "a NAME.focal, or the folder that holds it")->required()->type_name("");
  app.add_option("-o,--output", options->show, "the show to write, such as show.h5")->required()->type_name("SHOW");
  app.add_option("--frames", options->frames, "frames A to B-1 alone")->type_name("A:B");
  app.add_option("--threads", options->threads, "how many threads to use; all by default")
      ->type_name("N")
      ->check(CLI::Range(1, 1024).name(""));
  app.add_option("--vectors", options->vectors, "best or portable instructions; the bytes are the same")
      ->type_name("WHICH")
      ->check(CLI::IsMember({"best", "portable"}).name(""));
  app.add_flag("--resume", options->resume, "go on where an interrupted compile of the same show stopped");
  app.add_flag("--reference", options->reference, "compile by one ray per sample: slow, to compare with");
  app.add_flag("--json", options->json, "print findings and counts as one JSON object");
  return [options] { return run(*options); };
}

}  // namespace focalstage
