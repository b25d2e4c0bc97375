#include "core/scene/process_codec.h"

#include <type_traits>

#include "core/scene/alternatives.h"

namespace focalstage {
namespace {

constexpr auto word_of = []<class Kind>(const Kind&) { return Table<Kind>::step; };

std::optional<ProcessKind> named_kind(const Value& value) {
  const Value* name = value.find("step");
  if (!name || !name->text()) return std::nullopt;
  return alternative_named<ProcessKind>(*name->text(), word_of);
}

bool no_kind(Reading& reading, const Value& value) {
  const Value* name = value.find("step");
  if (!name || !name->text()) {
    return reading.fail_at("step", "project.missing", "is no name of a step", "name the step: {\"step\": ..}");
  }
  const Reading::Step step(reading, "step");
  return not_one_of(reading, *name->text(), alternative_words<ProcessKind>(word_of));
}

}  // namespace

bool Table<DecimateStep>::check(Reading& reading, const DecimateStep& step) {
  if (step.triangles && step.error_mm) {
    return reading.fail("project.conflict", "says both how many triangles are to be left and how far off they may be",
                        "remove one of the two");
  }
  if (step.triangles || step.error_mm) return true;
  return reading.fail("project.missing", "\"triangles\" and \"error_mm\" are missing", "add one of the two");
}

bool Codec<ProcessStep>::read(Reading& reading, const Value& value, ProcessStep& out, const Rule&) {
  if (!value.object()) return reading.wrong_type(value, "an object");
  const std::optional<ProcessKind> kind = named_kind(value);
  if (!kind) return no_kind(reading, value);
  out = ProcessStep{*kind, {}};
  std::vector<std::string_view> known{"step"};
  if (!std::visit([&](auto& k) { return read_fields(reading, value, k, known); }, out.kind)) return false;
  keep_unknown(reading, value, known, out.unknown);
  return true;
}

Value Codec<ProcessStep>::write(const ProcessStep& step) {
  Value::Object object;
  object.emplace_back("step", Value(name_of(step.kind)));
  std::visit([&](const auto& kind) { write_fields(object, kind); }, step.kind);
  write_unknown(object, step.unknown);
  return Value(std::move(object));
}

void Codec<ProcessStep>::keys(KeyList& list) {
  list.add("step", [](KeyList&) {});
  each_alternative<ProcessKind>([&](const auto& kind) { list_fields<std::remove_cvref_t<decltype(kind)>>(list); });
}

std::string_view name_of(const ProcessKind& step) { return std::visit(word_of, step); }

std::vector<std::string_view> step_keys(const Value& value) {
  const auto named = named_kind(value);
  return named ? keys_of_alternative(*named) : std::vector<std::string_view>();
}

}  // namespace focalstage
