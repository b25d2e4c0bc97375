#include "core/scene/mesh_codec.h"

#include <type_traits>

#include "core/scene/alternatives.h"
#include "core/scene/process_codec.h"

namespace focalstage {
namespace {

constexpr auto word_of = []<class Shape>(const Shape&) { return Table<Shape>::primitive; };

/// The shape that `value` names, fresh; nothing where the name is unknown.
std::optional<MeshShape> named_shape(const Value& value) {
  if (value.find("file")) return FileMesh{};
  const Value* primitive = value.find("primitive");
  if (!primitive || !primitive->text()) return std::nullopt;
  return alternative_named<MeshShape>(*primitive->text(), word_of);
}

bool no_shape(Reading& reading, const Value& value) {
  const Value* primitive = value.find("primitive");
  if (!primitive) {
    return reading.fail("project.missing", "names no mesh", "add \"file\" or \"primitive\" to it");
  }
  const Reading::Step step(reading, "primitive");
  if (!primitive->text()) return reading.wrong_type(*primitive, "text");
  return not_one_of(reading, *primitive->text(), alternative_words<MeshShape>(word_of));
}

}  // namespace

bool Codec<MeshSource>::read(Reading& reading, const Value& value, MeshSource& out, const Rule&) {
  if (!value.object()) return reading.wrong_type(value, "an object");
  if (value.find("file") && value.find("primitive")) {
    return reading.fail("project.conflict", "names both a file and a primitive", "remove one of the two");
  }
  const std::optional<MeshShape> shape = named_shape(value);
  if (!shape) return no_shape(reading, value);
  out = MeshSource{};
  out.shape = *shape;
  std::vector<std::string_view> known{"primitive", "process"};
  if (!std::visit([&](auto& s) { return read_fields(reading, value, s, known); }, out.shape)) return false;
  const Value* process = value.find("process");
  if (process) {
    const Reading::Step list(reading, "process");
    if (!Codec<std::vector<ProcessStep>>::read(reading, *process, out.process, {.most = 1000})) return false;
  }
  keep_unknown(reading, value, known, out.unknown);
  return true;
}

Value Codec<MeshSource>::write(const MeshSource& mesh) {
  Value::Object object;
  std::visit(
      [&](const auto& shape) {
        constexpr std::string_view word = Table<std::remove_cvref_t<decltype(shape)>>::primitive;
        if (!word.empty()) object.emplace_back("primitive", Value(word));
        write_fields(object, shape);
      },
      mesh.shape);
  if (!mesh.process.empty()) object.emplace_back("process", Codec<std::vector<ProcessStep>>::write(mesh.process));
  write_unknown(object, mesh.unknown);
  return Value(std::move(object));
}

void Codec<MeshSource>::keys(KeyList& list) {
  list.add("primitive", [](KeyList&) {});
  each_alternative<MeshShape>([&](const auto& shape) { list_fields<std::remove_cvref_t<decltype(shape)>>(list); });
  list.add("process", [](KeyList& process) { process.each([](KeyList& item) { Codec<ProcessStep>::keys(item); }); });
}

std::vector<std::string_view> shape_keys(const Value& value) {
  std::vector<std::string_view> keys{"file", "primitive"};
  if (const auto shape = named_shape(value)) {
    const auto own = keys_of_alternative(*shape);
    keys.insert(keys.end(), own.begin(), own.end());
  }
  return keys;
}

}  // namespace focalstage
