#pragma once

#include <vector>

#include "core/compile/eye_view.h"
#include "core/compile/kernel.h"
#include "core/compile/pixel_looks.h"
#include "core/compile/stack_plan.h"

namespace focalstage {

/// What an eye with a pupil of finite width would see of the virtual objects themselves, at every focus of a plan.
///
/// A cell is the mean of rays through the pupil. The ray that leaves the pupil at height h and belongs to the look u of
/// an eye focused at f runs along u - h f; what stands at the inverse depth r it meets where the pupil's centre sees it
/// along u - h f + h r. So every triangle seen from the centre gives the one seen from h by a few products, also what
/// is hidden from the centre. What is wanted elsewhere than it stands (fixed, offset, pinned) is met where its light
/// shall come into focus, at the wanted vergence a instead of r: along u + h (a - f). Who hides whom is decided by
/// where things stand, as it is for the pupil's centre, and what lies beyond the outermost slices counts as lying on
/// them, as it does in linear filtering.
class StackTarget {
 public:
  /// `all` holds the objects' triangles, without their backs left out, in cells.
  StackTarget(const EyeView& all, const PixelLooks& looks, const StackPlan& plan, const std::vector<SliceSetup>& slices,
              int channels, const Kernel& kernel);

  /// Linear light of the asked cells of one tile into `out` [channel][focus][64].
  void tile(std::size_t slot, std::vector<float>& out) const;

 private:
  struct Candidate {
    std::uint32_t triangle;
    double per_x, per_y, rest;  ///< wanted vergence as an affine function of the look from the centre
    double low_d, high_d;       ///< its range over the triangle
  };
  struct Seen;  ///< candidates as one point of the pupil sees them

  std::vector<Candidate> candidates(const StackTile& tile, const LookTile& looks) const;
  void add_ray(const StackTile& tile, std::size_t focus, const Seen& seen, std::vector<float>& out) const;

  const EyeView& all_;
  const PixelLooks& looks_;
  const StackPlan& plan_;
  const std::vector<SliceSetup>& slices_;
  int channels_;
  const Kernel& kernel_;
};

}  // namespace focalstage
