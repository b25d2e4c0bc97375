#include "editor/session/property_rows.h"

#include <algorithm>
#include <cmath>

#include "core/base/number_words.h"

namespace focalstage {
namespace {

const Value nothing;

/// The one of a fresh vector's components that the key ends in, or the value itself.
Value component(const Value& fresh, const std::string& key) {
  const Value::Array* items = fresh.array();
  const auto index = index_in(pointer_steps(key).back());
  if (!items || !index) return fresh;
  return *index < items->size() ? (*items)[*index] : Value();
}

}  // namespace

PropertyRows::PropertyRows(const PropertyScope& scope, Thing thing, Value item)
    : scope_(scope), thing_(std::move(thing)), item_(std::move(item)) {}

const Value& PropertyRows::at(std::string_view key) const {
  const Value* found = value_at(item_, pointer_steps(key));
  return found ? *found : nothing;
}

std::string PropertyRows::last_name(std::string_view key) {
  const std::vector<std::string> steps = pointer_steps(key);
  for (auto step = steps.rbegin(); step != steps.rend(); ++step) {
    if (!index_in(*step)) return *step;
  }
  return {};
}

void PropertyRows::group(std::string title) { groups_.push_back({std::move(title), {}}); }

Property& PropertyRows::add(Property::Kind kind, std::string label, Value value) {
  Property row;
  row.id = label;
  row.label = std::move(label);
  row.kind = kind;
  row.value = std::move(value);
  groups_.back().rows.push_back(std::move(row));
  return groups_.back().rows.back();
}

Property& PropertyRows::number_with(const KeyFacts& facts, std::string label, std::string key, const NumberLook& look) {
  const Value& there = at(key);
  const Value fresh = component(facts.fresh, key);
  Property& row = add(facts.whole ? Property::Kind::integer : Property::Kind::number, std::move(label),
                      there.number() ? there : fresh);
  row.unit = look.unit;
  row.digits = facts.whole ? 0 : look.digits;
  row.step = look.step;
  row.least = facts.above_least ? facts.least + std::pow(10.0, -look.digits) : facts.least;
  row.most = facts.most;
  row.removable = fresh.is_null();
  row.key = std::move(key);
  return row;
}

Property& PropertyRows::text(std::string label, std::string key) {
  const Value& there = at(key);
  Property& row = add(Property::Kind::text, std::move(label), there.text() ? there : Value(""));
  row.key = std::move(key);
  return row;
}

Property& PropertyRows::flag(std::string label, std::string key) {
  const Value& there = at(key);
  Property& row = add(Property::Kind::flag, std::move(label), there.boolean() ? there : Value(false));
  row.key = std::move(key);
  return row;
}

Property& PropertyRows::choice(std::string label, std::string key, std::vector<PropertyChoice> choices) {
  Property& row = add(Property::Kind::choice, std::move(label), at(key));
  row.key = std::move(key);
  row.choices = std::move(choices);
  return row;
}

Property& PropertyRows::colour(std::string label, std::string key, const Value& fresh) {
  const Value& there = at(key);
  Property& row = add(Property::Kind::colour, std::move(label), there.array() ? there : fresh);
  row.key = std::move(key);
  return row;
}

Property& PropertyRows::shown(std::string label, std::string value) {
  return add(Property::Kind::shown, std::move(label), Value(std::move(value)));
}

Property& PropertyRows::action(std::string label, std::string command, Value args) {
  Property& row = add(Property::Kind::action, std::move(label), {});
  row.command = std::move(command);
  row.args = std::move(args);
  return row;
}

std::string capitalised(std::string_view word) {
  std::string text(word);
  if (!text.empty() && text[0] >= 'a' && text[0] <= 'z') text[0] = static_cast<char>(text[0] - 'a' + 'A');
  return text;
}

std::string grouped_text(std::size_t number) {
  const std::string digits = std::to_string(number);
  std::string text;
  for (std::size_t i = 0; i < digits.size(); ++i) {
    if (i > 0 && (digits.size() - i) % 3 == 0) text += "\u00a0";
    text += digits[i];
  }
  return text;
}

std::string distance_text(double vergence_d) {
  if (vergence_d < 0.0005) return vergence_d < -0.0005 ? "beyond \u221e" : "\u221e";
  const double distance_m = 1.0 / vergence_d;
  return fixed_text(distance_m, distance_m < 10.0 ? 2 : 1) + " m";
}

std::string dioptre_text(double dioptres) { return fixed_text(dioptres, 2) + " D"; }

std::string per_eye_text(std::size_t left, std::size_t right) {
  if (left == right) return std::to_string(left);
  return std::to_string(left) + " left, " + std::to_string(right) + " right";
}

const std::vector<Drawable>* drawables_of(const PropertyScope& scope, const Thing& thing) {
  if (!scope.stage) return nullptr;
  const auto in = [&](const auto& staged) -> const std::vector<Drawable>* {
    const auto at = std::find_if(staged.begin(), staged.end(), [&](const auto& one) { return one.name == thing.name; });
    return at == staged.end() ? nullptr : &at->drawables;
  };
  if (thing.list == "objects") return in(scope.stage->objects);
  if (thing.list == "surfaces") return in(scope.stage->surfaces);
  return nullptr;
}

std::size_t triangles_of(const std::vector<Drawable>& drawables) {
  std::size_t count = 0;
  for (const Drawable& drawable : drawables) count += drawable.mesh ? drawable.mesh->triangles.size() : 0;
  return count;
}

}  // namespace focalstage
