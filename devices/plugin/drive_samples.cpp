#include "devices/plugin/drive_samples.h"

#include <algorithm>
#include <cmath>

namespace focalstage {

namespace {

/// Straight lines between `from`, as `count` samples of the same period.
std::vector<double> sampled_again(const std::vector<double>& from, std::size_t count) {
  std::vector<double> out(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double at = static_cast<double>(i) * static_cast<double>(from.size()) / static_cast<double>(count);
    const auto k = static_cast<std::size_t>(at);
    out[i] = std::lerp(from[k], from[(k + 1) % from.size()], at - static_cast<double>(k));
  }
  return out;
}

}  // namespace

Result<DriveSamples> drive_samples(const DrivePeriod& period, const DriveAbilities& able, const std::string& where) {
  const auto& drive = period.drive_a;
  const auto unable = [&](const char* what) { return Fault{"drive.unable", where, what, ""}; };
  if (!(period.period_s > 0.0) || drive.left.empty() || drive.left.size() != drive.right.size()) {
    return unable("this is no period of current for two eyes");
  }
  if (!able.eyes_apart && drive.left != drive.right) return unable("it has one channel for both lenses");
  DriveSamples out{period.period_s * 1e9, drive, 0};
  for (std::vector<double>* eye : {&out.drive_a.left, &out.drive_a.right}) {
    const auto most = static_cast<std::size_t>(able.most_samples.value_or(0));
    if (most > 0 && eye->size() > most) *eye = sampled_again(*eye, most);
    for (double& a : *eye) {
      if (std::abs(a) <= able.most_a) continue;
      a = std::isnan(a) ? 0.0 : std::clamp(a, -able.most_a, able.most_a);
      ++out.clamped;
    }
  }
  return out;
}

}  // namespace focalstage
