#include "core/scene/fields.h"

namespace focalstage {

void keep_unknown(Reading& reading, const Value& object, const std::vector<std::string_view>& known,
                  Value::Object& unknown) {
  unknown.clear();
  for (const auto& [key, value] : *object.object()) {
    if (std::find(known.begin(), known.end(), key) != known.end()) continue;
    reading.note_unknown(key);
    unknown.emplace_back(key, value);
  }
}

void write_unknown(Value::Object& object, const Value::Object& unknown) {
  object.insert(object.end(), unknown.begin(), unknown.end());
}

}  // namespace focalstage
