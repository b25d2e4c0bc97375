#include "editor/cli/retina_options.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cmath>

#include "editor/pipeline/source.h"

namespace focalstage {
namespace {

constexpr double most_focus_d = 100.0;
constexpr int most_foci = 1000;

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

/// A number up to `end_sign` (0: up to the end), and what follows it.
template <class Number>
bool read_number(std::string_view& text, char end_sign, Number& number) {
  const auto [rest, problem] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (problem != std::errc{}) return false;
  text.remove_prefix(static_cast<std::size_t>(rest - text.data()));
  if (end_sign == 0) return text.empty();
  if (text.empty() || text.front() != end_sign) return false;
  text.remove_prefix(1);
  return true;
}

void declare_look(CLI::App& app, RetinaOptions& options) {
  app.add_option("--eye", options.eye, "left or right")
      ->required()
      ->type_name("EYE")
      ->check(CLI::IsMember({"left", "right"}).name(""));
  auto* const focus =
      app.add_option("--focus-m", options.focus_m, "where the eye focuses, in metres from the lens centre")
          ->type_name("M")
          ->check(CLI::Range(0.01, 1e6).name(""));
  auto* const sweep = app.add_option("--sweep", options.sweep,
                                     "instead a focal stack: COUNT foci in dioptres at the lens, such as 0.5:3.5:31; "
                                     "writes them, contrast.csv and contrast.png into the folder -o")
                          ->type_name("FROM:TO:COUNT")
                          ->excludes(focus);
  app.add_option("--pupil-mm", options.pupil_mm, "diameter of the pupil; 4 by default")
      ->type_name("P")
      ->check(CLI::Range(0.0, 20.0).name(""));
  app.add_option("--size", options.size, "of the picture in pixels; 800x600 by default")->type_name("WxH");
  app.add_option("--fov-deg", options.fov_deg, "horizontal field of view; 50 by default")
      ->type_name("F")
      ->check(CLI::Range(0.1, 160.0).name(""));
  app.add_option("--frame", options.frame, "of the show, from 0; the first by default")
      ->type_name("K")
      ->check(CLI::NonNegativeNumber.name(""));
  app.add_option("-o,--output", options.output, "the picture to write, 16-bit PNG in linear light; a sweep's folder")
      ->required()
      ->type_name("PNG|DIR");
  app.add_option("--conflict", options.conflict,
                 "also write where vergence and accommodation part: green within 0.5 D, red beyond, blue the other way")
      ->type_name("PNG")
      ->excludes(sweep);
  app.add_option("--rays", options.rays,
                 "follow so many rays per pixel and exposure instead of the fast way: slow, exact")
      ->type_name("N")
      ->check(CLI::Range(1, 65536).name(""))
      ->excludes(sweep);
}

}  // namespace

std::shared_ptr<RetinaOptions> declare_retina_options(CLI::App& app) {
  const auto options = std::make_shared<RetinaOptions>();
  app.add_option("SHOW", options->show, "the show (.h5)")->required()->type_name("");
  declare_look(app, *options);
  app.add_option("--shutter-open-ms", options->shutter_open_ms, "glasses that open slower or faster than the show's")
      ->type_name("MS")
      ->check(CLI::Range(0.0, 1000.0).name(""));
  app.add_option("--shutter-close-ms", options->shutter_close_ms, "glasses that close slower or faster than the show's")
      ->type_name("MS")
      ->check(CLI::Range(0.0, 1000.0).name(""));
  app.add_flag("--diffraction", options->diffraction, "blur by the pupil's edge");
  app.add_flag("--chromatic", options->chromatic, "the eye's own colour error: red, green and blue focus apart");
  app.add_flag("--json", options->json, "print what was seen as one JSON object");
  return options;
}

Result<RetinaView> view_of(const RetinaOptions& options) {
  const double focus_m = options.focus_m.value_or(0.5);
  for (const double number : {focus_m, options.pupil_mm, options.fov_deg}) {  // NaN is in every CLI::Range
    if (std::isnan(number)) return Fault{"retina.number", "--focus-m, --pupil-mm, --fov-deg", "nan is no number", ""};
  }
  if (!options.focus_m && options.sweep.empty()) {
    return Fault{"retina.focus", "--focus-m", "it is not said where the eye focuses",
                 "name a distance with --focus-m M, or a range with --sweep FROM:TO:COUNT"};
  }
  RetinaView view;
  view.eye = options.eye == "left" ? Side::left : Side::right;
  view.focus_d = 1.0 / focus_m;
  view.pupil_m = options.pupil_mm / 1000.0;
  view.fov_deg = options.fov_deg;
  view.diffraction = options.diffraction;
  view.chromatic = options.chromatic;
  if (const Status size = read_size(options.size, view); !size) return size.fault();
  return view;
}

Result<FocusRange> focus_range_of(const std::string& text) {
  const auto no = [&](std::string message) {
    return Fault{"retina.sweep", "--sweep " + text, std::move(message),
                 "write FROM:TO:COUNT in dioptres, such as 0.5:3.5:31"};
  };
  FocusRange range;
  std::string_view rest = text;
  if (!read_number(rest, ':', range.from_d) || !read_number(rest, ':', range.to_d) ||
      !read_number(rest, 0, range.count))
    return no("this is no range");
  if (!(range.from_d >= 0.0) || !(range.to_d <= most_focus_d))
    return no("the eye focuses from 0 D (infinity) to 100 D");
  if (!(range.from_d < range.to_d)) return no("the first focus is not below the last");
  if (range.count < 2 || range.count > most_foci) return no("a sweep has 2 to 1000 foci");
  return range;
}

Result<std::optional<WornGlasses>> worn(const RetinaOptions& options, const ShowReader& show) {
  if (options.shutter_open_ms < 0.0 && options.shutter_close_ms < 0.0) return std::optional<WornGlasses>();
  const auto source = project_in(show, options.show);
  if (!source) return source.fault();
  WornGlasses glasses = worn_glasses(source->project.glasses);
  if (options.shutter_open_ms >= 0.0) glasses.shutter.open_s = options.shutter_open_ms / 1000.0;
  if (options.shutter_close_ms >= 0.0) glasses.shutter.close_s = options.shutter_close_ms / 1000.0;
  return std::optional<WornGlasses>(glasses);
}

}  // namespace focalstage
