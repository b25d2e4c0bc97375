#include "core/scene/project_value.h"
#include "io/files/files.h"
#include "io/json/json.h"
#include "io/project/project_file.h"

namespace focalstage {

std::string project_text(const Project& project) { return write_json(value_from(project)) + "\n"; }

Status save_project(const Project& project, const std::filesystem::path& file) {
  return write_file_atomically(file, project_text(project));
}

}  // namespace focalstage
