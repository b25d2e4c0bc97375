#include <algorithm>
#include <cmath>

#include "core/check/rules.h"
#include "core/check/words.h"
#include "core/schedule/waveform.h"

namespace focalstage {
namespace {

void check_rate(const Project& project, std::vector<Finding>& findings) {
  const double sweep_hz = project.sweep.frequency_hz;
  const double rate_hz = project.frames.rate_hz;
  const double sweeps = sweep_hz / rate_hz;  // per frame
  if (!(sweep_hz > 0.0) || !(rate_hz > 0.0)) return;
  if (sweeps > 0.5 && std::abs(sweeps - std::round(sweeps)) <= rounding * sweeps) return;
  const double nearest_hz = sweep_hz / std::max(1.0, std::round(sweeps));
  findings.push_back({Severity::error,
                      "frames.rate",
                      "/frames/rate_hz",
                      "a frame at " + words(rate_hz) + " Hz plays for " + words(sweeps) +
                          " sweeps, not a whole number; the nearest rate that does is " + words(nearest_hz) + " Hz",
                      Amount{rate_hz, nearest_hz, "Hz"},
                      {}});
}

void check_flicker(const Project& project, std::vector<Finding>& findings) {
  const double sweep_hz = project.sweep.frequency_hz;
  if (!(sweep_hz < slowest_sweep_hz)) return;
  findings.push_back({Severity::warning,
                      "safety.flicker",
                      "/sweep/frequency_hz",
                      "a sweep at " + words(sweep_hz) + " Hz flickers visibly, which can harm photosensitive viewers",
                      Amount{sweep_hz, slowest_sweep_hz, "Hz"},
                      {}});
}

}  // namespace

std::vector<Finding> sweep_findings(const Project& project) {
  std::vector<Finding> findings;
  check_rate(project, findings);
  check_flicker(project, findings);
  return findings;
}

}  // namespace focalstage
