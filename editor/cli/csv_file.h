#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"

namespace focalstage {

/// A line of a CSV file that people write.
struct CsvLine {
  std::string where;               ///< the file and the line's number, for faults
  std::vector<std::string> cells;  ///< as many as there are columns
};

/// The lines of a file whose first one is `columns`; empty ones and those that begin with # say nothing, blanks around
/// a cell neither. Faults of code `code` name the line.
Result<std::vector<CsvLine>> read_csv(const std::filesystem::path& file, std::string_view columns, const char* code);

/// The whole cell as a number.
std::optional<double> number_of(const std::string& cell);

}  // namespace focalstage
