#include <CLI/CLI.hpp>
#include <memory>

#include "editor/cli/command_list.h"
#include "editor/cli/output.h"
#include "io/assets/assets.h"

namespace focalstage {
namespace {

struct Options {
  std::string file;
  bool json = false;
};

void print_report(const ImportReport& found) {
  Value object;
  object.set("vertices", static_cast<double>(found.vertices));
  object.set("triangles", static_cast<double>(found.triangles));
  object.set("nodes", static_cast<double>(found.nodes));
  object.set("animations", static_cast<double>(found.animations));
  object.set("findings", *findings_value(found.findings).find("findings"));
  print_json(object);
}

ExitStatus run(const Options& options) {
  const auto found = inspect_asset(options.file);
  if (!found) return report(found.fault());
  if (options.json) {
    print_report(*found);
  } else {
    std::printf("%s: %zu vertices, %zu triangles, %zu nodes, %zu animations\n%s", options.file.c_str(), found->vertices,
                found->triangles, found->nodes, found->animations, findings_text(found->findings).c_str());
  }
  return status_of(found->findings);
}

}  // namespace

Command::Run declare_import(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  app.add_option("FILE", options->file, "a mesh (.obj .ply .stl .off) or glTF file (.gltf .glb)")
      ->required()
      ->type_name("");
  app.add_flag("--json", options->json, "print the counts and findings as one JSON object");
  return [options] { return run(*options); };
}

}  // namespace focalstage
