#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "core/optics/needs.h"
#include "core/optics/projector_model.h"
#include "core/stage/stage.h"

namespace focalstage {

/// Measures which powers stage after stage of one project needs, whatever its slices: looks from both pupils over a
/// regular grid about as fine as `grid` x `grid` over the objects.
///
/// A look that meets an object needs v* = 1/d_p* - 1/d_v (design section 5). d_p* depends on the surface point whose
/// picture, stretched by the very power v*, appears along that look: found by going from the point straight ahead to
/// the one that its power names, twice over. Looks whose picture no surface carries, or no projector lights, need
/// nothing and are counted. (So are those at a surface's rim, no wider than the stretch, that only a bent look
/// reaches.)
class NeedMeter {
 public:
  NeedMeter(std::vector<ProjectorModel> projectors, double lens_to_pupil_m, Breathing breathing, int grid = 64);
  NeedMeter(ProjectorModel projector, double lens_to_pupil_m, Breathing breathing, int grid = 64)
      : NeedMeter(std::vector{std::move(projector)}, lens_to_pupil_m, breathing, grid) {}
  ~NeedMeter();
  NeedMeter(NeedMeter&&) noexcept;
  NeedMeter& operator=(NeedMeter&&) noexcept;

  /// One entry per object of the stage, in its order.
  std::vector<ObjectNeeds> measure(const Stage& stage);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace focalstage
