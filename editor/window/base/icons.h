#pragma once

#include <string_view>

namespace focalstage {

/// The UTF-8 glyph of a named icon ("object", "undo", "warning"); a plain dot for a name that is not in the table, so
/// that a misspelt one is seen. Empty for an empty name.
std::string_view icon(std::string_view name);

/// Whether the table has it.
bool has_icon(std::string_view name);

}  // namespace focalstage
