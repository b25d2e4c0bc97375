#pragma once

#include <vector>

namespace focalstage {

/// A design of Williams (1949, "Experimental designs balanced for the estimation of residual effects of treatments"):
/// orders of `treatments` things in which, over all rows, each stands at each place equally often and each follows each
/// other one equally often. An even number needs one Latin square, an odd one two, the second the mirror of the first.
class WilliamsDesign {
 public:
  explicit WilliamsDesign(int treatments) : treatments_(treatments) {}

  int treatments() const { return treatments_; }
  int squares() const { return treatments_ % 2 == 0 || treatments_ == 1 ? 1 : 2; }
  int rows() const { return treatments_ * squares(); }

  /// One row of one square; both are taken modulo how many there are.
  std::vector<int> row(int square, int line) const;

 private:
  int treatments_;
};

}  // namespace focalstage
