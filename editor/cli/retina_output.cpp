#include "editor/cli/retina_output.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/number_words.h"
#include "editor/cli/look_words.h"
#include "editor/cli/output.h"

namespace focalstage {
namespace {

Value thing_value(const RetinaReport& report, std::size_t i) {
  const SeenThing& thing = report.things.things[i];
  const ThingLook& look = report.looks[i];
  const ThingConflict& conflict = report.conflicts[i];
  Value value;
  value.set("name", thing.name);
  value.set("kind", kind_of(thing));
  value.set("pixels", look.pixels);
  value.set("sharpness", number_or_null(look.pixels > 0 ? look.sharpness : std::nan("")));
  value.set("light", look.light);
  value.set("luminance_cd_m2", report.looks[i].candela_per_m2 > 0.0 ? Value(look.candela_per_m2) : Value());
  value.set("blur_radius_arcmin", number_or_null(conflict.light > 0.0 ? look.blur_radius_arcmin : std::nan("")));
  const bool lit = conflict.light > 0.0;
  value.set("conflict_mean_d", number_or_null(lit ? conflict.mean_d : std::nan("")));
  value.set("conflict_worst_d", number_or_null(lit ? conflict.worst_d : std::nan("")));
  value.set("conflict_beyond_comfort", number_or_null(lit ? conflict.beyond_comfort : std::nan("")));
  return value;
}

/// Of all projectors.
std::size_t exposures_in(std::span<const RetinaInput> inputs) {
  std::size_t count = 0;
  for (const RetinaInput& input : inputs) count += input.exposures.size();
  return count;
}

std::string or_dash(bool known, double value, int decimals) { return known ? fixed_text(value, decimals) : "-"; }

}  // namespace

Value retina_value(const RetinaRun& run, const RetinaView& view, std::span<const RetinaInput> inputs,
                   const RetinaReport& report) {
  double sum = 0.0, most = 0.0;
  for (const float light : report.picture.rgb) {
    sum += light;
    most = std::max(most, double{light});
  }
  Value object;
  object.set("picture", run.picture);
  set_look(object, {run.show, run.frame, run.focus_m, run.pupil_mm}, view);
  object.set("exposures", static_cast<double>(exposures_in(inputs)));
  object.set("mean_light", sum / static_cast<double>(report.picture.rgb.size()));
  object.set("most_light", most);
  object.set("leaked", report.leaked);
  Value::Array things;
  for (std::size_t i = 0; i < report.things.things.size(); ++i) things.push_back(thing_value(report, i));
  object.set("things", std::move(things));
  return object;
}

std::string retina_text(const RetinaRun& run, const RetinaView& view, std::span<const RetinaInput> inputs,
                        const RetinaReport& report) {
  std::string text = run.picture + ": the " + eye_word(view.eye) + " eye focused at " + short_text(run.focus_m) +
                     " m (" + short_text(view.focus_d) + " D), " + std::to_string(exposures_in(inputs)) +
                     " exposures\n";
  if (report.leaked > 0.0) {
    text += fixed_text(100.0 * report.leaked, 1) +
            " % of the light was meant for the other eye: a shutter moves while it is shown\n";
  }
  std::vector<std::vector<std::string>> rows;
  for (std::size_t i = 0; i < report.things.things.size(); ++i) {
    const SeenThing& thing = report.things.things[i];
    const ThingLook& look = report.looks[i];
    const ThingConflict& conflict = report.conflicts[i];
    const bool seen = look.pixels > 0, lit = conflict.light > 0.0;
    rows.push_back({thing.name, kind_of(thing), std::to_string(look.pixels),
                    or_dash(seen && std::isfinite(look.sharpness), look.sharpness, 2),
                    or_dash(lit, look.blur_radius_arcmin, 1), or_dash(seen, look.light, 3),
                    or_dash(look.candela_per_m2 > 0.0, look.candela_per_m2, 1), or_dash(lit, conflict.mean_d, 2)});
  }
  if (rows.empty()) return text + "Nothing stands on this stage.\n";
  return text + table_text({{"thing"},
                            {"kind"},
                            {"pixels", true},
                            {"sharpness", true},
                            {"blur/arcmin", true},
                            {"light", true},
                            {"cd/m2", true},
                            {"conflict/D", true}},
                           rows);
}

int channels_of(std::span<const RetinaInput> inputs, const RetinaView& view, const RetinaImage& image) {
  const auto is_coloured = [](const RetinaInput& input) { return input.channels == 3; };
  if (view.chromatic || std::any_of(inputs.begin(), inputs.end(), is_coloured)) return 3;
  for (std::size_t i = 0; i + 2 < image.rgb.size(); i += 3) {
    if (image.rgb[i] != image.rgb[i + 1] || image.rgb[i] != image.rgb[i + 2]) return 3;
  }
  return 1;
}

std::vector<std::uint16_t> levels_of(const RetinaImage& image, int channels) {
  std::vector<std::uint16_t> levels;
  for (std::size_t i = 0; i < image.rgb.size(); i += channels == 3 ? 1 : 3) {
    levels.push_back(static_cast<std::uint16_t>(std::lround(65535.0f * std::clamp(image.rgb[i], 0.0f, 1.0f))));
  }
  return levels;
}

std::vector<std::uint8_t> conflict_colours(const std::vector<float>& conflict_d) {
  std::vector<std::uint8_t> rgb(3 * conflict_d.size(), 0);
  for (std::size_t i = 0; i < conflict_d.size(); ++i) {
    if (std::isnan(conflict_d[i])) continue;
    const std::array<std::uint8_t, 3> colour = conflict_colour(conflict_d[i]);
    std::copy(colour.begin(), colour.end(), rgb.begin() + static_cast<std::ptrdiff_t>(3 * i));
  }
  return rgb;
}

}  // namespace focalstage
