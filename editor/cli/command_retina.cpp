#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <memory>

#include "editor/cli/command_list.h"
#include "editor/cli/interrupt.h"
#include "editor/cli/output.h"
#include "editor/pipeline/seen_show.h"
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

void print_report(const Options& options, const RetinaView& view, const RetinaImage& image, std::size_t exposures) {
  double sum = 0.0, most = 0.0;
  for (const float light : image.rgb) {
    sum += light;
    most = std::max(most, double{light});
  }
  Value object;
  object.set("picture", options.picture);
  object.set("show", options.show);
  object.set("frame", options.frame);
  object.set("eye", options.eye);
  object.set("focus_m", options.focus_m);
  object.set("focus_d", view.focus_d);
  object.set("pupil_mm", options.pupil_mm);
  object.set("fov_deg", options.fov_deg);
  object.set("size_px", Value::Array{view.width_px, view.height_px});
  object.set("exposures", static_cast<double>(exposures));
  object.set("mean_light", sum / static_cast<double>(image.rgb.size()));
  object.set("most_light", most);
  print_json(object);
}

ExitStatus usage(const Fault& fault) {
  report(fault);
  return ExitStatus::usage;
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
  const auto seen = SeenShow::of(*show, options.show, options.frame, view->eye);
  if (!seen) return report(seen.fault());
  const RetinaInput input = seen->input();
  const auto image = Retina().view(input, *view, interrupt.token());
  if (!image) {
    const ExitStatus status = report(image.fault());
    interrupt.end_if_asked();
    return status;
  }
  const int channels = input.channels;
  const Status written =
      write_png16(options.picture, view->width_px, view->height_px, channels, levels_of(*image, channels));
  if (!written) return report(written.fault());
  if (options.json) {
    print_report(options, *view, *image, input.exposures.size());
  } else {
    std::printf("%s: the %s eye focused at %s m (%s D), %zu exposures\n", options.picture.c_str(), options.eye.c_str(),
                short_number(options.focus_m).c_str(), short_number(view->focus_d).c_str(), input.exposures.size());
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
  app.add_flag("--json", options->json, "print what was seen as one JSON object");
  return [options] { return run(*options); };
}

}  // namespace focalstage
