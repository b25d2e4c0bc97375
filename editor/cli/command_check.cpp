#include <CLI/CLI.hpp>
#include <memory>

#include "core/base/number_words.h"
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
};

/// The report, and what the objects that it counts are called.
struct CheckedNames {
  CheckReport report;
  std::vector<std::string> objects;
};

Result<CheckedNames> named(const Source& source, Result<CheckReport> report) {
  if (!report) return report.fault();
  CheckedNames all{*std::move(report), {}};
  for (const Object& object : source.project.objects) all.objects.push_back(object.name);
  return all;
}

Result<CheckedNames> checked(const Options& options) {
  const auto style = options.json ? Progress::Style::quiet : Progress::Style::automatic;
  if (!is_show(options.file)) {
    const auto source = open_project(options.file);
    if (!source) return source.fault();
    Progress bar("Checking " + source->project.name, style);
    return named(*source, check_project(*source, {}, [&](int done, int of) { bar.update(done, of, "frame"); }, {}));
  }
  const auto show = ShowReader::open(options.file);
  if (!show) return show.fault();
  const auto source = project_in(*show, options.file);
  if (!source) return source.fault();
  Progress bar("Checking " + source->project.name, style);
  return named(*source, check_show(*source, *show, [&](int done, int of) { bar.update(done, of, "frame"); }, {}));
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

ExitStatus run(const Options& options) {
  const auto all = checked(options);
  if (!all) return report(all.fault());
  if (options.json) {
    Value object = findings_value(all->report.findings);
    object.set("conflict", conflicts_value(*all));
    print_json(object);
  } else {
    std::fputs((findings_text(all->report.findings) + conflicts_text(*all)).c_str(), stdout);
  }
  return status_of(all->report.findings);
}

}  // namespace

Command::Run declare_check(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  app.add_option("FILE", options->file, "a project (NAME.focal or its folder) or a show (.h5)")
      ->required()
      ->type_name("");
  app.add_flag("--json", options->json, "print the findings as one JSON object");
  return [options] { return run(*options); };
}

}  // namespace focalstage
