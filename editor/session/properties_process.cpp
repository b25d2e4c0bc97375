// What is done to a mesh after it was read: a row for each step with its settings, and one to add another.
#include <algorithm>
#include <array>

#include "core/scene/alternatives.h"
#include "core/scene/process_codec.h"
#include "core/stage/texture_maps.h"
#include "editor/session/angles.h"
#include "editor/session/edits.h"
#include "editor/session/property_rows.h"

namespace focalstage {
namespace {

struct StepWords {
  const char* choice;  ///< its name; decimation is two of them
  const char* label;
  const char* help;
};

constexpr std::array<StepWords, 15> step_words{{
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
    {"uv-plane", "UV by a fitted plane", "A picture goes straight through, from border to border of each mesh."},
    {"uv-plane of a size", "UV by a plane",
     "A picture of a size, standing where its place says, goes straight through."},
    {"uv-projector", "UV by the projector", "The picture lies where the projector threw it when the step was made."},
}};

struct SettingWords {
  const char* key;
  const char* label;
  NumberLook look;
};

constexpr std::array<SettingWords, 15> setting_words{{
    {"tolerance_mm", "tolerance", {"mm", 3, 0.005}},
    {"least_share", "least share", {"", 3, 0.001}},
    {"longest_mm", "longest around", {"mm", 1, 1.0}},
    {"part", "part", {}},
    {"fold_deg", "fold", {"°", 1, 0.5}},
    {"triangles", "triangles", {"", 0, 100.0}},
    {"error_mm", "error", {"mm", 3, 0.005}},
    {"rounds", "rounds", {}},
    {"feature_deg", "edges from", {"°", 1, 0.5}},
    {"width_px", "columns", {}},
    {"height_px", "rows", {}},
    {"fx_px", "focal length x", {"px", 1, 0.5}},
    {"fy_px", "focal length y", {"px", 1, 0.5}},
    {"cx_px", "centre x", {"px", 1, 0.5}},
    {"cy_px", "centre y", {"px", 1, 0.5}},
}};

std::string choice_of(const Value& step) {
  const Value* name = step.find("step");
  if (!name || !name->text()) return "";
  if (step.find("error_mm")) return *name->text() + " by error";
  return step.find("size_m") ? *name->text() + " of a size" : *name->text();
}

/// A picture before all of the thing, or a metre wide.
Value fresh_plane(const PropertyScope& scope, const Thing& thing) {
  UvPlaneStep step{{}, glm::dvec2(1.0)};
  if (const std::vector<Drawable>* drawables = drawables_of(scope, thing)) {
    const glm::dvec3 seen_from_m = pose_at(scope.project.viewer.placement, scope.time_s).position_m;
    step = facing_plane(*drawables, pose_of(scope.project, thing, scope.time_s), seen_from_m);
    if (!step.size_m) step.size_m = glm::dvec2(1.0);
  }
  return Codec<ProcessStep>::write({step, {}});
}

/// A step as it begins.
Value fresh_step(const PropertyScope& scope, const Thing& thing, const std::string& choice) {
  if (choice == "uv-plane of a size") return fresh_plane(scope, thing);
  if (choice == "uv-projector" && !scope.project.projectors.empty()) {
    const UvProjectorStep step =
        thrown_by(scope.project.projectors.front(), pose_of(scope.project, thing, scope.time_s));
    return Codec<ProcessStep>::write({step, {}});
  }
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

std::optional<glm::dquat> turn_of(const Value& rotation_xyzw) {
  const Value::Array* q = rotation_xyzw.array();
  if (!q || q->size() != 4) return std::nullopt;
  const auto number = [&](std::size_t i) { return (*q)[i].number() ? *(*q)[i].number() : 0.0; };
  return glm::dquat(number(3), number(0), number(1), number(2));
}

std::vector<Edit> set_step_angle(const PropertyScope& scope, const Thing& thing, const Property& row,
                                 const Value& value) {
  const std::string key = row.key.substr(0, row.key.rfind('/'));
  const Value item = item_of(scope.project, thing);
  const Value* there = value_at(item, pointer_steps(key));
  const auto turn = there ? turn_of(*there) : std::nullopt;
  if (!turn || !value.number()) return {};
  glm::dvec3 angles_deg = angles_of(*turn);
  angles_deg[row.key.back() - '0'] = *value.number();
  return {set_edit(thing, key, value_of(rotation_of(angles_deg)))};
}

void indent(PropertyRows& rows, std::size_t index) {
  rows.last().id = "step " + std::to_string(index + 1) + " " + rows.last().label;
  rows.last().label = "    " + rows.last().label;
}

/// Where a picture stands and how large it is, in the thing's own axes.
template <class Kind>
void add_picture_rows(PropertyRows& rows, std::size_t index, const Value& step, const std::string& key) {
  const std::string place = "mesh/process/" + std::to_string(index) + "/" + key + "/";
  const auto add = [&](const std::string& label, int axis) {
    rows.number<Kind>(label, place + std::to_string(axis), {"m", 3, 0.001}).removable = false;
    indent(rows, index);
  };
  if (key == "position_m") {
    for (int axis = 0; axis < 3; ++axis) add(std::string("picture ") + "xyz"[axis], axis);
  } else if (key == "size_m") {
    if (!step.find(key)) return;
    add("picture width", 0);
    add("picture height", 1);
  } else {
    const auto turn = turn_of(rows.at("mesh/process/" + std::to_string(index) + "/" + key));
    const glm::dvec3 angles_deg = turn ? angles_of(*turn) : glm::dvec3(0.0);
    for (int axis = 0; axis < 3; ++axis) {
      constexpr const char* names[]{"picture pitch", "picture yaw", "picture roll"};
      Property& row = rows.add(Property::Kind::number, names[axis], Value(angles_deg[axis]));
      row.unit = "°";
      row.digits = 1;
      row.step = 0.5;
      row.least = -36000.0;
      row.most = 36000.0;
      row.key = place + std::to_string(axis);
      row.edits = set_step_angle;
      indent(rows, index);
    }
  }
}

template <class Kind>
void add_settings(PropertyRows& rows, std::size_t index, const Value& step) {
  const std::string place = "mesh/process/" + std::to_string(index) + "/";
  each_field<Kind>([&](const auto& field) {
    const std::string key(field.key);
    if (std::is_same_v<Kind, DecimateStep> && !step.find(key)) return;
    if (key == "position_m" || key == "rotation_xyzw" || key == "size_m") {
      add_picture_rows<Kind>(rows, index, step, key);
      return;
    }
    const auto words = std::ranges::find(setting_words, key, &SettingWords::key);
    if (words == setting_words.end()) {
      add_scheme_row(rows, place + key);
    } else {
      Property& row = rows.number<Kind>(words->label, place + key, words->look);
      if (std::is_same_v<Kind, DecimateStep>) row.removable = false;
    }
    indent(rows, index);
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
