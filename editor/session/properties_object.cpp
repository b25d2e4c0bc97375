// Surfaces and objects: what stands in the room, and where objects come into focus.
#include <cmath>
#include <limits>

#include "core/base/number_words.h"
#include "core/optics/vergence.h"
#include "editor/session/edits.h"
#include "editor/session/property_rows.h"
#include "editor/tools/depth_handle.h"

namespace focalstage {
namespace {

std::optional<DepthReading> reading_of(const PropertyScope& scope, const std::string& name) {
  if (!scope.stage || !scope.picker) return std::nullopt;
  for (const StagedObject& object : scope.stage->objects) {
    if (object.name == name) return read_depth(scope.project, *scope.stage, object, *scope.picker);
  }
  return std::nullopt;
}

double to_hundredths(double number) { return std::round(number * 100.0) / 100.0; }

/// The slice whose picture lands nearest to that depth.
int nearest_slice(const Project& project, const DepthReading& reading) {
  int nearest = 0;
  double least_d = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; reading.surface_m && i < project.slices.powers_d.size(); ++i) {
    const double off_d =
        std::abs(image_vergence_d(*reading.surface_m, project.slices.powers_d[i]) - reading.accommodation_d);
    if (off_d < least_d) {
      least_d = off_d;
      nearest = static_cast<int>(i);
    }
  }
  return nearest;
}

/// Another rule for the depth that leaves it, as far as the rule can, where it is.
std::vector<Edit> set_mode(const PropertyScope& scope, const Thing& thing, const Property&, const Value& value) {
  const Object* object = object_named(scope.project, thing.name);
  if (!object || !value.text()) return {};
  const auto reading = reading_of(scope, thing.name);
  const std::string& mode = *value.text();
  Value depth;
  depth.set("mode", mode);
  if (mode == "fixed") depth.set("vergence_d", reading ? to_hundredths(reading->accommodation_d) : 1.0);
  if (mode == "offset") depth.set("vergence_d", reading ? to_hundredths(reading->conflict_d) : 0.0);
  if (mode == "slice") depth.set("index", reading ? nearest_slice(scope.project, *reading) : 0);
  for (const auto& [key, kept] : object->depth.unknown) depth.set(key, kept);
  return {set_edit(thing, "depth", depth)};
}

std::vector<Edit> set_distance(const PropertyScope&, const Thing& thing, const Property&, const Value& value) {
  if (!value.number() || !(*value.number() > 0.0)) return {};
  return {set_edit(thing, "depth/vergence_d", 1.0 / *value.number())};
}

void add_fixed_rows(PropertyRows& rows) {
  Property& focus = rows.number<Depth>("accommodation", "depth/vergence_d", {"D", 2, 0.01});
  focus.help = "Where all of it comes into focus, whatever its shape.";
  const double vergence_d = focus.value.number() ? *focus.value.number() : 0.0;
  focus.other = distance_text(vergence_d);
  if (!(vergence_d > 0.0)) return;
  Property& distance = rows.add(Property::Kind::number, "focus distance", Value(1.0 / vergence_d));
  distance.unit = "m";
  distance.step = 0.002;
  distance.least = 0.01;
  distance.most = 1e4;
  distance.key = "depth/vergence_d";
  distance.edits = set_distance;
}

void add_index_row(PropertyRows& rows) {
  std::vector<PropertyChoice> choices;
  const std::vector<double>& powers_d = rows.scope().project.slices.powers_d;
  for (std::size_t i = 0; i < powers_d.size(); ++i) {
    choices.push_back({Value(static_cast<double>(i)), std::to_string(i) + ":  " + dioptre_text(powers_d[i])});
  }
  Property& row = rows.choice("slice", "depth/index", std::move(choices));
  if (row.value.is_null()) row.value = Value(0.0);
  row.help = "The whole object is shown in this slice alone.";
}

void add_reading(PropertyRows& rows, const DepthReading& reading, bool with_accommodation) {
  const auto show = [&](const char* label, double value_d, const char* help) -> Property& {
    Property& row = rows.shown(label, dioptre_text(value_d));
    row.help = help;
    return row;
  };
  Property& vergence = show("vergence", reading.vergence_d, "Where both eyes turn to look at it.");
  vergence.other = distance_text(reading.vergence_d);
  if (with_accommodation) {
    Property& focus = show("accommodation", reading.accommodation_d, "Where the eyes focus to see it sharp.");
    focus.other = distance_text(reading.accommodation_d);
  }
  Property& conflict =
      show("conflict", reading.conflict_d, "Accommodation less vergence. Beyond half a dioptre it tires most people.");
  const std::string signed_d = signed_text(reading.conflict_d, 2);
  conflict.value = Value((signed_d == "+0.00" ? "0.00" : signed_d) + " D");
  if (reading.tires()) conflict.tone = Property::Tone::red;
}

void add_depth_rows(PropertyRows& rows) {
  rows.group("Depth");
  Property& mode = rows.choice("focus", "depth/mode",
                               {{Value("placed"), "where it stands"},
                                {Value("fixed"), "at one depth"},
                                {Value("offset"), "shifted"},
                                {Value("slice"), "in one slice"}});
  mode.edits = set_mode;
  mode.help = "At which distance it comes into focus.";
  const std::string chosen = mode.value.text() ? *mode.value.text() : "placed";
  if (chosen == "fixed") add_fixed_rows(rows);
  if (chosen == "offset") {
    rows.number<Depth>("shift", "depth/vergence_d", {"D", 2, 0.01}).help =
        "Added to the depth at which it stands; positive is nearer.";
  }
  if (chosen == "slice") add_index_row(rows);
  if (const auto reading = reading_of(rows.scope(), rows.thing().name)) {
    add_reading(rows, *reading, chosen != "fixed");
  }
}

// Appearance ----------------------------------------------------------------------------------------------------------

Value white() { return Value(Value::Array{1.0, 1.0, 1.0}); }
Value black() { return Value(Value::Array{0.0, 0.0, 0.0}); }

std::string look_of(const Value& appearance) {
  for (const char* look : {"unlit", "checker", "image"}) {
    if (appearance.find(look)) return look;
  }
  return "material";
}

/// Another look that begins with the colour of the one before.
std::vector<Edit> set_look(const PropertyScope& scope, const Thing& thing, const Property&, const Value& value) {
  const Value item = item_of(scope.project, thing);
  const Value* found = item.find("appearance");
  Value appearance = found && found->object() ? *found : Value(Value::Object{});
  const Value* unlit = appearance.find("unlit");
  const Value* checker = appearance.find("checker");
  const Value* first = checker ? checker->find("a") : nullptr;
  const Value colour = unlit ? *unlit : first ? *first : white();
  if (!value.text() || look_of(appearance) == *value.text()) return {};
  appearance.erase("unlit");
  appearance.erase("checker");
  appearance.erase("image");
  if (*value.text() == "unlit") appearance.set("unlit", colour);
  if (*value.text() == "checker") {
    Value squares;
    squares.set("squares", Value(Value::Array{8, 8}));
    squares.set("a", colour);
    squares.set("b", black());
    appearance.set("checker", squares);
  }
  const bool nothing_left = appearance.object()->empty();
  return {set_edit(thing, "appearance", nothing_left ? Value() : appearance)};
}

void add_checker_rows(PropertyRows& rows) {
  rows.number<CheckerAppearance>("squares across", "appearance/checker/squares/0", {"", 0, 0.1});
  rows.number<CheckerAppearance>("squares up", "appearance/checker/squares/1", {"", 0, 0.1});
  rows.colour("first colour", "appearance/checker/a", white()).help = "Of the square at the lower left.";
  rows.colour("other colour", "appearance/checker/b", black());
}

void add_appearance_rows(PropertyRows& rows) {
  rows.group("Appearance");
  const std::string look = look_of(rows.at("appearance"));
  std::vector<PropertyChoice> choices{
      {Value("material"), "material, lit"}, {Value("unlit"), "one colour"}, {Value("checker"), "checker"}};
  if (look == "image") choices.push_back({Value("image"), "picture"});
  Property& kind = rows.choice("look", "appearance", std::move(choices));
  kind.value = Value(look);
  kind.edits = set_look;
  kind.help = "The mesh's own material in the light of the lights, a colour that no light changes, or a picture.";
  if (look == "unlit") rows.colour("colour", "appearance/unlit", white());
  if (look == "checker") add_checker_rows(rows);
  if (look == "image") add_image_rows(rows);
  Value args;
  args.set("look", rows.thing().name);
  rows.action("Picture…", "file.import", std::move(args)).help =
      "A picture from a file over the mesh; the first of numbered ones brings all of them.";
}

// Paint ---------------------------------------------------------------------------------------------------------------

std::string paint_of(const Value& albedo) {
  return albedo.text() ? "material" : albedo.object() ? "picture" : "colour";
}

std::vector<Edit> set_paint(const PropertyScope& scope, const Thing& thing, const Property&, const Value& value) {
  const Value item = item_of(scope.project, thing);
  const Value* found = item.find("albedo");
  if (!value.text() || paint_of(found ? *found : Value()) == *value.text()) return {};
  if (*value.text() == "material") return {set_edit(thing, "albedo", Value("material"))};
  if (*value.text() == "colour") return {set_edit(thing, "albedo", white())};
  return {set_edit(thing, "albedo", Value(Value::Object{{"file", "assets/" + thing.name + ".png"}}))};
}

void add_paint_rows(PropertyRows& rows) {
  const std::string paint = paint_of(rows.at("albedo"));
  Property& kind = rows.choice(
      "paint", "albedo",
      {{Value("colour"), "one colour"}, {Value("picture"), "a picture"}, {Value("material"), "its own material"}});
  kind.value = Value(paint);
  kind.edits = set_paint;
  kind.help = "What share of the light on it comes back. The slices can make up for it.";
  if (paint == "colour") rows.colour("paint colour", "albedo", white());
  if (paint == "picture")
    rows.text("picture", "albedo/file").help = "PNG or JPEG beside the project, over the mesh's UV.";
}

}  // namespace

void add_surface_rows(PropertyRows& rows) {
  add_pose_rows(rows);
  add_size_rows(rows);
  rows.group("Light");
  rows.number<Surface>("illumination", "illumination", {"", 2, 0.005}).help =
      "How brightly the surface itself is lit while the lens is at zero: 0 not, 1 fully.";
  add_paint_rows(rows);
  add_mesh_rows(rows);
  add_process_rows(rows);
  add_movement_rows(rows);
  add_listed_rows(rows);
}

void add_object_rows(PropertyRows& rows) {
  add_pose_rows(rows);
  add_size_rows(rows);
  add_depth_rows(rows);
  add_appearance_rows(rows);
  add_mesh_rows(rows);
  add_process_rows(rows);
  add_movement_rows(rows);
  add_listed_rows(rows);
}

}  // namespace focalstage
