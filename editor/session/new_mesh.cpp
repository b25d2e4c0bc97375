#include "editor/session/new_mesh.h"

namespace focalstage {
namespace {

Value primitive(const char* kind) {
  Value mesh;
  mesh.set("primitive", kind);
  return mesh;
}

Value plane(double width_m, double height_m) {
  Value mesh = primitive("plane");
  mesh.set("size_m", Value(Value::Array{width_m, height_m}));
  return mesh;
}

}  // namespace

Result<Value> new_mesh(const std::string& kind, bool surface) {
  const double size_m = surface ? 0.4 : 0.1;
  if (kind == "plane") return surface ? plane(0.6, 0.4) : plane(0.12, 0.09);
  Value mesh = primitive(kind.c_str());
  if (kind == "box") {
    mesh.set("size_m", Value(Value::Array{size_m, size_m, size_m}));
  } else if (kind == "sphere") {
    mesh.set("radius_m", size_m / 2);
  } else if (kind == "corner") {
    mesh.set("size_m", Value(Value::Array{size_m, size_m}));
    mesh.set("angle_deg", 90.0);
  } else if (kind == "step") {
    mesh.set("size_m", Value(Value::Array{1.5 * size_m, size_m}));
    mesh.set("depth_m", size_m / 4);
  } else if (!is_metre_high(kind)) {
    return Fault{"command.argument", "kind", "there is no primitive " + kind,
                 "use plane, box, sphere, corner, step, teapot or rabbit"};
  }
  return mesh;
}

bool is_metre_high(const std::string& kind) { return kind == "teapot" || kind == "rabbit"; }

}  // namespace focalstage
