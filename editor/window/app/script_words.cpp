#include "editor/window/app/script_words.h"

#include <charconv>

namespace focalstage {

void ScriptWords::skip_blanks() {
  while (!rest_.empty() && (rest_.front() == ' ' || rest_.front() == '\t')) rest_.remove_prefix(1);
}

std::string ScriptWords::take() {
  std::string word;
  if (next_is_quoted()) {
    rest_.remove_prefix(1);
    while (!rest_.empty() && rest_.front() != '"') {
      if (rest_.front() == '\\' && rest_.size() > 1) rest_.remove_prefix(1);
      word += rest_.front();
      rest_.remove_prefix(1);
    }
    if (!rest_.empty()) rest_.remove_prefix(1);
  } else {
    while (!rest_.empty() && rest_.front() != ' ' && rest_.front() != '\t') {
      word += rest_.front();
      rest_.remove_prefix(1);
    }
  }
  skip_blanks();
  return word;
}

std::string ScriptWords::peek() const {
  ScriptWords copy = *this;
  return copy.take();
}

bool ScriptWords::take_if(std::string_view word) {
  if (next_is_quoted() || peek() != word) return false;
  take();
  return true;
}

std::optional<double> ScriptWords::take_number() {
  if (next_is_quoted()) return std::nullopt;
  const std::string word = peek();
  double number = 0.0;
  const auto [end, problem] = std::from_chars(word.data(), word.data() + word.size(), number);
  if (word.empty() || problem != std::errc{} || end != word.data() + word.size()) return std::nullopt;
  take();
  return number;
}

std::string ScriptWords::take_rest() {
  std::string all(rest_);
  while (!all.empty() && (all.back() == ' ' || all.back() == '\t' || all.back() == '\r')) all.pop_back();
  rest_ = {};
  return all;
}

}  // namespace focalstage
