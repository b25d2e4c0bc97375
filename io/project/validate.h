#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/base/result.h"
#include "core/scene/value.h"

namespace focalstage {

/// Holds `value` against a JSON schema (draft 7) of a `kind` of file ("project", io/schema/project.schema.json). The
/// deepest thing wrong, code "KIND.schema", with its JSON pointer in `where`, or nothing.
std::optional<Fault> schema_fault(const Value& value, std::string_view schema, const std::string& kind = "project");

}  // namespace focalstage
