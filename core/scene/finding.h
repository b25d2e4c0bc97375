#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/scene/edit.h"

namespace focalstage {

enum class Severity { error, warning, info };

/// How much, against what is allowed.
struct Amount {
  double value = 0.0;
  double limit = 0.0;
  std::string unit;

  bool operator==(const Amount&) const = default;
};

/// Something wrong with a project that can still be opened. `where` is a JSON pointer into it.
struct Finding {
  Severity severity = Severity::error;
  std::string code;
  std::string where;
  std::string message;
  std::optional<Amount> amount;
  std::vector<Edit> remedy;  ///< may be empty

  bool operator==(const Finding&) const = default;
};

bool has_error(const std::vector<Finding>& findings);

/// The finding as the object that `--json` prints.
Value value_from(const Finding& finding);

}  // namespace focalstage
