#include "core/calibrate/chance.h"

#include <algorithm>
#include <boost/math/distributions/fisher_f.hpp>
#include <cmath>

namespace focalstage {

namespace {

// What is asked outside a distribution's domain comes back as NaN: no exception leaves this file.
namespace bm = boost::math;
using Policy = bm::policies::policy<
    bm::policies::domain_error<bm::policies::ignore_error>, bm::policies::overflow_error<bm::policies::ignore_error>,
    bm::policies::pole_error<bm::policies::ignore_error>, bm::policies::evaluation_error<bm::policies::ignore_error>>;
using FisherF = bm::fisher_f_distribution<double, Policy>;

}  // namespace

double chance_of_gain(double all, double rest, double equations, double rest_freedom) {
  if (rest <= 0.0) return 0.0;
  const double f = std::max(all - rest, 0.0) / equations / (rest / rest_freedom);
  if (!std::isfinite(f)) return 0.0;
  return bm::cdf(bm::complement(FisherF(equations, rest_freedom), f));
}

}  // namespace focalstage
