#pragma once

#include <filesystem>
#include <vector>

#include "core/base/result.h"
#include "core/scene/edit.h"
#include "io/project/project_file.h"

namespace focalstage {

/// The edits of a file: one JSON object per line, empty lines passed over. Faults name the line.
Result<std::vector<Edit>> read_edits(const std::filesystem::path& file);

/// Applies `edits` and saves: to the project's own file, or to `output` (a NAME.focal, or a folder that becomes
/// NAME/NAME.focal), where the assets go along. Returns the file written.
Result<std::filesystem::path> apply_and_save(const LoadedProject& loaded, const std::vector<Edit>& edits,
                                             const std::filesystem::path& output);

}  // namespace focalstage
