#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "core/base/result.h"
#include "core/schedule/projector_models.h"
#include "io/files/user_folders.h"

namespace focalstage {

/// What the folder of models beside a project, and in the user's configuration, is called.
inline constexpr const char* models_folder_name = "models";

/// The published schema, io/schema/model.schema.json.
std::string_view model_schema();

/// Reads a model. Faults "json.*", "model.*" name `source`, the JSON pointer, the cause and the remedy.
Result<ProjectorModelData> parse_model(std::string_view text, const std::string& source);

/// The models that come with the program.
Result<ProjectorModels> shipped_models();

/// Every *.json of a folder, by the files' names; none where there is no such folder. Faults as above, "file.*", and
/// "model.twice" where two files describe one model.
Result<ProjectorModels> models_in(const std::filesystem::path& folder);

/// All that are known to a project: those that come with the program, then the user's own (models/ in `user_folder`),
/// then those in models/ beside the project's file. A later one takes the place of an earlier one of the same name.
/// Without a project's folder: the first two.
Result<ProjectorModels> known_models(const std::filesystem::path& project_folder = {},
                                     const std::filesystem::path& user_folder = user_config_folder());

/// Takes the models beside a project along to another folder. Files that are there already stay.
Status copy_models(const std::filesystem::path& from_folder, const std::filesystem::path& to_folder);

}  // namespace focalstage
