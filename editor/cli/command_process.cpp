#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <filesystem>
#include <memory>

#include "core/base/number_words.h"
#include "core/stage/deviation.h"
#include "editor/cli/command_list.h"
#include "editor/cli/deviation_file.h"
#include "editor/cli/output.h"
#include "editor/pipeline/source.h"
#include "io/files/files.h"

namespace focalstage {
namespace {

struct Options {
  std::string file;
  std::string folder;
  double full_scale_mm = 0.0;
  bool json = false;
};

/// A thing whose mesh has steps, with and without them.
struct Processed {
  std::string list;
  std::string name;
  std::vector<Drawable> before;
  std::vector<Drawable> after;
  Deviation deviation;
};

std::size_t triangles_in(const std::vector<Drawable>& drawables) {
  std::size_t count = 0;
  for (const Drawable& drawable : drawables) count += drawable.mesh->triangles.size();
  return count;
}

template <class Things, class Staged>
void add_processed(const std::string& list, const Things& things, const std::vector<Staged>& before,
                   const std::vector<Staged>& after, std::vector<Processed>& all) {
  for (std::size_t i = 0; i < after.size(); ++i) {
    if (things[after[i].index].mesh.process.empty() || after[i].drawables.empty()) continue;
    all.push_back({list, after[i].name, before[i].drawables, after[i].drawables,
                   deviation_of(before[i].drawables, after[i].drawables)});
  }
}

Result<std::vector<Processed>> processed_things(const std::string& file) {
  const auto source = open_project(file);
  if (!source) return source.fault();
  const Project& project = source->project;
  Project plain = project;
  for (Surface& surface : plain.surfaces) surface.mesh.process.clear();
  for (Object& object : plain.objects) object.mesh.process.clear();
  const auto before = stage(plain, source->loaded.assets, 0.0);
  if (!before) return before.fault();
  const auto after = stage(project, source->loaded.assets, 0.0);
  if (!after) return after.fault();
  std::vector<Processed> all;
  add_processed("surfaces", project.surfaces, before->surfaces, after->surfaces, all);
  add_processed("objects", project.objects, before->objects, after->objects, all);
  return all;
}

/// Names may hold anything that a path must not.
std::string file_name(const Processed& thing, std::size_t index) {
  std::string name = thing.name;
  std::ranges::replace_if(
      name, [](unsigned char c) { return c < 0x80 && !std::isalnum(c) && c != '-' && c != '_'; }, '_');
  return std::to_string(index + 1) + "-" + name + ".ply";
}

Status write_pictures(const std::vector<Processed>& things, const Options& options) {
  std::error_code error;
  std::filesystem::create_directories(options.folder, error);
  if (error) return Fault{"file.unwritable", options.folder, error.message(), "name another folder"};
  for (std::size_t i = 0; i < things.size(); ++i) {
    const double worst_m = things[i].deviation.worst_m;
    // Without any deviation all is blue, whatever the scale.
    const double full_scale_m = options.full_scale_mm > 0.0 ? 1e-3 * options.full_scale_mm
                                : worst_m > 0.0             ? worst_m
                                                            : 1e-3;
    const std::string text = deviation_ply(things[i].after, things[i].deviation, full_scale_m);
    const auto path = std::filesystem::path(options.folder) / file_name(things[i], i);
    if (Status written = write_file_atomically(path, text); !written) return written;
  }
  return {};
}

void print_things(const std::vector<Processed>& things) {
  Value::Array list;
  for (const Processed& thing : things) {
    Value value;
    value.set("list", thing.list);
    value.set("name", thing.name);
    value.set("triangles_before", static_cast<double>(triangles_in(thing.before)));
    value.set("triangles_after", static_cast<double>(triangles_in(thing.after)));
    value.set("mean_mm", 1e3 * thing.deviation.mean_m);
    value.set("worst_mm", 1e3 * thing.deviation.worst_m);
    value.set("worst_lost_mm", 1e3 * thing.deviation.worst_lost_m);
    list.push_back(std::move(value));
  }
  Value object;
  object.set("things", Value(std::move(list)));
  print_json(object);
}

std::string words_of(const std::vector<Processed>& things) {
  if (things.empty()) return "no mesh of the project has steps\n";
  std::vector<std::vector<std::string>> rows;
  for (const Processed& thing : things) {
    rows.push_back({thing.name, std::to_string(triangles_in(thing.before)), std::to_string(triangles_in(thing.after)),
                    fixed_text(1e3 * thing.deviation.mean_m, 3), fixed_text(1e3 * thing.deviation.worst_m, 3),
                    fixed_text(1e3 * thing.deviation.worst_lost_m, 3)});
  }
  return table_text({{"thing"},
                     {"triangles before", true},
                     {"after", true},
                     {"off by, mean mm", true},
                     {"worst mm", true},
                     {"worst mm of what went", true}},
                    rows);
}

ExitStatus run(const Options& options) {
  const auto things = processed_things(options.file);
  if (!things) return report(things.fault());
  if (!options.folder.empty()) {
    if (Status written = write_pictures(*things, options); !written) return report(written.fault());
  }
  if (options.json) {
    print_things(*things);
  } else {
    std::printf("%s", words_of(*things).c_str());
  }
  return ExitStatus::done;
}

}  // namespace

Command::Run declare_process(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  app.add_option("PROJECT", options->file, "a project")->required()->type_name("");
  app.add_option("-o,--output", options->folder, "write each mesh there as PLY, coloured by how far it is off")
      ->type_name("DIR");
  app.add_option("--full-scale-mm", options->full_scale_mm, "what is red; without, the worst there is")
      ->type_name("MM")
      ->check(CLI::Range(1e-6, 1e6));
  app.add_flag("--json", options->json, "print one JSON object");
  return [options] { return run(*options); };
}

}  // namespace focalstage
