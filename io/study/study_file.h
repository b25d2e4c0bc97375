#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "core/base/result.h"
#include "core/scene/value.h"
#include "core/study/study.h"

namespace focalstage {

/// What a folder calls its study.
inline constexpr const char* study_file_name = "study.json";

struct LoadedStudy {
  Study study;
  std::filesystem::path file;
};

/// The published schema, io/schema/study.schema.json.
std::string_view study_schema();

/// Reads a study file, or the study.json of a folder. A study is a protocol: a key that is not known is a fault, not a
/// note. Faults "json.*", "study.*", "file.*" name the file and the place in it.
Result<LoadedStudy> load_study(const std::filesystem::path& study);

/// The same from text; `source` names it in faults.
Result<Study> parse_study(std::string_view text, const std::string& source);

/// The text of a study file.
std::string study_text(const Study& study);

/// 16 hex digits that tell a study from others: all of it but the participants, to whom more may come.
std::string study_fingerprint(const Study& study);

}  // namespace focalstage
