#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/calibrate/projector_scan.h"
#include "core/stripes/pattern_set.h"

namespace focalstage {

inline constexpr const char* patterns_file_name = "patterns.json";
inline constexpr const char* scan_file_name = "scan.json";

/// What `focalstage calibrate patterns` leaves beside its pictures, and `scan` reads again: which patterns were shown
/// by which projector.
struct PatternsFile {
  std::string projector;
  PatternSet set;
};

std::string patterns_text(const PatternsFile& patterns);
Result<PatternsFile> read_patterns(const std::filesystem::path& file);

/// "07-columns-code-2-inverse".
std::string picture_name(const PatternSet& set, std::size_t index);

/// One capture: a folder with one picture per pattern.
struct CaptureEntry {
  std::string folder;
  bool board = false;  ///< whether a board was held there
};

/// The file scan.json of a folder of captures.
struct ScanFile {
  CharucoBoard board;
  std::vector<CaptureEntry> captures;
  ScanWorld world;
  std::size_t mesh_of = 0;  ///< the capture that becomes a mesh
};

/// Faults name the file and the JSON pointer.
Result<ScanFile> read_scan(const std::filesystem::path& file);

/// The pictures of one capture (PNG, JPEG), in the order of their names, numbers in them counted. "capture.missing"
/// where one is lacking, by its name where names begin with its number.
Result<Capture> read_capture(const std::filesystem::path& folder, const PatternSet& set);

}  // namespace focalstage
