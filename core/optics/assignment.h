#pragma once

#include <cstddef>
#include <vector>

#include "core/scene/project.h"

namespace focalstage {

/// How much of the light that wants one power goes into each slice. The weights over all slices sum to one.
///
/// nearest: wholly to the closest power, the lower one on a tie. linear: to the two neighbours by distance in dioptres
/// (Eq. 4 with the erratum: n the lower neighbour). Beyond the outermost power: wholly to that slice. Of slices with
/// the same power the first gets all.
class SliceRule {
 public:
  SliceRule(const std::vector<double>& powers_d, Assignment assignment);

  std::size_t count() const { return bands_.size(); }

  /// Weight of slice `n` (the index in the project's list) for light that wants `power_d`.
  double weight(std::size_t n, double power_d) const;

  /// The wanted powers for which slice `n` has any weight: the closed range [from_d, to_d].
  struct Band {
    double from_d;   ///< where its weight leaves zero; -infinity for the lowest
    double power_d;  ///< its own power
    double to_d;     ///< where its weight is zero again; +infinity for the highest
    bool empty;      ///< a slice that repeats an earlier one's power
  };
  const Band& band(std::size_t n) const { return bands_[n]; }

  Assignment assignment() const { return assignment_; }

  double lowest_d() const { return lowest_d_; }
  double highest_d() const { return highest_d_; }

  /// How far `power_d` lies beyond the outermost slice; 0 within.
  double beyond_d(double power_d) const;

  /// Whether `power_d` lies below the lowest slice.
  bool is_below(double power_d) const { return power_d < lowest_d_; }

 private:
  Assignment assignment_;
  std::vector<Band> bands_;
  double lowest_d_ = 0.0;
  double highest_d_ = 0.0;
};

}  // namespace focalstage
