#include "core/scene/reading.h"

namespace focalstage {

bool Reading::fail(std::string code, std::string message, std::string remedy) {
  if (!fault_) fault_ = Fault{std::move(code), where_, std::move(message), std::move(remedy)};
  return false;
}

bool Reading::fail_at(std::string_view key, std::string code, std::string message, std::string remedy) {
  const Step step(*this, key);
  return fail(std::move(code), std::move(message), std::move(remedy));
}

bool Reading::wrong_type(const Value& value, std::string_view expected) {
  const std::string wanted(expected);
  return fail("project.type", "must be " + wanted + ", but is " + std::string(type_word(value)),
              "write " + wanted + " here");
}

void Reading::note_unknown(std::string_view key) {
  if (!notes_) return;
  notes_->push_back({Severity::info,
                     "project.unknown-key",
                     pointer_into(where_, key),
                     "\"" + std::string(key) + "\" is not a key this version knows; it is kept, and has no effect",
                     std::nullopt,
                     {}});
}

std::string_view type_word(const Value& value) {
  if (value.boolean()) return "true or false";
  if (value.number()) return "a number";
  if (value.text()) return "text";
  if (value.array()) return "a list";
  if (value.object()) return "an object";
  return "null";
}

}  // namespace focalstage
