#include "core/process/process.h"

#include <string>
#include <utility>

#include <glm/gtc/matrix_transform.hpp>

#include "core/process/bits.h"
#include "core/process/borders.h"
#include "core/process/clean.h"
#include "core/process/sculpt.h"
#include "core/process/texture_map.h"
#include "core/process/winding.h"
#include "core/scene/process_codec.h"

namespace focalstage {

namespace {

/// How a mesh stands: a millimetre of the room in its own units, and the thing's axes in metres of the room from it.
struct Standing {
  double mm;
  glm::dmat4 room_from_mesh;
};

// What a step makes of a mesh.
Result<Mesh> done(const Mesh& mesh, const WeldStep& step, const Standing& at) {
  return welded(mesh, step.tolerance_mm * at.mm);
}
Result<Mesh> done(const Mesh& mesh, const CleanStep&, const Standing&) { return cleaned(mesh); }
Result<Mesh> done(const Mesh& mesh, const DropFinsStep&, const Standing&) { return without_fins(mesh); }
Result<Mesh> done(const Mesh& mesh, const DropBitsStep& step, const Standing&) {
  return without_bits(mesh, step.least_share);
}
Result<Mesh> done(const Mesh& mesh, const FixWindingStep&, const Standing&) { return evenly_wound(mesh); }
Result<Mesh> done(const Mesh& mesh, const FlipStep&, const Standing&) { return flipped(mesh); }
Result<Mesh> done(const Mesh& mesh, const FillHolesStep& step, const Standing& at) {
  if (!step.longest_mm) return filled(mesh, std::nullopt);
  return filled(mesh, *step.longest_mm * at.mm);
}
Result<Mesh> done(const Mesh& mesh, const KeepPartStep& step, const Standing&) {
  Mesh part = part_of(mesh, step.fold_deg, step.part);
  if (!part.triangles.empty()) return part;
  return Fault{"process.no-part", "part", "there is no part " + std::to_string(step.part) + " between such folds",
               "name a lower part; the largest is 0"};
}
Result<Mesh> done(const Mesh& mesh, const DecimateStep& step, const Standing& at) {
  if (step.error_mm) return decimated(mesh, std::nullopt, *step.error_mm * at.mm);
  return decimated(mesh, static_cast<std::size_t>(step.triangles.value_or(1)), std::nullopt);
}
Result<Mesh> done(const Mesh& mesh, const SmoothStep& step, const Standing&) {
  return smoothed(mesh, step.rounds, step.feature_deg);
}
Result<Mesh> done(const Mesh& mesh, const SubdivideStep& step, const Standing&) {
  return subdivided(mesh, step.scheme, step.rounds);
}
Result<Mesh> done(const Mesh& mesh, const UvPlaneStep& step, const Standing& at) {
  return mapped_by_plane(mesh, step, at.room_from_mesh);
}
Result<Mesh> done(const Mesh& mesh, const UvProjectorStep& step, const Standing& at) {
  return mapped_by_projector(mesh, step, at.room_from_mesh);
}

}  // namespace

Result<Mesh> processed(const Mesh& mesh, const std::vector<ProcessStep>& steps, double scale,
                       const glm::dmat4& thing_from_mesh) {
  const Standing at{1e-3 / scale, glm::scale(glm::dmat4(1.0), glm::dvec3(scale)) * thing_from_mesh};
  Mesh now = mesh;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    Result<Mesh> next = std::visit([&](const auto& kind) { return done(now, kind, at); }, steps[i].kind);
    const std::string place = "/" + std::to_string(i);
    if (!next) {
      Fault fault = next.fault();
      fault.where = place + (fault.where.empty() ? "" : "/" + fault.where);
      return fault;
    }
    now = *std::move(next);
    if (now.triangles.empty()) {
      return Fault{"process.empty", place, "\"" + std::string(name_of(steps[i].kind)) + "\" leaves no triangle",
                   "remove the step, or change it"};
    }
  }
  return now;
}

}  // namespace focalstage
