#pragma once

#include <string>
#include <string_view>

#include "core/base/result.h"
#include "core/scene/value.h"

namespace focalstage {

/// Limits on JSON from outside, against files made to exhaust the reader.
struct JsonLimits {
  std::size_t bytes = 64u << 20;
  int depth = 64;
};

/// Parses `text`; `source` names it in faults. Codes: "json.syntax" (line and column), "json.depth", "json.size",
/// "json.number" (not finite), "json.duplicate-key".
Result<Value> parse_json(std::string_view text, const std::string& source, const JsonLimits& limits = {});

/// JSON text of `value`; `indent` < 0: on one line. Numbers as the shortest text that reads back to the same double;
/// arrays of numbers stay on one line.
std::string write_json(const Value& value, int indent = 2);

}  // namespace focalstage
