#include "core/scene/fields_placement.h"

namespace focalstage {

bool PlacementKeysCodec::read(Reading& reading, const Value& value, Placement& out, const Rule& rule) {
  if (!is_list(reading, value, rule)) return false;
  out.keys.clear();
  for (const Value& item : *value.array()) {
    const Reading::Step step(reading, out.keys.size());
    Keyframe key;
    key.pose = out.pose;
    if (!Codec<Keyframe>::read(reading, item, key, rule)) return false;
    if (!out.keys.empty() && key.time_s <= out.keys.back().time_s) {
      return reading.fail_at("time_s", "project.order", "is not later than the key before",
                             "sort the keys by time_s, each time once");
    }
    out.keys.push_back(std::move(key));
  }
  return true;
}

}  // namespace focalstage
