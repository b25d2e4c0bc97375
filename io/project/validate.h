#pragma once

#include <optional>
#include <string_view>

#include "core/base/result.h"
#include "core/scene/value.h"

namespace focalstage {

/// Holds `value` against a JSON schema (draft 7). The deepest thing wrong, with its JSON pointer in `where`, or
/// nothing.
std::optional<Fault> schema_fault(const Value& value, std::string_view schema);

}  // namespace focalstage
