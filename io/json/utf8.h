#pragma once

#include <string>
#include <string_view>

namespace focalstage {

/// `text` with every byte that is no part of valid UTF-8 replaced by U+FFFD, so that names of files from elsewhere
/// never spoil a JSON line.
std::string valid_utf8(std::string_view text);

}  // namespace focalstage
