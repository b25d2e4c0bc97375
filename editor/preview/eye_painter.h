#pragma once

#include <stop_token>

#include "core/base/result.h"
#include "core/retina/retina.h"
#include "editor/preview/preview_values.h"
#include "editor/preview/slice_maker.h"

namespace focalstage {

/// Paints what the eyes see of compiled slices, panel by panel: the retina's linear light, encoded for a screen.
class EyePainter {
 public:
  /// `maker` compiles the single slice of a conventional projection where that is wished for.
  Result<EyePicture> paint(const CompiledSlices& compiled, const EyeWish& wish, SliceMaker& maker,
                           std::stop_token stop);

  /// The accommodation that what is seen at `at` (0..1 from the picture's top left corner) asks for; none where nothing
  /// is seen.
  Result<std::optional<double>> focus_at(const CompiledSlices& compiled, const EyeWish& wish, glm::dvec2 at);

 private:
  /// One for each eye and projection, since each keeps what it saw.
  Retina retinas_[2][2];
  CompiledFrame conventional_;
  std::uint64_t conventional_revision_ = 0;
  int conventional_frame_ = -1;
  int conventional_divisor_ = 0;

  std::shared_ptr<const Project> scheduled_;  ///< whose schedule is kept
  Schedule schedule_;

  Retina& retina_of(const EyePanel& panel, Side side) {
    return retinas_[index_of(side)][panel.projection == EyeProjection::conventional ? 1 : 0];
  }
  RetinaInput input_for(const CompiledSlices& compiled, const EyeWish& wish, const EyePanel& panel, Side side);
  Status paint_panel(const CompiledSlices& compiled, const EyeWish& wish, std::size_t panel, EyePicture& picture,
                     const std::stop_token& stop);
  Status add_conflicts(const CompiledSlices& compiled, const EyeWish& wish, std::size_t panel, EyePicture& picture,
                       const std::stop_token& stop);
  RetinaInput conventional_input(const CompiledSlices& compiled, Side side) const;
  const Schedule& schedule_of(const CompiledSlices& compiled);
  Status make_conventional(const CompiledSlices& compiled, SliceMaker& maker, std::stop_token stop);
};

/// What reaches `side`: all exposures of the period, or only its own that is on at `wish.sweep_time_s`.
RetinaInput retina_input(const CompiledSlices& compiled, const Schedule& schedule, Side side, const EyeWish& wish);

/// The view of one of `panels` panels.
RetinaView retina_view(const EyeWish& wish, Side side, std::size_t panels = 1);

}  // namespace focalstage
