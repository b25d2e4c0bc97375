#pragma once

#include <span>
#include <stop_token>
#include <vector>

#include "core/base/result.h"
#include "core/retina/retina.h"

namespace focalstage {

/// Adds another projector's light to what an eye sees; both pictures are of one view.
void add_light(const RetinaImage& more, RetinaImage& sum);

/// The same for the accommodation asked for: means and spreads by light.
void add_light(const DrivenFocus& more, DrivenFocus& sum);

/// What one eye sees of several projectors: light adds. An input for each; only one of them carries the room's light.
/// As with Retina, what did not change is kept between calls.
class Retinas {
 public:
  explicit Retinas(int threads = 0) : threads_(threads) {}

  /// Faults: those of Retina, and "retina.input" where there is no input.
  Result<RetinaImage> view(std::span<const RetinaInput> inputs, const RetinaView& view, std::stop_token stop = {});
  Result<DrivenFocus> driven_focus(std::span<const RetinaInput> inputs, const RetinaView& view,
                                   std::stop_token stop = {});

 private:
  template <class Seen, class Look>
  Result<Seen> sum(std::span<const RetinaInput> inputs, const Look& look);

  int threads_;
  std::vector<Retina> retinas_;  ///< of each projector
};

}  // namespace focalstage
