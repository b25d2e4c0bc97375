#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/base/result.h"

namespace focalstage {

/// From what tinygltf makes of a uri to the file it names: tinygltf takes a plus sign for a space, as in a web form.
using CompanionNames = std::map<std::string, std::string>;

/// Of all uris that are not data themselves. Refuses those with a scheme ("https:"): nothing is fetched from elsewhere.
Result<CompanionNames> companion_names(const std::vector<std::string>& uris, const std::string& path);

}  // namespace focalstage
