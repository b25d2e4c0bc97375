#include "core/process/process.h"

#include <string>
#include <utility>

#include "core/process/bits.h"
#include "core/process/borders.h"
#include "core/process/clean.h"
#include "core/process/sculpt.h"
#include "core/process/winding.h"
#include "core/scene/process_codec.h"

namespace focalstage {

namespace {

// What a step makes of a mesh in whose units a millimetre of the room is `mm`.
Result<Mesh> done(const Mesh& mesh, const WeldStep& step, double mm) { return welded(mesh, step.tolerance_mm * mm); }
Result<Mesh> done(const Mesh& mesh, const CleanStep&, double) { return cleaned(mesh); }
Result<Mesh> done(const Mesh& mesh, const DropFinsStep&, double) { return without_fins(mesh); }
Result<Mesh> done(const Mesh& mesh, const DropBitsStep& step, double) { return without_bits(mesh, step.least_share); }
Result<Mesh> done(const Mesh& mesh, const FixWindingStep&, double) { return evenly_wound(mesh); }
Result<Mesh> done(const Mesh& mesh, const FlipStep&, double) { return flipped(mesh); }
Result<Mesh> done(const Mesh& mesh, const FillHolesStep& step, double mm) {
  if (!step.longest_mm) return filled(mesh, std::nullopt);
  return filled(mesh, *step.longest_mm * mm);
}
Result<Mesh> done(const Mesh& mesh, const KeepPartStep& step, double) {
  Mesh part = part_of(mesh, step.fold_deg, step.part);
  if (!part.triangles.empty()) return part;
  return Fault{"process.no-part", "part", "there is no part " + std::to_string(step.part) + " between such folds",
               "name a lower part; the largest is 0"};
}
Result<Mesh> done(const Mesh& mesh, const DecimateStep& step, double mm) {
  if (step.error_mm) return decimated(mesh, std::nullopt, *step.error_mm * mm);
  return decimated(mesh, static_cast<std::size_t>(step.triangles.value_or(1)), std::nullopt);
}
Result<Mesh> done(const Mesh& mesh, const SmoothStep& step, double) {
  return smoothed(mesh, step.rounds, step.feature_deg);
}
Result<Mesh> done(const Mesh& mesh, const SubdivideStep& step, double) {
  return subdivided(mesh, step.scheme, step.rounds);
}

}  // namespace

Result<Mesh> processed(const Mesh& mesh, const std::vector<ProcessStep>& steps, double scale) {
  Mesh now = mesh;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    Result<Mesh> next = std::visit([&](const auto& kind) { return done(now, kind, 1e-3 / scale); }, steps[i].kind);
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
