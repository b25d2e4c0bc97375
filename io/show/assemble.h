#pragma once

#include <filesystem>
#include <stop_token>

#include "core/base/result.h"
#include "io/show/part.h"
#include "io/show/show.h"

namespace focalstage {

/// Writes the show of `header` and the frames of `logs`, one for each projector, to `path`, sealed and synced. Holds
/// one frame in memory at a time.
Status assemble(const std::filesystem::path& path, const ShowHeader& header, const std::vector<PartLog>& logs,
                std::stop_token stop);

}  // namespace focalstage
