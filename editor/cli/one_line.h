#pragma once

#include <string>
#include <string_view>

namespace focalstage {

/// `text` fit for one line of a terminal: what is no printable UTF-8 as \xNN, so that no file can speak through us.
std::string one_line(std::string_view text);

}  // namespace focalstage
