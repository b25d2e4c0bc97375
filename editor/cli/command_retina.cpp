#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <memory>

#include "core/reference/seen.h"
#include "editor/cli/command_list.h"
#include "editor/cli/interrupt.h"
#include "editor/cli/output.h"
#include "editor/cli/retina_output.h"
#include "editor/pipeline/retina_report.h"
#include "editor/pipeline/seen_show.h"
#include "editor/pipeline/source.h"
#include "io/image/png.h"

namespace focalstage {
namespace {

struct Options {
  std::string show;
  std::string picture;
  std::string eye;
  std::string size = "800x600";
  double focus_m = 0.5;
  double pupil_mm = 4.0;
  double fov_deg = 50.0;
  int frame = 0;
  std::string conflict;
  int rays = 0;
  double shutter_open_ms = -1.0;
  double shutter_close_ms = -1.0;
  bool diffraction = false;
  bool chromatic = false;
  bool json = false;
};

/// "WxH" into the view's size.
Status read_size(const std::string& text, RetinaView& view) {
  const char* const end = text.data() + text.size();
  const auto [cross, first_problem] = std::from_chars(text.data(), end, view.width_px);
  if (first_problem == std::errc{} && cross != end && *cross == 'x') {
    const auto [rest, end_problem] = std::from_chars(cross + 1, end, view.height_px);
    const bool in_range =
        std::min(view.width_px, view.height_px) >= 1 && std::max(view.width_px, view.height_px) <= 4096;
    if (end_problem == std::errc{} && rest == end && in_range) return {};
  }
  return Fault{"retina.size", "--size " + text, "this is no size", "write WxH with 1 to 4096 pixels, such as 800x600"};
}

Result<RetinaView> view_of(const Options& options) {
  for (const double number : {options.focus_m, options.pupil_mm, options.fov_deg}) {  // NaN is in every CLI::Range
    if (std::isnan(number)) return Fault{"retina.number", "--focus-m, --pupil-mm, --fov-deg", "nan is no number", ""};
  }
  RetinaView view;
  view.eye = options.eye == "left" ? Side::left : Side::right;
  view.focus_d = 1.0 / options.focus_m;
  view.pupil_m = options.pupil_mm / 1000.0;
  view.fov_deg = options.fov_deg;
  view.diffraction = options.diffraction;
  view.chromatic = options.chromatic;
  if (const Status size = read_size(options.size, view); !size) return size.fault();
  return view;
}

/// Linear light, 65535 = full code; one channel of a gray show.
std::vector<std::uint16_t> levels_of(const RetinaImage& image, int channels) {
  std::vector<std::uint16_t> levels;
  for (std::size_t i = 0; i < image.rgb.size(); i += channels == 3 ? 1 : 3) {
    levels.push_back(static_cast<std::uint16_t>(std::lround(65535.0f * std::clamp(image.rgb[i], 0.0f, 1.0f))));
  }
  return levels;
}

/// The show's glasses, or slower or faster ones where the options say so.
Result<std::optional<WornGlasses>> worn(const Options& options, const ShowReader& show) {
  if (options.shutter_open_ms < 0.0 && options.shutter_close_ms < 0.0) return std::optional<WornGlasses>();
  const auto source = project_in(show, options.show);
  if (!source) return source.fault();
  WornGlasses glasses = worn_glasses(source->project.glasses);
  if (options.shutter_open_ms >= 0.0) glasses.shutter.open_s = options.shutter_open_ms / 1000.0;
  if (options.shutter_close_ms >= 0.0) glasses.shutter.close_s = options.shutter_close_ms / 1000.0;
  return std::optional<WornGlasses>(glasses);
}

ExitStatus usage(const Fault& fault) {
  report(fault);
  return ExitStatus::usage;
}

Status write_pictures(const Options& options, const RetinaInput& input, const RetinaView& view,
                      const RetinaReport& made) {
  const int channels = view.chromatic ? 3 : input.channels;
  Status written =
      write_png16(options.picture, view.width_px, view.height_px, channels, levels_of(made.picture, channels));
  if (!written || options.conflict.empty()) return written;
  return write_png(options.conflict, view.width_px, view.height_px, 3, conflict_colours(made.conflict_d));
}

ExitStatus run(const Options& options) {
  const auto view = view_of(options);
  if (!view) return usage(view.fault());
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
  const RetinaInput input = seen->input();
  Retina retina;
  auto made = report_on(retina, input, *view, seen->flux(), interrupt.token());
  if (made && options.rays > 0) {
    auto exact = see_by_rays(input, *view, {options.rays}, interrupt.token());
    if (!exact)
      made = exact.fault();
    else
      made->picture = *std::move(exact);
  }
  if (!made) {
    const ExitStatus status = report(made.fault());
    interrupt.end_if_asked();
    return status;
  }
  if (Status written = write_pictures(options, input, *view, *made); !written) return report(written.fault());
  const RetinaRun what{options.show, options.picture, options.frame, options.focus_m, options.pupil_mm};
  if (options.json) {
    print_json(retina_value(what, *view, input, *made));
  } else {
    std::fputs(retina_text(what, *view, input, *made).c_str(), stdout);
  }
  return ExitStatus::done;
}

}  // namespace

Command::Run declare_retina(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  app.add_option("SHOW", options->show, "the show (.h5)")->required()->type_name("");
  app.add_option("--eye", options->eye, "left or right")
      ->required()
      ->type_name("EYE")
      ->check(CLI::IsMember({"left", "right"}).name(""));
  app.add_option("--focus-m", options->focus_m, "where the eye focuses, in metres from the lens centre")
      ->required()
      ->type_name("M")
      ->check(CLI::Range(0.01, 1e6).name(""));
  app.add_option("--pupil-mm", options->pupil_mm, "diameter of the pupil; 4 by default")
      ->type_name("P")
      ->check(CLI::Range(0.0, 20.0).name(""));
  app.add_option("--size", options->size, "of the picture in pixels; 800x600 by default")->type_name("WxH");
  app.add_option("--fov-deg", options->fov_deg, "horizontal field of view; 50 by default")
      ->type_name("F")
      ->check(CLI::Range(0.1, 160.0).name(""));
  app.add_option("--frame", options->frame, "of the show, from 0; the first by default")
      ->type_name("K")
      ->check(CLI::NonNegativeNumber.name(""));
  app.add_option("-o,--output", options->picture, "the picture to write: 16-bit PNG in linear light")
      ->required()
      ->type_name("PNG");
  app.add_option("--conflict", options->conflict,
                 "also write where vergence and accommodation part: green within 0.5 D, red beyond, blue the other way")
      ->type_name("PNG");
  app.add_option("--rays", options->rays,
                 "follow so many rays per pixel and exposure instead of the fast way: slow, exact")
      ->type_name("N")
      ->check(CLI::Range(1, 65536).name(""));
  app.add_option("--shutter-open-ms", options->shutter_open_ms, "glasses that open slower or faster than the show's")
      ->type_name("MS")
      ->check(CLI::Range(0.0, 1000.0).name(""));
  app.add_option("--shutter-close-ms", options->shutter_close_ms, "glasses that close slower or faster than the show's")
      ->type_name("MS")
      ->check(CLI::Range(0.0, 1000.0).name(""));
  app.add_flag("--diffraction", options->diffraction, "blur by the pupil's edge");
  app.add_flag("--chromatic", options->chromatic, "the eye's own colour error: red, green and blue focus apart");
  app.add_flag("--json", options->json, "print what was seen as one JSON object");
  return [options] { return run(*options); };
}

}  // namespace focalstage
