#include "editor/pipeline/source.h"

#include <array>
#include <fstream>
#include <string_view>
#include <utility>

#include "io/models/models.h"
#include "io/project/project_file.h"

namespace focalstage {

Result<Source> open_project(const std::filesystem::path& project) {
  auto read = load_project(project);
  if (!read) return read.fault();
  auto loaded = load_assets(read->project, read->file.parent_path());
  if (!loaded) return loaded.fault();
  auto models = known_models(read->file.parent_path());
  if (!models) return models.fault();
  return Source{std::move(read->project), std::move(read->text), std::move(*loaded), std::move(read->notes),
                *std::move(models)};
}

Result<Source> project_in(const ShowReader& show, const std::string& name) {
  const ShowHeader& header = show.header();
  auto read = parse_project(header.project_text, name + ": /project");
  if (!read) return read.fault();
  auto assets = assets_from(read->project, header.assets);
  if (!assets) return assets.fault();
  auto models = known_models();
  if (!models) return models.fault();
  LoadedAssets loaded{std::move(*assets), header.assets};
  return Source{std::move(read->project), header.project_text, std::move(loaded), std::move(read->notes),
                *std::move(models)};
}

bool is_show(const std::filesystem::path& path) {
  static constexpr std::string_view first_words = "focalstage-show";
  std::array<char, first_words.size()> start{};
  std::error_code problem;
  if (std::filesystem::is_regular_file(path, problem)) {
    std::ifstream(path, std::ios::binary).read(start.data(), start.size());
  }
  return path.extension() == ".h5" || std::string_view(start.data(), start.size()) == first_words;
}

}  // namespace focalstage
