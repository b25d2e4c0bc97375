#include "editor/cli/retina_sweep.h"

#include <filesystem>
#include <system_error>

#include "editor/cli/output.h"
#include "editor/cli/progress.h"
#include "editor/cli/retina_output.h"
#include "editor/cli/sweep_output.h"
#include "io/files/files.h"
#include "io/image/png.h"
#include "io/plot/plot.h"

namespace focalstage {
namespace {

constexpr int plot_width_px = 1000, plot_height_px = 560;

Status make_folder(const std::string& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (!error && std::filesystem::is_directory(folder, error)) return {};
  return Fault{"export.folder", folder, "the folder cannot be made (" + error.message() + ")",
               "choose another with -o"};
}

Result<FocalSweep> write_stack(const RetinaOptions& options, const SeenShow& seen, const RetinaView& view,
                               const FocusRange& range, const std::stop_token& stop) {
  const std::vector<RetinaInput> inputs = seen.inputs();
  Progress bar("Focusing through " + options.show, options.json ? Progress::Style::quiet : Progress::Style::automatic);
  Retinas retinas;
  return sweep_focus(
      retinas, inputs, view, seen.flux(), range,
      [&](int i, const RetinaImage& picture) {
        const std::filesystem::path file = std::filesystem::path(options.output) / sweep_picture_name(range, i);
        const int channels = channels_of(inputs, view, picture);
        Status written = write_png16(file, view.width_px, view.height_px, channels, levels_of(picture, channels));
        bar.update(i + 1, range.count, "picture");
        return written;
      },
      stop);
}

Status write_contrast(const std::filesystem::path& folder, const std::string& title, const FocalSweep& sweep) {
  if (Status done = write_file_atomically(folder / "contrast.csv", contrast_csv(sweep)); !done) return done;
  const auto plot = draw_plot(contrast_plot(title, sweep), plot_width_px, plot_height_px);
  if (!plot) return plot.fault();
  return write_png(folder / "contrast.png", plot->width_px, plot->height_px, 3, plot->rgb);
}

}  // namespace

Status check_sweep_folder(const std::string& folder) {
  std::error_code error;
  const auto status = std::filesystem::status(folder, error);
  if (!std::filesystem::exists(status) || std::filesystem::is_directory(status)) return {};
  return Fault{"retina.sweep", "-o " + folder, "this is a file, and a sweep is written into a folder",
               "name a folder, or a new one"};
}

ExitStatus run_sweep(const RetinaOptions& options, const SeenShow& seen, const RetinaView& view,
                     const FocusRange& range, Interrupt& interrupt) {
  if (Status made = make_folder(options.output); !made) return report(made.fault());
  const auto sweep = write_stack(options, seen, view, range, interrupt.token());
  if (!sweep) {
    const ExitStatus status = report(sweep.fault());
    interrupt.end_if_asked();
    return status;
  }
  const SweepRun what{options.show, options.output, options.frame, options.pupil_mm, range};
  if (Status done = write_contrast(options.output, sweep_title(what, view), *sweep); !done) return report(done.fault());
  if (options.json) {
    print_json(sweep_value(what, view, *sweep));
  } else {
    std::fputs(sweep_text(what, view, *sweep).c_str(), stdout);
  }
  return ExitStatus::done;
}

}  // namespace focalstage
