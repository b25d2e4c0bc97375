#include "editor/cli/sweep_output.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>

#include "core/base/number_words.h"
#include "editor/cli/look_words.h"
#include "editor/cli/output.h"

namespace focalstage {
namespace {

/// The shortest text that reads back to the same number; none for what is no number.
std::string exact_text(double value) {
  if (!std::isfinite(value)) return "";
  std::array<char, 64> text;
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}

/// As a field of a CSV: quoted where it holds what separates fields.
std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char sign : text) quoted += sign == '"' ? std::string("\"\"") : std::string(1, sign);
  return quoted + "\"";
}

double sharpness_of(const ThingLook& look) { return look.pixels > 0 ? look.sharpness : std::nan(""); }

Value curve(const FocalSweep& sweep, std::size_t thing, double (*number)(const ThingLook&)) {
  Value::Array values;
  for (const std::vector<ThingLook>& looks : sweep.looks) values.push_back(number_or_null(number(looks[thing])));
  return values;
}

Value thing_value(const FocalSweep& sweep, std::size_t i) {
  Value value;
  value.set("name", sweep.things[i].name);
  value.set("kind", kind_of(sweep.things[i]));
  value.set("pixels", sweep.looks.front()[i].pixels);
  const std::optional<FocusPeak>& peak = sweep.peaks[i];
  value.set("peak_focus_d", peak ? Value(peak->focus_d) : Value());
  value.set("peak_focus_m", peak ? number_or_null(1.0 / peak->focus_d) : Value());
  value.set("peak_sharpness", peak ? Value(peak->sharpness) : Value());
  value.set("peak_inside", peak && peak->inside);
  value.set("sharpness", curve(sweep, i, sharpness_of));
  value.set("light", curve(sweep, i, [](const ThingLook& look) { return look.light; }));
  value.set("blur_radius_arcmin", curve(sweep, i, [](const ThingLook& look) { return look.blur_radius_arcmin; }));
  return value;
}

/// Round distances, the roundest first: each is shown if no other stands too near.
std::vector<PlotTick> metre_ticks(double from_d, double to_d) {
  constexpr std::array round_m{1.0, 0.5, 2.0, 0.25, 0.2,  0.1, 0.333, 0.05, 0.02, 0.01, 0.3,  0.4,
                               4.0, 0.7, 1.5, 3.0,  0.15, 5.0, 10.0,  0.6,  0.8,  0.12, 0.35, 0.45};
  const double apart_d = 0.07 * (to_d - from_d);
  std::vector<PlotTick> ticks;
  if (from_d == 0.0) ticks.push_back({0.0, "\u221e"});
  for (const double distance_m : round_m) {
    const double at_d = 1.0 / distance_m;
    bool free = at_d >= from_d && at_d <= to_d;
    for (const PlotTick& tick : ticks) free = free && std::abs(tick.at - at_d) >= apart_d;
    if (free) ticks.push_back({at_d, short_text(distance_m)});
  }
  if (ticks.size() >= 3) return ticks;
  ticks = round_ticks(from_d, to_d, 5);  // a narrow range: no round distances
  for (PlotTick& tick : ticks) tick.text = tick.at > 0.0 ? fixed_text(1.0 / tick.at, 4) : "\u221e";
  return ticks;
}

std::string who(const SweepRun& run, const RetinaView& view) {
  return "the " + eye_word(view.eye) + " eye, pupil " + short_text(run.pupil_mm) + " mm, frame " +
         std::to_string(run.frame);
}

}  // namespace

std::string sweep_picture_name(const FocusRange& range, int i) {
  char name[64];
  std::snprintf(name, sizeof name, "focus-%03d-%.4fD.png", i, range.at(i));
  return name;
}

std::string contrast_csv(const FocalSweep& sweep) {
  std::string csv = "focus_d,focus_m";
  for (const SeenThing& thing : sweep.things) {
    for (const char* what : {".sharpness", ".light", ".blur_radius_arcmin"}) csv += "," + csv_field(thing.name + what);
  }
  csv += "\n";
  for (std::size_t i = 0; i < sweep.focus_d.size(); ++i) {
    csv += exact_text(sweep.focus_d[i]) + "," + exact_text(1.0 / sweep.focus_d[i]);
    for (const ThingLook& look : sweep.looks[i]) {
      csv += "," + exact_text(sharpness_of(look)) + "," + exact_text(look.light) + "," +
             exact_text(look.blur_radius_arcmin);
    }
    csv += "\n";
  }
  return csv;
}

std::string sweep_title(const SweepRun& run, const RetinaView& view) { return run.show + ": " + who(run, view); }

LinePlot contrast_plot(const std::string& title, const FocalSweep& sweep) {
  LinePlot plot;
  plot.title = title;
  const double from_d = sweep.focus_d.front(), to_d = sweep.focus_d.back();
  plot.bottom = {"focus of the eye (dioptres at the lens)", from_d, to_d, round_ticks(from_d, to_d, 8)};
  plot.top = {"metres from the lens", from_d, to_d, metre_ticks(from_d, to_d)};
  double most = 1.0;
  for (std::size_t thing = 0; thing < sweep.things.size(); ++thing) {
    if (!sweep.peaks[thing]) continue;
    plot.lines.push_back({sweep.things[thing].name, sweep.focus_d, sharpness_over(sweep, thing)});
    for (const double sharpness : plot.lines.back().y)
      most = std::isfinite(sharpness) ? std::max(most, sharpness) : most;
  }
  plot.left = {"sharpness (1: as through a pinhole)", 0.0, 1.05 * most, round_ticks(0.0, 1.05 * most, 6)};
  plot.without_lines = "nothing that is seen has contrast";
  return plot;
}

Value sweep_value(const SweepRun& run, const RetinaView& view, const FocalSweep& sweep) {
  Value object;
  object.set("folder", run.folder);
  set_look(object, {run.show, run.frame, std::nullopt, run.pupil_mm}, view);
  Value::Array pictures, foci;
  for (int i = 0; i < run.range.count; ++i) {
    pictures.push_back(sweep_picture_name(run.range, i));
    foci.push_back(run.range.at(i));
  }
  object.set("pictures", std::move(pictures));
  object.set("focus_d", std::move(foci));
  Value::Array things;
  for (std::size_t i = 0; i < sweep.things.size(); ++i) things.push_back(thing_value(sweep, i));
  object.set("things", std::move(things));
  return object;
}

std::string sweep_text(const SweepRun& run, const RetinaView& view, const FocalSweep& sweep) {
  std::string text = run.folder + ": " + std::to_string(run.range.count) + " pictures from " +
                     short_text(run.range.from_d) + " D to " + short_text(run.range.to_d) +
                     " D, contrast.csv, contrast.png; " + who(run, view) + "\n";
  std::vector<std::vector<std::string>> rows;
  bool any = false;
  for (std::size_t i = 0; i < sweep.things.size(); ++i) {
    const std::optional<FocusPeak>& peak = sweep.peaks[i];
    any = any || peak.has_value();
    rows.push_back({sweep.things[i].name, kind_of(sweep.things[i]), std::to_string(sweep.looks.front()[i].pixels),
                    peak ? fixed_text(peak->focus_d, 3) : "-",
                    peak && peak->focus_d > 0.0 ? fixed_text(1.0 / peak->focus_d, 3) : "-",
                    peak ? fixed_text(peak->sharpness, 2) : "-",
                    !peak          ? ""
                    : peak->inside ? ""
                                   : "at the end of the sweep, perhaps beyond"});
  }
  if (rows.empty()) return text + "Nothing stands on this stage.\n";
  if (!any) text += "Nothing that is seen has contrast.\n";
  return text +
         table_text(
             {{"thing"}, {"kind"}, {"pixels", true}, {"sharpest/D", true}, {"at/m", true}, {"sharpness", true}, {""}},
             rows);
}

}  // namespace focalstage
