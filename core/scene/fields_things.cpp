#include "core/scene/fields_things.h"

#include <algorithm>

namespace focalstage {

namespace {

/// Reads the look that stands under `key`, if it is there.
template <class Look, class Read>
bool read_look(Reading& reading, const Value& value, std::string_view key, Appearance& out, Read&& read) {
  const Value* there = value.find(key);
  if (!there) return true;
  const Reading::Step step(reading, key);
  return read(*there, out.emplace<Look>());
}

bool read_looks(Reading& reading, const Value& value, Appearance& out) {
  const auto unlit = [&](const Value& there, UnlitAppearance& look) {
    return Codec<glm::dvec3>::read(reading, there, look.color, fraction);
  };
  const auto checker = [&](const Value& there, CheckerAppearance& look) {
    return Codec<CheckerAppearance>::read(reading, there, look, {});
  };
  const auto image = [&](const Value& there, ImageAppearance& look) {
    return Codec<ImageAppearance>::read(reading, there, look, {});
  };
  return read_look<UnlitAppearance>(reading, value, "unlit", out, unlit) &&
         read_look<CheckerAppearance>(reading, value, "checker", out, checker) &&
         read_look<ImageAppearance>(reading, value, "image", out, image);
}

}  // namespace

bool AppearanceCodec::read(Reading& reading, const Value& value, Object& out, const Rule&) {
  if (!value.object()) return reading.wrong_type(value, "an object");
  const auto both = [&](std::string_view one, std::string_view other) {
    return value.find(one) != nullptr && value.find(other) != nullptr;
  };
  if (both("unlit", "checker")) {
    return reading.fail("project.conflict", "is both unlit and a checker", "remove one of the two");
  }
  if (both("unlit", "image") || both("checker", "image")) {
    return reading.fail("project.conflict", "is an image and something else", "remove one of the two");
  }
  out.appearance = MaterialAppearance{};
  if (!read_looks(reading, value, out.appearance)) return false;
  keep_unknown(reading, value, {"unlit", "checker", "image"}, out.appearance_unknown);
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
  if (const auto* image = std::get_if<ImageAppearance>(&object.appearance)) {
    written.emplace_back("image", Codec<ImageAppearance>::write(*image));
  }
  write_unknown(written, object.appearance_unknown);
  return Value(std::move(written));
}

void AppearanceCodec::keys(KeyList& list) {
  list.add("unlit", [](KeyList&) {});
  list.add("checker", [](KeyList& below) { list_fields<CheckerAppearance>(below); });
  list.add("image", [](KeyList& below) { list_fields<ImageAppearance>(below); });
}

bool Codec<Albedo>::read(Reading& reading, const Value& value, Albedo& out, const Rule& rule) {
  if (value.text()) {
    out = MaterialAlbedo{};
    return *value.text() == "material" || not_one_of(reading, *value.text(), {"material"});
  }
  if (value.object()) return Codec<FileAlbedo>::read(reading, value, out.emplace<FileAlbedo>(), rule);
  if (!value.array()) return reading.wrong_type(value, "a colour, {\"file\": ..} or \"material\"");
  return Codec<glm::dvec3>::read(reading, value, out.emplace<PlainAlbedo>().color, rule);
}

Value Codec<Albedo>::write(const Albedo& albedo) {
  if (const auto* plain = std::get_if<PlainAlbedo>(&albedo)) return Codec<glm::dvec3>::write(plain->color);
  if (const auto* file = std::get_if<FileAlbedo>(&albedo)) return Codec<FileAlbedo>::write(*file);
  return Value("material");
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
