#pragma once

#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/scene/finding.h"
#include "core/scene/value.h"
#include "editor/cli/command.h"

namespace focalstage {

/// Says the fault on stderr in one line and returns the status that fits its code.
ExitStatus report(const Fault& fault);

/// The status that fits a fault: `environment` for rigs, disks and displays, else `invalid`.
ExitStatus status_of(const Fault& fault);

/// One JSON object on stdout, and nothing else.
void print_json(const Value& object);

/// `{"findings":[...]}`, the start of what `--json` prints.
Value findings_value(const std::vector<Finding>& findings);

/// Findings for people: one paragraph each, or that there are none.
std::string findings_text(const std::vector<Finding>& findings);

/// `done`, or `findings` where one is an error.
ExitStatus status_of(const std::vector<Finding>& findings);

/// A table with a header row, columns as wide as their widest cell, numbers (`right`) flush right.
struct Column {
  std::string title;
  bool right = false;
};
std::string table_text(const std::vector<Column>& columns, const std::vector<std::vector<std::string>>& rows);

}  // namespace focalstage
