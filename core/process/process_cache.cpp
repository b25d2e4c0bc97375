#include <algorithm>

#include "core/base/made_once.h"
#include "core/process/process.h"
#include "core/process/report.h"

namespace focalstage {

namespace {

// A key holds its mesh, so that no other can come to its address meanwhile.
struct ProcessKey {
  std::shared_ptr<const Mesh> mesh;
  std::vector<ProcessStep> steps;
  double scale = 1.0;
  glm::dmat4 thing_from_mesh{1.0};

  bool operator==(const ProcessKey&) const = default;
};

constexpr std::size_t most_kept = 32;

/// Whether it matters where the mesh lies in its file.
bool has_place(const ProcessStep& step) {
  return std::holds_alternative<UvPlaneStep>(step.kind) || std::holds_alternative<UvProjectorStep>(step.kind);
}

/// Without a length among the steps the scale changes nothing.
bool has_length(const ProcessStep& step) {
  if (has_place(step)) return true;
  if (const auto* weld = std::get_if<WeldStep>(&step.kind)) return weld->tolerance_mm > 0.0;
  if (const auto* fill = std::get_if<FillHolesStep>(&step.kind)) return fill->longest_mm.has_value();
  const auto* decimate = std::get_if<DecimateStep>(&step.kind);
  return decimate && decimate->error_mm.has_value();
}

}  // namespace

Result<std::shared_ptr<const Mesh>> processed_once(const std::shared_ptr<const Mesh>& mesh,
                                                   const std::vector<ProcessStep>& steps, double scale,
                                                   const glm::dmat4& thing_from_mesh) {
  using Made = Result<std::shared_ptr<const Mesh>>;
  if (steps.empty()) return mesh;
  static MadeOnce<ProcessKey, Made> kept(most_kept);
  if (std::ranges::none_of(steps, has_length)) scale = 1.0;
  const glm::dmat4 place = std::ranges::any_of(steps, has_place) ? thing_from_mesh : glm::dmat4(1.0);
  return kept.find_or_make({mesh, steps, scale, place}, [&]() -> Made {
    Result<Mesh> made = processed(*mesh, steps, scale, place);
    if (!made) return made.fault();
    return std::make_shared<const Mesh>(*std::move(made));
  });
}

std::vector<MeshFlaw> flaws_once(const std::shared_ptr<const Mesh>& mesh) {
  static MadeOnce<std::shared_ptr<const Mesh>, std::vector<MeshFlaw>> kept(most_kept);
  return kept.find_or_make(mesh, [&] {
    std::vector<MeshFlaw> flaws = flaws_of(report_mesh(*mesh));
    for (MeshFlaw& flaw : flaws) {
      const Result<Mesh> mended = processed(*mesh, {{*flaw.step, {}}});
      if (!mended || count_of(flaw.code, flaws_of(report_mesh(*mended))) >= flaw.count) flaw.step.reset();
    }
    return flaws;
  });
}

}  // namespace focalstage
