#pragma once

#include <span>
#include <vector>

namespace focalstage {

/// Something in a row that has several forms, each narrower than the one before; a width of 0: gone.
struct BarItem {
  std::vector<float> widths;
  std::vector<int> gives;  ///< one per step to the next form: those with smaller numbers are taken first
};

/// Which form each item takes so that all of them and the gaps between fit into `room`, the least important having
/// given way. Where nothing more can give way, the smallest forms.
std::vector<std::size_t> fit_bar(std::span<const BarItem> items, float room, float gap);

}  // namespace focalstage
