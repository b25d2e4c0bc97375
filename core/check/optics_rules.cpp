#include <algorithm>

#include "core/check/rules.h"
#include "core/check/words.h"
#include "core/schedule/drive_load.h"
#include "core/schedule/schedule.h"
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

/// Names the drive of one eye where it asks more of a lens than it bears: the worse of peak and heat, each against its
/// own limit.
void check_drive(const Project& project, const Schedule& schedule, Side eye, std::vector<Finding>& findings) {
  if (!PowerCurve::make(project.sweep, eye)) return;  // schedule.waveform says so
  const LensLimits limits = project.glasses.lens_limits.value_or(LensLimits{});
  const DriveLoad load = load_of(schedule.lens_drive_a[eye]);
  const bool hot = load.rms_a / limits.max_rms_current_a > load.peak_a / limits.max_current_a;
  const double current_a = hot ? load.rms_a : load.peak_a;
  const double limit_a = hot ? limits.max_rms_current_a : limits.max_current_a;
  if (!(current_a > limit_a + rounding)) return;
  findings.push_back({Severity::error,
                      "optics.lens-current",
                      waveform_pointer(project.sweep, eye),
                      std::string("the drive takes ") + words(current_a) +
                          (hot ? " A in the root mean square, " : " A, ") + "more than the " + words(limit_a) +
                          " A that a lens may get",
                      Amount{current_a, limit_a, "A"},
                      {}});
}

/// One finding a waveform: that of the worse eye where both share it.
void check_drives(const Project& project, std::vector<Finding>& findings) {
  const Schedule schedule = make_schedule(project, {}).schedule;
  std::vector<Finding> beyond;
  for (const Side eye : both_sides) check_drive(project, schedule, eye, beyond);
  const auto excess = [](const Finding& finding) { return finding.amount->value / finding.amount->limit; };
  if (beyond.size() == 2 && beyond[0].where == beyond[1].where) {
    beyond.erase(excess(beyond[0]) < excess(beyond[1]) ? beyond.begin() : beyond.begin() + 1);
  }
  findings.insert(findings.end(), beyond.begin(), beyond.end());
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
  check_drives(project, findings);
  return findings;
}

}  // namespace focalstage
