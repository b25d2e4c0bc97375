#include <array>

#include "core/scene/codec.h"
#include "core/scene/edit.h"

// Edits as the objects of their JSON lines.
namespace focalstage {
namespace {

struct KindWords {
  static constexpr std::array<std::pair<std::string_view, Edit::Kind>, 6> words{{{"set", Edit::Kind::set},
                                                                                 {"add", Edit::Kind::add},
                                                                                 {"remove", Edit::Kind::remove},
                                                                                 {"rename", Edit::Kind::rename},
                                                                                 {"move", Edit::Kind::move},
                                                                                 {"group", Edit::Kind::group}}};
};

}  // namespace

Value value_from(const Edit& edit) {
  Value::Object object{{"edit", WordCodec<Edit::Kind, KindWords>::write(edit.kind)}, {"list", Value(edit.list)}};
  if (!edit.name.empty()) object.emplace_back("name", Value(edit.name));
  if (!edit.key.empty()) object.emplace_back("key", Value(edit.key));
  if (edit.kind != Edit::Kind::remove) object.emplace_back("value", edit.value);
  return Value(std::move(object));
}

Result<Edit> edit_from(const Value& value) {
  Reading reading(nullptr);
  const auto bad = [&] {
    Fault fault = *reading.fault();
    fault.code = "edit.shape";
    return fault;
  };
  Edit edit;
  if (!value.object()) {
    reading.wrong_type(value, "an object");
    return bad();
  }
  if (!value.find("edit")) {
    reading.fail_at("edit", "", "is missing", "name the kind of edit: set, add, remove, rename, move or group");
    return bad();
  }
  for (const auto& [key, member] : *value.object()) {
    const Reading::Step step(reading, key);
    if (key == "edit") {
      WordCodec<Edit::Kind, KindWords>::read(reading, member, edit.kind, {});
    } else if (key == "list") {
      Codec<std::string>::read(reading, member, edit.list, {});
    } else if (key == "name") {
      Codec<std::string>::read(reading, member, edit.name, {});
    } else if (key == "key") {
      Codec<std::string>::read(reading, member, edit.key, {});
    } else if (key == "value") {
      edit.value = member;
    } else {
      reading.fail("", "is no member of an edit", "use edit, list, name, key and value");
    }
    if (reading.fault()) return bad();
  }
  return edit;
}

}  // namespace focalstage
