#include <CLI/CLI.hpp>
#include <algorithm>
#include <functional>
#include <memory>

#include "core/base/number_words.h"
#include "core/sensitivity/sensitivity.h"
#include "editor/cli/command_list.h"
#include "editor/cli/output.h"
#include "editor/cli/progress.h"
#include "editor/pipeline/compile_show.h"
#include "editor/pipeline/source.h"

namespace focalstage {
namespace {

struct Options {
  std::string file;
  bool json = false;
  bool sensitivity = false;
};

/// The report, and what the things that it counts are called.
struct CheckedNames {
  CheckReport report;
  std::vector<std::string> objects;
  std::vector<std::string> surfaces;
  std::vector<ErrorEffect> effects;
};

/// Adds what small errors of the rig would do, where that is asked for.
Result<CheckedNames> with_effects(const Options& options, const Source& source, Result<CheckedNames> all) {
  if (!all || !options.sensitivity) return all;
  auto effects = sensitivity(source.project, source.loaded.assets);
  if (!effects) return effects.fault();
  all->effects = *std::move(effects);
  return all;
}

Result<CheckedNames> named(const Source& source, Result<CheckReport> report) {
  if (!report) return report.fault();
  CheckedNames all{*std::move(report), {}, {}, {}};
  for (const Surface& surface : source.project.surfaces) all.surfaces.push_back(surface.name);
  for (const Object& object : source.project.objects) all.objects.push_back(object.name);
  return all;
}

Result<CheckedNames> checked(const Options& options) {
  const auto style = options.json ? Progress::Style::quiet : Progress::Style::automatic;
  if (!is_show(options.file)) {
    const auto source = open_project(options.file);
    if (!source) return source.fault();
    Progress bar("Checking " + source->project.name, style);
    const auto progress = [&](int done, int of) { bar.update(done, of, "frame"); };
    return with_effects(options, *source, named(*source, check_project(*source, {}, progress, {})));
  }
  const auto show = ShowReader::open(options.file);
  if (!show) return show.fault();
  const auto source = project_in(*show, options.file);
  if (!source) return source.fault();
  Progress bar("Checking " + source->project.name, style);
  const auto progress = [&](int done, int of) { bar.update(done, of, "frame"); };
  return with_effects(options, *source, named(*source, check_show(*source, *show, progress, {})));
}

Value conflicts_value(const CheckedNames& all) {
  Value::Array conflicts;
  for (const ObjectConflict& one : all.report.conflicts) {
    Value value;
    value.set("object", all.objects[one.index]);
    value.set("mean_d", one.mean_d);
    value.set("worst_d", one.worst_d);
    value.set("beyond_comfort", one.beyond_comfort);
    conflicts.push_back(std::move(value));
  }
  return conflicts;
}

std::string conflicts_text(const CheckedNames& all) {
  if (all.report.conflicts.empty()) return "";
  std::vector<std::vector<std::string>> rows;
  for (const ObjectConflict& one : all.report.conflicts) {
    rows.push_back({all.objects[one.index], fixed_text(one.mean_d, 2), fixed_text(one.worst_d, 2),
                    fixed_text(100.0 * one.beyond_comfort, 0)});
  }
  return "\nVergence against accommodation, in dioptres (positive: the focus lies further away)\n" +
         table_text({{"object"}, {"mean", true}, {"worst", true}, {"% beyond 0.5", true}}, rows);
}

/// JSON has no infinity: where nothing is black, there is no ratio.
Value contrasts_value(const CheckedNames& all) {
  Value::Array contrasts;
  for (const SurfaceContrast& one : all.report.contrasts) {
    Value value;
    value.set("surface", all.surfaces[one.index]);
    value.set("exposures", one.exposures);
    value.set("white", one.white);
    value.set("leak", one.leak);
    value.set("ambient", one.knows_ambient ? Value(one.ambient) : Value());
    value.set("contrast", one.black() > 0.0 && one.knows_ambient ? Value(one.ratio()) : Value());
    if (one.white_cd_m2 > 0.0) value.set("white_cd_m2", one.white_cd_m2);
    contrasts.push_back(std::move(value));
  }
  return contrasts;
}

std::string contrasts_text(const CheckedNames& all) {
  if (all.report.contrasts.empty()) return "";
  std::vector<std::vector<std::string>> rows;
  for (const SurfaceContrast& one : all.report.contrasts) {
    const bool known = one.knows_ambient;
    rows.push_back({all.surfaces[one.index], std::to_string(one.exposures), fixed_text(100.0 * one.leak, 2),
                    known ? fixed_text(100.0 * one.ambient, 2) : "?",
                    known && one.black() > 0.0 ? short_text(one.ratio(), 3) + " : 1" : "?"});
  }
  return "\nWhite against black, to the eye that has it worse (leak and room: % of full white in one exposure)\n" +
         table_text({{"surface"}, {"exposures", true}, {"leak", true}, {"room", true}, {"contrast", true}}, rows);
}

Value effects_value(const std::vector<ErrorEffect>& effects) {
  Value::Array list;
  for (const ErrorEffect& effect : effects) {
    Value value;
    value.set("error", effect.error.what);
    value.set("amount", effect.error.amount);
    value.set("unit", effect.error.unit);
    value.set("shift_arcmin", effect.shift_arcmin);
    value.set("focus_d", effect.focus_d);
    value.set("vergence_d", effect.vergence_d);
    value.set("object", effect.object);
    list.push_back(std::move(value));
  }
  return list;
}

std::string effects_text(std::vector<ErrorEffect> effects) {
  if (effects.empty()) return "";
  std::ranges::stable_sort(effects, std::greater(), &ErrorEffect::shift_arcmin);
  std::vector<std::vector<std::string>> rows;
  for (const ErrorEffect& effect : effects) {
    if (effect.object.empty()) continue;
    rows.push_back({effect.error.what, short_text(effect.error.amount, 3) + " " + effect.error.unit,
                    fixed_text(effect.shift_arcmin, 2), fixed_text(effect.vergence_d, 3), fixed_text(effect.focus_d, 3),
                    effect.object});
  }
  return "\nWhat an error of the rig would do: where a picture is seen (arc minutes), where eyes converge and focus "
         "(D)\n" +
         table_text({{"error"}, {"by", true}, {"shift", true}, {"vergence", true}, {"focus", true}, {"worst for"}},
                    rows);
}

ExitStatus run(const Options& options) {
  const auto all = checked(options);
  if (!all) return report(all.fault());
  if (options.json) {
    Value object = findings_value(all->report.findings);
    object.set("conflict", conflicts_value(*all));
    if (!all->report.contrasts.empty()) object.set("contrast", contrasts_value(*all));
    if (options.sensitivity) object.set("sensitivity", effects_value(all->effects));
    print_json(object);
  } else {
    std::fputs(
        (findings_text(all->report.findings) + conflicts_text(*all) + contrasts_text(*all) + effects_text(all->effects))
            .c_str(),
        stdout);
  }
  return status_of(all->report.findings);
}

}  // namespace

Command::Run declare_check(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  app.add_option("FILE", options->file, "a project (NAME.focal or its folder) or a show (.h5)")
      ->required()
      ->type_name("");
  app.add_flag("--sensitivity", options->sensitivity,
               "tell what a millimetre, a degree, a tenth of a dioptre would do to what is seen");
  app.add_flag("--json", options->json, "print the findings as one JSON object");
  return [options] { return run(*options); };
}

}  // namespace focalstage
