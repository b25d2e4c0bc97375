// What is done to a mesh after it was read: a row for each step with its settings, and one to add another.
#include <algorithm>
#include <array>

#include "core/scene/alternatives.h"
#include "core/scene/process_codec.h"
#include "editor/session/edits.h"
#include "editor/session/property_rows.h"

namespace focalstage {
namespace {

struct StepWords {
  const char* choice;  ///< its name; decimation is two of them
  const char* label;
  const char* help;
};

constexpr std::array<StepWords, 12> step_words{{
    {"weld", "weld", "Vertices this near to each other come together."},
    {"clean", "clean", "Triangles without area, and doubles, go."},
    {"drop-fins", "drop fins", "Sheets that hang on an edge of others go."},
    {"drop-bits", "drop bits", "Loose bits go that are small against the largest one."},
    {"fix-winding", "fix winding", "Neighbours face alike, closed bodies outwards."},
    {"flip", "flip", "The back becomes the front."},
    {"fill-holes", "fill holes", "Closes what is a hole by its shape, or every border up to a length."},
    {"keep-part", "keep a part", "Only one of the parts between folds; the largest is 0."},
    {"decimate", "decimate to a count", "So many triangles are left; borders stay."},
    {"decimate by error", "decimate by error", "As few triangles as this far off allows; borders stay."},
    {"smooth", "smooth", "Noise goes, sharp edges stay."},
    {"subdivide", "subdivide", "Several triangles of each, and rounder."},
}};

struct SettingWords {
  const char* key;
  const char* label;
  NumberLook look;
};

constexpr std::array<SettingWords, 9> setting_words{{
    {"tolerance_mm", "tolerance", {"mm", 3, 0.005}},
    {"least_share", "least share", {"", 3, 0.001}},
    {"longest_mm", "longest around", {"mm", 1, 1.0}},
    {"part", "part", {}},
    {"fold_deg", "fold", {"°", 1, 0.5}},
    {"triangles", "triangles", {"", 0, 100.0}},
    {"error_mm", "error", {"mm", 3, 0.005}},
    {"rounds", "rounds", {}},
    {"feature_deg", "edges from", {"°", 1, 0.5}},
}};

std::string choice_of(const Value& step) {
  const Value* name = step.find("step");
  if (!name || !name->text()) return "";
  return step.find("error_mm") ? *name->text() + " by error" : *name->text();
}

/// A step as it begins.
Value fresh_step(const PropertyScope& scope, const Thing& thing, const std::string& choice) {
  if (choice == "decimate by error") return Value(Value::Object{{"step", "decimate"}, {"error_mm", 0.1}});
  Value step(Value::Object{{"step", choice}});
  if (choice == "decimate") {
    const std::vector<Drawable>* drawables = drawables_of(scope, thing);
    step.set("triangles",
             static_cast<double>(drawables ? std::max<std::size_t>(1, triangles_of(*drawables) / 2) : 1000));
  }
  return step;
}

std::vector<Edit> set_step(const PropertyScope& scope, const Thing& thing, const Property& row, const Value& value) {
  if (!value.text()) return {set_edit(thing, row.key, Value())};
  return {set_edit(thing, row.key, fresh_step(scope, thing, *value.text()))};
}

Property& step_row(PropertyRows& rows, std::size_t index, const std::string& choice) {
  std::vector<PropertyChoice> choices;
  for (const StepWords& words : step_words) choices.push_back({Value(words.choice), words.label});
  const std::string number = std::to_string(index);
  Property& row = rows.choice("step " + std::to_string(index + 1), "mesh/process/" + number, std::move(choices));
  row.value = choice.empty() ? Value() : Value(choice);
  row.edits = set_step;
  return row;
}

void add_scheme_row(PropertyRows& rows, const std::string& key) {
  std::vector<PropertyChoice> choices;
  for (const auto& [word, scheme] : SubdivisionWords::words) choices.push_back({Value(word), std::string(word)});
  Property& row = rows.choice("scheme", key, std::move(choices));
  if (row.value.is_null()) row.value = Value(SubdivisionWords::words.front().first);
}

template <class Kind>
void add_settings(PropertyRows& rows, std::size_t index, const Value& step) {
  const std::string place = "mesh/process/" + std::to_string(index) + "/";
  each_field<Kind>([&](const auto& field) {
    const std::string key(field.key);
    if (std::is_same_v<Kind, DecimateStep> && !step.find(key)) return;
    const auto words = std::ranges::find(setting_words, key, &SettingWords::key);
    if (words == setting_words.end()) {
      add_scheme_row(rows, place + key);
    } else {
      Property& row = rows.number<Kind>(words->label, place + key, words->look);
      if (std::is_same_v<Kind, DecimateStep>) row.removable = false;
    }
    rows.last().id = "step " + std::to_string(index + 1) + " " + rows.last().label;
    rows.last().label = "    " + rows.last().label;
  });
}

}  // namespace

void add_process_rows(PropertyRows& rows) {
  rows.group("Processing");
  std::size_t count = 0;
  if (const Value::Array* steps = rows.at("mesh/process").array()) {
    count = steps->size();
    for (std::size_t i = 0; i < count; ++i) {
      const Value& step = (*steps)[i];
      const std::string choice = choice_of(step);
      Property& row = step_row(rows, i, choice);
      row.removable = true;
      const auto words = std::ranges::find(step_words, choice, &StepWords::choice);
      if (words != step_words.end()) row.help = words->help;
      each_alternative<ProcessKind>([&](const auto& kind) {
        using Kind = std::remove_cvref_t<decltype(kind)>;
        if (*step.find("step")->text() == Table<Kind>::step) add_settings<Kind>(rows, i, step);
      });
    }
  }
  step_row(rows, count, "").help = "What is done to the mesh after it was read; the file stays as it is.";
}

}  // namespace focalstage
