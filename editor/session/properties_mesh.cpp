#include <algorithm>
#include <array>
#include <utility>

#include "editor/session/edits.h"
#include "editor/session/new_mesh.h"
#include "editor/session/property_rows.h"

namespace focalstage {
namespace {

constexpr std::array<const char*, 7> primitives{"plane", "box", "sphere", "corner", "step", "teapot", "rabbit"};

std::string kind_of(const Value& mesh) {
  const Value* primitive = mesh.find("primitive");
  return primitive && primitive->text() ? *primitive->text() : "file";
}

/// Another shape of about the same size: what is 1 m high comes with a scale that fits a room.
std::vector<Edit> set_kind(const PropertyScope& scope, const Thing& thing, const Property&, const Value& value) {
  const Value item = item_of(scope.project, thing);
  const Value* before = item.find("mesh");
  const auto mesh = value.text() ? new_mesh(*value.text(), thing.list == "surfaces") : Fault{};
  if (!mesh || !before || kind_of(*before) == *value.text()) return {};
  std::vector<Edit> edits{set_edit(thing, "mesh", *mesh)};
  const bool was_high = is_metre_high(kind_of(*before)) || kind_of(*before) == "file";
  if (was_high != is_metre_high(*value.text())) edits.push_back(set_edit(thing, "scale", was_high ? 1.0 : 0.1));
  return edits;
}

template <class Shape>
void add_size(PropertyRows& rows, std::initializer_list<const char*> labels) {
  int index = 0;
  for (const char* label : labels) {
    rows.number<Shape>(label, "mesh/size_m/" + std::to_string(index++), {"m", 3, 0.001});
  }
}

void add_parameters(PropertyRows& rows, const std::string& kind) {
  if (kind == "plane") add_size<PlaneMesh>(rows, {"width", "height"});
  if (kind == "box") add_size<BoxMesh>(rows, {"width", "height", "depth"});
  if (kind == "sphere") rows.number<SphereMesh>("radius", "mesh/radius_m", {"m", 3, 0.001});
  if (kind == "corner") {
    add_size<CornerMesh>(rows, {"wing width", "height"});
    rows.number<CornerMesh>("opening", "mesh/angle_deg", {"°", 1, 0.5}).help = "Between the wings.";
  }
  if (kind == "step") {
    add_size<StepMesh>(rows, {"width", "height"});
    rows.number<StepMesh>("step depth", "mesh/depth_m", {"m", 3, 0.001}).help =
        "How far the left half stands before the right.";
  }
}

}  // namespace

void add_mesh_rows(PropertyRows& rows) {
  rows.group("Mesh");
  const std::string kind = kind_of(rows.at("mesh"));
  std::vector<PropertyChoice> choices;
  if (kind == "file") choices.push_back({Value("file"), "from a file"});
  for (const char* primitive : primitives) choices.push_back({Value(primitive), primitive});
  Property& shape = rows.choice("shape", "mesh/primitive", std::move(choices));
  shape.value = Value(kind);
  shape.edits = set_kind;
  if (kind == "file") rows.text("file", "mesh/file").help = "In the project's folder.";
  add_parameters(rows, kind);
  if (const std::vector<Drawable>* drawables = drawables_of(rows.scope(), rows.thing())) {
    rows.shown("triangles", grouped_text(triangles_of(*drawables)));
  }
  Value args;
  args.set("list", rows.thing().list);
  args.set("replace", rows.thing().name);
  rows.action("Replace mesh…", "file.import", std::move(args)).help =
      "Another mesh from a file, with the same pose and depth.";
}

}  // namespace focalstage
