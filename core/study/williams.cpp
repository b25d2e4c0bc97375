#include "core/study/williams.h"

#include <algorithm>

namespace focalstage {

std::vector<int> WilliamsDesign::row(int square, int line) const {
  std::vector<int> order;
  // 0, 1, n-1, 2, n-2, ...: all differences between neighbours are different. Each line adds one to all.
  for (int place = 0; place < treatments_; ++place) {
    const int zigzag = place % 2 == 1 ? (place + 1) / 2 : (treatments_ - place / 2) % treatments_;
    order.push_back((zigzag + line) % treatments_);
  }
  if (square % squares() == 1) std::ranges::reverse(order);
  return order;
}

}  // namespace focalstage
