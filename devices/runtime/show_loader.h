#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "core/base/result.h"
#include "devices/player/player.h"
#include "devices/runtime/admission.h"

namespace focalstage {

/// Opens a show for the rig, or says why this rig will not play it: the faults of `admit`, and "show.*".
Result<std::shared_ptr<const LoadedShow>> load_show(const std::filesystem::path& path, const std::string& sha256,
                                                    const RigTerms& rig);

}  // namespace focalstage
