#include "core/scene/edits_between.h"

#include "core/scene/project_value.h"

namespace focalstage {

std::vector<Edit> edits_between(const Project& from, const Project& to) {
  const Value before = value_from(from), after = value_from(to);
  std::vector<Edit> edits;
  for (const auto& [key, value] : *after.object()) {
    const Value* old = before.find(key);
    if (!old || *old != value) edits.push_back({Edit::Kind::set, "", "", key, value});
  }
  for (const auto& [key, value] : *before.object()) {
    if (!after.find(key)) edits.push_back({Edit::Kind::set, "", "", key, Value()});
  }
  return edits;
}

}  // namespace focalstage
