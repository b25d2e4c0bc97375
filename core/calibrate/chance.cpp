#include "core/calibrate/chance.h"

#include <algorithm>
#include <cmath>

#include "core/base/distributions.h"

namespace focalstage {

double chance_of_gain(double all, double rest, double equations, double rest_freedom) {
  if (rest <= 0.0) return 0.0;
  const double f = std::max(all - rest, 0.0) / equations / (rest / rest_freedom);
  return std::isfinite(f) ? f_upper_tail(f, equations, rest_freedom) : 0.0;
}

}  // namespace focalstage
