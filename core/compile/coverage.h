#pragma once

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "core/optics/projector_model.h"
#include "core/stage/stage.h"

namespace focalstage {

/// Of the looks at one object, how many can't be served, both eyes together.
struct ObjectCoverage {
  std::size_t index = 0;  ///< in the project's list
  std::uint64_t looks = 0;
  std::uint64_t off_surface = 0;        ///< no surface behind or before it to carry the picture
  std::uint64_t outside_projector = 0;  ///< the surface is there, no projector reaches it
  std::uint64_t outside_lens = 0;       ///< the look misses the lens aperture

  /// Adds other looks at the same object.
  void add(const ObjectCoverage& more);
};

/// Measures stage after stage of one project: looks from both pupils over a regular grid about as fine as `grid` x
/// `grid` over the objects. Keeps how the eyes and the projectors see the surfaces while those stand still.
class CoverageMeter {
 public:
  /// `projectors`: all that light the surfaces.
  CoverageMeter(std::vector<ProjectorModel> projectors, double lens_to_pupil_m, double lens_aperture_m, int grid = 64);
  CoverageMeter(ProjectorModel projector, double lens_to_pupil_m, double lens_aperture_m, int grid = 64)
      : CoverageMeter(std::vector{std::move(projector)}, lens_to_pupil_m, lens_aperture_m, grid) {}
  ~CoverageMeter();
  CoverageMeter(CoverageMeter&&) noexcept;
  CoverageMeter& operator=(CoverageMeter&&) noexcept;

  /// One entry per object of the stage, in its order.
  std::vector<ObjectCoverage> measure(const Stage& stage);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace focalstage
