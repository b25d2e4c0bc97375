#include "core/base/made_once.h"
#include "core/process/process.h"
#include "core/process/report.h"

namespace focalstage {

namespace {

// A key holds its mesh, so that no other can come to its address meanwhile.
struct ProcessKey {
  std::shared_ptr<const Mesh> mesh;
  std::vector<ProcessStep> steps;

  bool operator==(const ProcessKey&) const = default;
};

constexpr std::size_t most_kept = 32;

}  // namespace

Result<std::shared_ptr<const Mesh>> processed_once(const std::shared_ptr<const Mesh>& mesh,
                                                   const std::vector<ProcessStep>& steps) {
  using Made = Result<std::shared_ptr<const Mesh>>;
  if (steps.empty()) return mesh;
  static MadeOnce<ProcessKey, Made> kept(most_kept);
  return kept.find_or_make({mesh, steps}, [&]() -> Made {
    Result<Mesh> made = processed(*mesh, steps);
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
