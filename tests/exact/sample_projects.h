#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "core/stage/stage.h"
#include "io/assets/assets.h"
#include "io/project/project_file.h"

namespace focalstage::exact {

/// Every project that comes with the program, by name.
inline std::vector<std::filesystem::path> projects() {
  std::vector<std::filesystem::path> folders;
  for (const auto& entry : std::filesystem::directory_iterator(FOCALSTAGE_SOURCE_DIR "/projects")) {
    if (entry.is_directory()) folders.push_back(entry.path());
  }
  std::sort(folders.begin(), folders.end());
  return folders;
}

/// A project with its files, as it lies in its folder.
struct Opened {
  Project project;
  std::string text;
  LoadedAssets loaded;
};

inline Opened opened(const std::filesystem::path& folder) {
  Result<LoadedProject> project = load_project(folder);
  REQUIRE(project);
  Result<LoadedAssets> loaded = load_assets(project->project, folder);
  REQUIRE(loaded);
  return {project->project, project->text, *std::move(loaded)};
}

inline Stage staged(const Project& project, const Assets& assets, int frame) {
  Result<Stage> up = stage(project, assets, frame / project.frames.rate_hz);
  REQUIRE(up);
  return *std::move(up);
}

}  // namespace focalstage::exact
