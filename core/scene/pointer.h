#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/scene/value.h"

namespace focalstage {

/// `where` (a JSON pointer, RFC 6901) one step deeper.
std::string pointer_into(std::string_view where, std::string_view step);
std::string pointer_into(std::string_view where, std::size_t index);

/// The steps of a pointer, or of an edit's key path, which is one without the leading slash.
std::vector<std::string> pointer_steps(std::string_view pointer);

/// The array index that `step` spells, if it does.
std::optional<std::size_t> index_in(std::string_view step);

/// The value at the steps below `root`; null where there is none.
const Value* value_at(const Value& root, const std::vector<std::string>& steps);

}  // namespace focalstage
