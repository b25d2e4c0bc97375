#include <algorithm>
#include <numeric>

#include "core/check/rules.h"
#include "core/check/words.h"

namespace focalstage {

std::vector<Finding> slice_findings(const Project& project) {
  const std::vector<double>& powers_d = project.slices.powers_d;
  std::vector<std::size_t> order(powers_d.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return powers_d[a] < powers_d[b]; });

  std::vector<Finding> findings;
  for (std::size_t i = 1; i < order.size(); ++i) {
    const double below_d = powers_d[order[i - 1]];
    const double own_d = powers_d[order[i]];
    const double gap_d = own_d - below_d;
    if (!(gap_d > wide_spacing_d + rounding)) continue;
    const bool error = gap_d > widest_spacing_d + rounding;
    const double limit_d = error ? widest_spacing_d : wide_spacing_d;
    findings.push_back({error ? Severity::error : Severity::warning,
                        "slices.spacing",
                        slice_pointer(order[i]),
                        "the slices at " + words(below_d) + " D and " + words(own_d) + " D lie " + words(gap_d) +
                            " D apart; what lies between them blurs when they do over " + words(limit_d) + " D",
                        Amount{gap_d, limit_d, "D"},
                        {}});
  }
  return findings;
}

}  // namespace focalstage
