#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/base/result.h"
#include "core/scene/value.h"

namespace focalstage {

/// The fault of a place in the file `source`: "file: /pointer".
Fault in_file(Fault fault, const std::string& source);

/// Holds `value` against a JSON schema (draft 7) of a `kind` of file ("project", io/schema/project.schema.json). The
/// deepest thing wrong, code "KIND.schema", with its JSON pointer in `where`, or nothing.
std::optional<Fault> schema_fault(const Value& value, std::string_view schema, const std::string& kind = "project");

/// Parses a `kind` of file and holds it against its schema. Faults: those of parse_json and schema_fault, in `source`.
Result<Value> parse_checked(std::string_view text, const std::string& source, std::size_t most_bytes,
                            std::string_view schema, const std::string& kind);

}  // namespace focalstage
