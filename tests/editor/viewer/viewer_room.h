#pragma once

#include <doctest/doctest.h>

#include <map>

#include "editor/viewer/two_choice.h"
#include "io/project/project_file.h"

namespace focalstage {

/// A wall at `surface_m` from the pupils, a projector above the head, slices from -1 to 1 D.
inline Source viewer_room(double surface_m = 0.5) {
  Project project;
  project.name = "Room";
  Projector& projector = project.projectors.emplace_back();
  projector.name = "main";
  projector.frames_per_second = 2000.0;
  projector.latency_ms = 0.15;
  projector.fx_px = projector.fy_px = 1500.0;
  projector.pose.position_m = {0.0, 0.0, 0.4};
  project.slices.powers_d = {-1.0, 0.0, 1.0};
  Surface& wall = project.surfaces.emplace_back();
  wall.name = "wall";
  wall.mesh.shape = PlaneMesh{{1.0, 1.0}};
  wall.placement.pose.position_m = {0.0, 0.0, -surface_m};
  Source source;
  source.project = project;
  source.text = project_text(project);
  return source;
}

/// A rig that is always as told.
class PaperRig final : public TrialRig {
 public:
  Status connect(bool) override { return {}; }
  Status prepare(const ReadyCondition& show, const std::stop_token&) override {
    CHECK_FALSE(lit);
    prepared.push_back(show.sha256);
    return {};
  }
  Status show(const ShownTarget& target) override {
    CHECK_FALSE(lit);  // one pattern must not change into the next
    lit = target.frame;
    ++shown;
    return {};
  }
  Status dark() override {
    lit.reset();
    return {};
  }
  Status check() override {
    return shown > breaks_after ? Status(Fault{"rig.dark", "rig", "the rig went dark", ""}) : Status();
  }
  std::string kind() const override { return "paper"; }

  std::optional<int> lit;
  std::vector<std::string> prepared;
  int shown = 0;
  int breaks_after = 1 << 20;
};

/// What an eye sees of each level, looked up once so that many people cost one look each.
template <class Look>
std::map<std::size_t, double> all_seen(std::size_t levels, const Look& look) {
  std::map<std::size_t, double> seen;
  for (std::size_t level = 0; level < levels; ++level) {
    const Result<double> difference = look(level);
    if (!difference) FAIL(describe(difference.fault()));
    seen[level] = *difference;
  }
  return seen;
}

inline ScriptedObserver person(const std::map<std::size_t, double>& seen, double noise, std::uint64_t seed) {
  return {[&seen](std::size_t level) -> Result<double> { return seen.at(level); }, noise, seed};
}

/// The level at which what is seen changes its sign, between those that were seen.
inline double crossing(const std::vector<double>& levels, const std::map<std::size_t, double>& seen) {
  for (std::size_t k = 1; k < levels.size(); ++k) {
    const double a = seen.at(k - 1), b = seen.at(k);
    if ((a > 0.0) != (b > 0.0)) return levels[k - 1] + (levels[k] - levels[k - 1]) * a / (a - b);
  }
  FAIL("is equal at no level");
  return 0.0;
}

inline const FrameProgress no_progress = [](int, int) {};

}  // namespace focalstage
