#pragma once

#include <memory>
#include <string>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "core/base/result.h"
#include "core/base/rigid.h"
#include "core/mesh/model.h"
#include "core/scene/project.h"

namespace focalstage {

/// How a drawable looks from any side, resolved from the object's appearance and the file's material; of a surface,
/// what share of the light on it comes back.
struct Finish {
  enum class Kind { flat, checker, textured };

  Kind kind = Kind::flat;
  glm::dvec3 a{1.0};                       ///< flat and textured: the base colour, linear; checker: the first square's
  glm::dvec3 b{0.0};                       ///< checker: the other's
  glm::ivec2 squares{1, 1};                ///< checker: over the unit square of UV
  std::shared_ptr<const Texture> texture;  ///< textured
  bool lit = false;                        ///< whether the stage's lights act on it
  bool vertex_colors = false;              ///< whether the mesh's colours multiply it
  double alpha_cutoff = 0.0;               ///< textured: what is less opaque is cut away; 0: nothing is

  bool operator==(const Finish&) const = default;
};

/// One mesh standing in the world. The mesh is shared, so what did not change since the last stage has the same
/// address.
struct Drawable {
  std::shared_ptr<const Mesh> mesh;
  glm::dmat4 world_from_mesh{1.0};
  Finish finish;

  bool operator==(const Drawable&) const = default;
};

struct StagedSurface {
  std::string name;
  std::size_t index = 0;  ///< in the project's list
  double illumination = 0.0;
  Rigid world_from_surface;
  std::vector<Drawable> drawables;

  bool operator==(const StagedSurface&) const = default;
};

struct StagedObject {
  std::string name;
  std::size_t index = 0;  ///< in the project's list
  Depth depth;
  Rigid world_from_object;
  std::vector<Drawable> drawables;

  bool operator==(const StagedObject&) const = default;
};

/// The room at one moment: what stands where, in metres and world space. Hidden things are left out.
struct Stage {
  double time_s = 0.0;
  Rigid world_from_viewer;  ///< the midpoint of the pupils
  double interpupillary_m = 0.063;
  std::vector<StagedSurface> surfaces;
  std::vector<StagedObject> objects;
  std::vector<Light> lights;
};

/// Stands the project up at `time_s`. Faults: "stage.asset-missing", "stage.mesh-size", "process.*", "image.*", with a
/// JSON pointer. An object whose sequence of pictures shows nothing at that time stands there without drawables.
/// Primitive meshes are made once per shape and shared between calls.
Result<Stage> stage(const Project& project, const Assets& assets, double time_s);

/// The pose of a placement at `time_s`: before the first key the first, after the last the last; linear and slerp
/// between.
Rigid pose_at(const Placement& placement, double time_s);

}  // namespace focalstage
