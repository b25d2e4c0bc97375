#include "core/check/rules.h"
#include "core/check/words.h"
#include "core/schedule/waveform.h"

namespace focalstage {
namespace {

/// Names `power_d` where it lies outside what the lens can do.
void check_power(const Project& project, const std::string& what, double power_d, const std::string& where,
                 std::vector<Finding>& findings) {
  const auto& [lowest_d, highest_d] = project.glasses.lens_range_d;
  const bool below = power_d < lowest_d - rounding;
  const bool above = power_d > highest_d + rounding;
  if (!below && !above) return;
  const double limit_d = below ? lowest_d : highest_d;
  findings.push_back({Severity::error,
                      "optics.lens-range",
                      where,
                      what + " at " + words(power_d) + " D is beyond the lens, which ends at " + words(limit_d) + " D",
                      Amount{power_d, limit_d, "D"},
                      {}});
}

void check_measured(const Project& project, Side eye, std::vector<Finding>& findings) {
  const Result<PowerCurve> curve = PowerCurve::make(project.sweep, eye);
  if (!curve) return;  // schedule.waveform says so
  std::vector<Finding> beyond;
  const std::string where = waveform_pointer(project.sweep, eye);
  check_power(project, "the sweep's lowest power", curve->min_d(), where, beyond);
  check_power(project, "the sweep's highest power", curve->max_d(), where, beyond);
  if (!beyond.empty()) findings.push_back(beyond.front());  // one waveform, one finding
}

}  // namespace

std::vector<Finding> optics_findings(const Project& project) {
  std::vector<Finding> findings;
  const PerEye<Waveform>& waveform = project.sweep.waveform;
  if (!waveform.left || !waveform.right) {
    check_power(project, "the sweep's lowest power", project.sweep.min_power_d, "/sweep/min_power_d", findings);
    check_power(project, "the sweep's highest power", project.sweep.max_power_d, "/sweep/max_power_d", findings);
  }
  if (waveform.left) check_measured(project, Side::left, findings);
  if (waveform.right && waveform.right != waveform.left) check_measured(project, Side::right, findings);
  for (std::size_t i = 0; i < project.slices.powers_d.size(); ++i) {
    check_power(project, "the slice", project.slices.powers_d[i], slice_pointer(i), findings);
  }
  return findings;
}

}  // namespace focalstage
