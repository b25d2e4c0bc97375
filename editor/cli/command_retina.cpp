#include <CLI/CLI.hpp>
#include <algorithm>

#include "core/reference/seen.h"
#include "editor/cli/command_list.h"
#include "editor/cli/interrupt.h"
#include "editor/cli/output.h"
#include "editor/cli/retina_options.h"
#include "editor/cli/retina_output.h"
#include "editor/cli/retina_sweep.h"
#include "editor/pipeline/retina_report.h"
#include "editor/pipeline/seen_show.h"
#include "io/image/png.h"

namespace focalstage {
namespace {

ExitStatus usage(const Fault& fault) {
  report(fault);
  return ExitStatus::usage;
}

Status write_pictures(const RetinaOptions& options, std::span<const RetinaInput> inputs, const RetinaView& view,
                      const RetinaReport& made) {
  const int channels = channels_of(inputs, view, made.picture);
  Status written =
      write_png16(options.output, view.width_px, view.height_px, channels, levels_of(made.picture, channels));
  if (!written || options.conflict.empty()) return written;
  return write_png(options.conflict, view.width_px, view.height_px, 3, conflict_colours(made.conflict_d));
}

/// One look, by the fast way or by rays.
Result<RetinaReport> look(const RetinaOptions& options, const SeenShow& seen, const RetinaView& view,
                          const std::stop_token& stop) {
  Retinas retinas;
  const std::vector<RetinaInput> inputs = seen.inputs();
  auto made = report_on(retinas, inputs, view, seen.flux(), stop);
  if (!made || options.rays == 0) return made;
  std::fill(made->picture.rgb.begin(), made->picture.rgb.end(), 0.0f);
  for (const RetinaInput& input : inputs) {
    const auto exact = see_by_rays(input, view, {options.rays}, stop);
    if (!exact) return exact.fault();
    add_light(*exact, made->picture);
  }
  return made;
}

ExitStatus run_look(const RetinaOptions& options, const SeenShow& seen, const RetinaView& view, Interrupt& interrupt) {
  const auto made = look(options, seen, view, interrupt.token());
  if (!made) {
    const ExitStatus status = report(made.fault());
    interrupt.end_if_asked();
    return status;
  }
  const std::vector<RetinaInput> inputs = seen.inputs();
  if (Status written = write_pictures(options, inputs, view, *made); !written) return report(written.fault());
  const RetinaRun what{options.show, options.output, options.frame, *options.focus_m, options.pupil_mm};
  if (options.json) {
    print_json(retina_value(what, view, inputs, *made));
  } else {
    std::fputs(retina_text(what, view, inputs, *made).c_str(), stdout);
  }
  return ExitStatus::done;
}

ExitStatus run(const RetinaOptions& options) {
  const auto view = view_of(options);
  if (!view) return usage(view.fault());
  std::optional<FocusRange> sweep;
  if (!options.sweep.empty()) {
    const auto range = focus_range_of(options.sweep);
    if (!range) return usage(range.fault());
    if (Status folder = check_sweep_folder(options.output); !folder) return usage(folder.fault());
    sweep = *range;
  }
  Interrupt interrupt;
  const auto show = ShowReader::open(options.show);
  if (!show) return report(show.fault());
  const int frames = show->header().frames;
  if (options.frame >= frames) {
    return usage({"frames.range", "--frame " + std::to_string(options.frame), "the show has no such frame",
                  "name one of 0 to " + std::to_string(frames - 1)});
  }
  const auto glasses = worn(options, *show);
  if (!glasses) return report(glasses.fault());
  const auto seen = SeenShow::of(*show, options.show, options.frame, view->eye, *glasses);
  if (!seen) return report(seen.fault());
  return sweep ? run_sweep(options, *seen, *view, *sweep, interrupt) : run_look(options, *seen, *view, interrupt);
}

}  // namespace

Command::Run declare_retina(CLI::App& app) {
  return [options = declare_retina_options(app)] { return run(*options); };
}

}  // namespace focalstage
