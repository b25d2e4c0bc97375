#include "core/scene/value.h"

#include <algorithm>

namespace focalstage {

const Value* Value::find(std::string_view key) const {
  const Object* members = object();
  if (!members) return nullptr;
  const auto found = std::find_if(members->begin(), members->end(), [&](const Member& m) { return m.first == key; });
  return found == members->end() ? nullptr : &found->second;
}

Value* Value::find(std::string_view key) { return const_cast<Value*>(std::as_const(*this).find(key)); }

void Value::set(std::string_view key, Value value) {
  if (is_null()) data_ = Object{};
  if (Value* member = find(key)) {
    *member = std::move(value);
  } else if (Object* members = object()) {
    members->emplace_back(std::string(key), std::move(value));
  }
}

void Value::erase(std::string_view key) {
  if (Object* members = object()) std::erase_if(*members, [&](const Member& m) { return m.first == key; });
}

}  // namespace focalstage
