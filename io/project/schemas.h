#pragma once

#include <string_view>

namespace focalstage {

/// The published JSON schemas, io/schema/*.json, as they were when the program was built.
std::string_view project_schema();
std::string_view edit_schema();

}  // namespace focalstage
