#include "core/base/distributions.h"

#include <boost/math/distributions/fisher_f.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>

namespace focalstage {
namespace {

// What is asked outside a distribution's domain comes back as NaN: no exception leaves this file.
namespace bm = boost::math;
using Policy = bm::policies::policy<
    bm::policies::domain_error<bm::policies::ignore_error>, bm::policies::overflow_error<bm::policies::ignore_error>,
    bm::policies::pole_error<bm::policies::ignore_error>, bm::policies::evaluation_error<bm::policies::ignore_error>>;
using FisherF = bm::fisher_f_distribution<double, Policy>;
using StudentsT = bm::students_t_distribution<double, Policy>;

}  // namespace

double f_upper_tail(double f, double df1, double df2) { return bm::cdf(bm::complement(FisherF(df1, df2), f)); }

double t_two_sided(double t, double df) { return 2.0 * bm::cdf(bm::complement(StudentsT(df), std::abs(t))); }

double t_quantile(double share, double df) { return bm::quantile(StudentsT(df), share); }

}  // namespace focalstage
