#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "core/check/check.h"
#include "core/stage/stage.h"
#include "editor/cli/command_list.h"
#include "editor/cli/output.h"
#include "io/assets/assets.h"

namespace focalstage {
namespace {

struct Options {
  std::string file;
  bool json = false;
};

/// The file as the only thing of a project, to be looked at as `check` looks. What is found is added to `found`.
Result<MeshState> state_of(const std::string& name, ImportReport& found) {
  Project project;
  project.objects.resize(1);
  project.objects[0].name = name;
  project.objects[0].mesh.shape = FileMesh{name};
  const auto stood = stage(project, Assets{{{name, found.model}}}, 0.0);
  if (!stood) return stood.fault();
  const std::vector<MeshState> states = mesh_states(project, *stood);
  for (Finding& finding : mesh_findings(project, states)) {
    finding.where = name;
    finding.remedy.clear();  // belongs to a thing of a project
    found.findings.push_back(std::move(finding));
  }
  return states.front();
}

void print_report(const ImportReport& found, const glm::dvec3& size_m) {
  Value object;
  object.set("vertices", static_cast<double>(found.vertices));
  object.set("triangles", static_cast<double>(found.triangles));
  object.set("nodes", static_cast<double>(found.model->nodes.size()));
  object.set("animations", static_cast<double>(found.model->animations.size()));
  object.set("size_m", Value(Value::Array{size_m.x, size_m.y, size_m.z}));
  object.set("findings", *findings_value(found.findings).find("findings"));
  print_json(object);
}

ExitStatus run(const Options& options) {
  auto found = inspect_asset(options.file);
  if (!found) return report(found.fault());
  const auto state = state_of(std::filesystem::path(options.file).filename().string(), *found);
  if (!state) return report(state.fault());
  const glm::dvec3& size_m = state->size_m;
  if (options.json) {
    print_report(*found, size_m);
  } else {
    std::printf("%s: %zu vertices, %zu triangles, %zu nodes, %zu animations, %.4g x %.4g x %.4g m\n%s",
                options.file.c_str(), found->vertices, found->triangles, found->model->nodes.size(),
                found->model->animations.size(), size_m.x, size_m.y, size_m.z, findings_text(found->findings).c_str());
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
