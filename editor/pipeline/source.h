#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/scene/finding.h"
#include "core/scene/project.h"
#include "core/schedule/projector_models.h"
#include "io/assets/assets.h"
#include "io/show/reader.h"

namespace focalstage {

/// A project with everything it refers to, from its folder or out of a show.
struct Source {
  Project project;
  std::string text;  ///< the bytes of the project file
  LoadedAssets loaded;
  std::vector<Finding> notes;  ///< what reading it noticed: unknown keys, an older version
  ProjectorModels models{};    ///< what its projectors can do
};

/// `NAME.focal` or the folder that holds it.
Result<Source> open_project(const std::filesystem::path& project);

/// The project inside a show; of what lies beside the show nothing is read. `name` is the show's, for faults.
Result<Source> project_in(const ShowReader& show, const std::string& name);

/// Whether the file says it is a show, by its first words or its name.
bool is_show(const std::filesystem::path& path);

}  // namespace focalstage
