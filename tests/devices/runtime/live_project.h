#pragma once

#include <chrono>
#include <functional>
#include <thread>
#include <utility>
#include <vector>

#include "core/compile/compile.h"
#include "core/scene/edit.h"
#include "core/stage/stage.h"
#include "io/protocol/live_client.h"
#include "tests/devices/runtime/sample_project.h"

namespace focalstage::sample {

/// The sample project with a small white square half a metre away: before the screen at 0.6 m, at -0.35 D.
inline Project live_project(int width_px = 64, int height_px = 48) {
  Project project = sample::project(width_px, height_px);
  Object square;
  square.name = "square";
  square.mesh.shape = PlaneMesh{{0.1, 0.1}};
  square.placement.pose.position_m = {0.0, 0.0, -0.5};
  square.appearance = UnlitAppearance{};
  project.objects.push_back(square);
  return project;
}

inline Edit move_to(double x_m, double z_m = -0.5) {
  return {Edit::Kind::set, "objects", "square", "position_m", Value::Array{x_m, 0.0, z_m}};
}

/// What the rig must show of it, compiled here.
inline FrameImages images_of(const Project& project, int frame = 0) {
  Compiler compiler(compile_settings(project));
  const auto staged = stage(project, {}, frame / project.frames.rate_hz);
  return compiler.frame(*staged)->images;
}

/// A link's answers as they come in, states apart.
class LiveAnswers {
 public:
  explicit LiveAnswers(LiveLink& link) : link_(link) {}

  /// Whether this comes to hold within ten seconds.
  bool wait(const std::function<bool()>& holds) {
    for (int n = 0; n < 5000; ++n) {
      take();
      if (holds()) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    return false;
  }

  bool wait_compiled(std::uint64_t revision, int frame = 0) {
    return wait(
        [&] { return !compiled.empty() && compiled.back().revision == revision && compiled.back().frame == frame; });
  }
  /// Its light was seen, and its images are known.
  bool wait_appeared(std::uint64_t revision, int frame = 0) {
    const auto seen = [&] {
      return !appeared.empty() && appeared.back().revision == revision && appeared.back().frame == frame;
    };
    return wait(seen) && wait_compiled(revision, frame);
  }
  bool wait_refused(std::uint64_t revision) {
    return wait([&] { return !refused.empty() && refused.back().revision == revision; });
  }
  bool wait_ended() {
    return wait([&] { return !ended.empty(); });
  }

  std::vector<LiveCompiled> compiled;
  std::vector<LiveAppeared> appeared;
  std::vector<LiveRefused> refused;
  std::vector<LiveEnded> ended;
  RigState state;

 private:
  void take() {
    for (LiveAnswer& answer : link_.poll()) {
      if (auto* made = std::get_if<LiveCompiled>(&answer)) compiled.push_back(std::move(*made));
      if (auto* shown = std::get_if<LiveAppeared>(&answer)) appeared.push_back(*shown);
      if (auto* no = std::get_if<LiveRefused>(&answer)) refused.push_back(std::move(*no));
      if (auto* end = std::get_if<LiveEnded>(&answer)) ended.push_back(std::move(*end));
      if (auto* rig = std::get_if<RigState>(&answer)) state = std::move(*rig);
    }
  }

  LiveLink& link_;
};

}  // namespace focalstage::sample
