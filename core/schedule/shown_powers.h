#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "core/base/sides.h"
#include "core/scene/project.h"

namespace focalstage {

/// When each of some powers is shown to each eye, as the scheduler times it.
class ShownPowers {
 public:
  ShownPowers(const Project& project, const std::vector<double>& powers_d);

  /// In both eyes, without a shutter in the way.
  bool whole(std::size_t i) const { return at_[i].eyes == 2; }
  double smear_d(std::size_t i) const { return at_[i].smear_d; }

  /// Between the starts of two exposures of one eye, in the eye where it is less.
  double apart_s(std::size_t i, std::size_t j) const {
    const auto apart = [&](Side eye) { return std::abs(at_[j].start_s[eye] - at_[i].start_s[eye]); };
    return std::min(apart(Side::left), apart(Side::right));
  }

  /// From the left eye's exposure to the right eye's of the same power, and round to the left one's again.
  double handover_s(std::size_t i) const { return at_[i].start_s.right - at_[i].start_s.left; }
  double wrap_s(std::size_t i) const { return period_s_ - handover_s(i); }

 private:
  struct At {
    PerEye<double> start_s;
    double smear_d = 0.0;
    int eyes = 0;
  };
  double period_s_;
  std::vector<At> at_;
};

}  // namespace focalstage
