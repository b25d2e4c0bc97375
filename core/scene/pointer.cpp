#include "core/scene/pointer.h"

#include <charconv>

namespace focalstage {

std::string pointer_into(std::string_view where, std::string_view step) {
  std::string deeper(where);
  deeper += '/';
  for (const char c : step) {
    if (c == '~') {
      deeper += "~0";
    } else if (c == '/') {
      deeper += "~1";
    } else {
      deeper += c;
    }
  }
  return deeper;
}

std::string pointer_into(std::string_view where, std::size_t index) {
  return pointer_into(where, std::to_string(index));
}

std::vector<std::string> pointer_steps(std::string_view pointer) {
  std::vector<std::string> steps;
  if (pointer.empty()) return steps;
  if (pointer.front() == '/') pointer.remove_prefix(1);
  steps.emplace_back();
  for (std::size_t i = 0; i < pointer.size(); ++i) {
    const char c = pointer[i];
    if (c == '/') {
      steps.emplace_back();
    } else if (c == '~' && i + 1 < pointer.size() && (pointer[i + 1] == '0' || pointer[i + 1] == '1')) {
      steps.back() += pointer[++i] == '0' ? '~' : '/';
    } else {
      steps.back() += c;
    }
  }
  return steps;
}

std::optional<std::size_t> index_in(std::string_view step) {
  if (step.empty() || (step.size() > 1 && step.front() == '0')) return std::nullopt;
  std::size_t index = 0;
  const auto [end, error] = std::from_chars(step.data(), step.data() + step.size(), index);
  if (error != std::errc() || end != step.data() + step.size()) return std::nullopt;
  return index;
}

const Value* value_at(const Value& root, const std::vector<std::string>& steps) {
  const Value* here = &root;
  for (const std::string& step : steps) {
    if (const Value::Array* items = here->array()) {
      const auto index = index_in(step);
      if (!index || *index >= items->size()) return nullptr;
      here = &(*items)[*index];
    } else {
      here = here->find(step);
      if (!here) return nullptr;
    }
  }
  return here;
}

}  // namespace focalstage
