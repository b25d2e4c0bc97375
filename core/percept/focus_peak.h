#pragma once

#include <optional>
#include <span>

namespace focalstage {

/// The focus at which something is sharpest.
struct FocusPeak {
  double focus_d = 0.0;
  double sharpness = 0.0;
  bool inside = true;  ///< false: still rising where the sweep ends; the peak may lie beyond
};

/// The top of the parabola through the highest sample and its neighbours; `focus_d` rises, at least three samples. A
/// level top (within half a thousandth: blur below a pixel changes nothing) counts as one sample in its middle. None
/// where no sample is above zero. Samples that are no numbers end the curve as its ends do.
std::optional<FocusPeak> focus_peak(std::span<const double> focus_d, std::span<const double> sharpness);

}  // namespace focalstage
