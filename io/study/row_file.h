#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "io/files/descriptor.h"

namespace focalstage {

/// The lines of a text file of rows, without its header; and whether its last line was cut off.
struct RowList {
  std::vector<std::string> lines;
  bool torn = false;  ///< the last line has no end: it was being written, and is no row
};

/// Reads a file of rows whose first line must be `header`. Nothing is changed. Fault "study.rows" for another header.
Result<RowList> read_rows(const std::filesystem::path& path, std::string_view header);

/// A file of rows that only grows. A row that `append` has taken outlives a kill and a power cut; one that it could not
/// take leaves the file as it was.
class RowFile {
 public:
  /// Opens the file for this process alone, or makes it with its header; cuts off a torn line. Faults "trials.busy"
  /// (another process has it), "study.rows", "file.*".
  static Result<RowFile> open(const std::filesystem::path& path, std::string_view header);

  /// What was there when it was opened.
  const RowList& rows() const { return rows_; }

  /// `row` without its line end. Fault "file.unwritable".
  Status append(const std::string& row);

 private:
  RowFile(std::filesystem::path path, Descriptor file) : path_(std::move(path)), file_(std::move(file)) {}
  Status begin(std::string_view header);

  std::filesystem::path path_;
  Descriptor file_;
  std::uint64_t size_ = 0;
  RowList rows_;
};

}  // namespace focalstage
