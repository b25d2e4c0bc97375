#include "io/assets/gltf_members.h"

#include "io/assets/mesh_file.h"

namespace focalstage {
namespace {

using Json = MemberChecker::Json;

constexpr std::size_t most_items = 65536;  ///< of one list

bool is_index(const Json& value) { return value.is_number_unsigned() && value.get<std::uint64_t>() <= 0x7FFFFFFFu; }

template <class Test>
bool all(const Json& value, Test&& test) {
  for (const Json& item : value) {
    if (!test(item)) return false;
  }
  return true;
}

bool is_index_map(const Json& value) { return value.is_object() && all(value, is_index); }

bool is_numbers(const Json& value) {
  return value.is_array() && all(value, [](const Json& n) { return n.is_number(); });
}

bool is_a(const Json& value, MemberKind kind) {
  switch (kind) {
    case MemberKind::index:
    case MemberKind::size:
      return is_index(value);
    case MemberKind::number:
      return value.is_number();
    case MemberKind::boolean:
      return value.is_boolean();
    case MemberKind::text:
      return value.is_string();
    case MemberKind::object:
      return value.is_object();
    case MemberKind::indices:
      return value.is_array() && all(value, is_index);
    case MemberKind::numbers:
      return is_numbers(value);
    case MemberKind::pair:
      return is_numbers(value) && value.size() == 2;
    case MemberKind::texts:
      return value.is_array() && all(value, [](const Json& t) { return t.is_string(); });
    case MemberKind::objects:
      return value.is_array() && all(value, [](const Json& o) { return o.is_object(); });
    case MemberKind::index_map:
      return is_index_map(value);
    case MemberKind::index_maps:
      return value.is_array() && all(value, is_index_map);
  }
  return false;
}

}  // namespace

void MemberChecker::invalid(const std::string& at, const std::string& what) {
  if (ok()) fault_ = invalid_asset(path_ + ": " + at, what);
}

void MemberChecker::unsupported(const std::string& at, const std::string& what, const std::string& remedy) {
  if (ok()) fault_ = unsupported_asset(path_ + ": " + at, what, remedy);
}

const Json* MemberChecker::find(const Json& object, const char* name) {
  const auto found = object.find(name);
  return found == object.end() ? nullptr : &*found;
}

void MemberChecker::members(const Json& object, const std::string& at, Members expected) {
  for (const Member& member : expected) {
    const Json* value = find(object, member.name);
    if (value == nullptr && member.required) return invalid(at + "/" + member.name, "this member is missing");
    if (value != nullptr && !is_a(*value, member.kind)) {
      return invalid(at + "/" + member.name, "this member is not of glTF's type");
    }
  }
}

const Json* MemberChecker::inner(const Json& object, const std::string& at, const char* name, Members expected) {
  const Json* value = ok() ? find(object, name) : nullptr;
  if (value == nullptr) return nullptr;
  members(object, at, {{name, MemberKind::object}});
  if (ok()) members(*value, at + "/" + name, expected);
  return ok() ? value : nullptr;
}

const Json* MemberChecker::extension(const Json& object, const std::string& at, const char* name, Members expected) {
  const Json* extensions = inner(object, at, "extensions", {});
  return extensions == nullptr ? nullptr : inner(*extensions, at + "/extensions", name, expected);
}

void MemberChecker::each(const Json& parent, const std::string& at, const char* list, Members expected) {
  each(parent, at, list, expected, [](const Json&, const std::string&) {});
}

const Json* MemberChecker::list_of(const Json& parent, const std::string& at, const char* list) {
  if (ok()) members(parent, at, {{list, MemberKind::objects}});
  const Json* items = ok() ? find(parent, list) : nullptr;
  if (items != nullptr && items->size() > most_items) invalid(at + "/" + list, "more than 65536 items");
  return ok() ? items : nullptr;
}

}  // namespace focalstage
