#include "core/scene/fields_things.h"

#include <algorithm>

namespace focalstage {

bool AppearanceCodec::read(Reading& reading, const Value& value, Object& out, const Rule&) {
  if (!value.object()) return reading.wrong_type(value, "an object");
  const Value* unlit = value.find("unlit");
  const Value* checker = value.find("checker");
  if (unlit && checker) {
    return reading.fail("project.conflict", "is both unlit and a checker", "remove one of the two");
  }
  out.appearance = MaterialAppearance{};
  if (unlit) {
    const Reading::Step step(reading, "unlit");
    if (!Codec<glm::dvec3>::read(reading, *unlit, out.appearance.emplace<UnlitAppearance>().color, fraction)) {
      return false;
    }
  }
  if (checker) {
    const Reading::Step step(reading, "checker");
    auto& squares = out.appearance.emplace<CheckerAppearance>();
    if (!Codec<CheckerAppearance>::read(reading, *checker, squares, {})) return false;
  }
  keep_unknown(reading, value, {"unlit", "checker"}, out.appearance_unknown);
  return true;
}

Value AppearanceCodec::write(const Object& object) {
  Value::Object written;
  if (const auto* unlit = std::get_if<UnlitAppearance>(&object.appearance)) {
    written.emplace_back("unlit", Codec<glm::dvec3>::write(unlit->color));
  }
  if (const auto* checker = std::get_if<CheckerAppearance>(&object.appearance)) {
    written.emplace_back("checker", Codec<CheckerAppearance>::write(*checker));
  }
  write_unknown(written, object.appearance_unknown);
  return Value(std::move(written));
}

void AppearanceCodec::keys(KeyList& list) {
  list.add("unlit", [](KeyList&) {});
  list.add("checker", [](KeyList& below) { list_fields<CheckerAppearance>(below); });
}

bool Table<Light>::check(Reading& reading, const Light& light) {
  if (light.kind != LightKind::sun || light.direction != glm::dvec3(0.0)) return true;
  return reading.fail_at("direction", "project.range", "has no length", "say which way the light travels");
}

void name_lights(std::vector<Light>& lights) {
  for (std::size_t i = 0; i < lights.size(); ++i) {
    if (!lights[i].name.empty()) continue;
    std::size_t number = i + 1;
    std::string name;
    do {
      name = "light " + std::to_string(number++);
    } while (std::any_of(lights.begin(), lights.end(), [&](const Light& light) { return light.name == name; }));
    lights[i].name = std::move(name);
  }
}

}  // namespace focalstage
