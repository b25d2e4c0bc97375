#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/base/sides.h"
#include "devices/plugin/focalstage_lens_drive.h"
#include "devices/roles/lens_drive.h"

namespace focalstage {

/// A period of current as a plugin may have it.
struct DriveSamples {
  double period_ns = 0.0;
  PerEye<std::vector<double>> drive_a;
  std::uint64_t clamped = 0;

  focalstage_drive_period told() const {
    return {period_ns, static_cast<std::uint32_t>(drive_a.left.size()), drive_a.left.data(), drive_a.right.data()};
  }
};

/// Cut to the limit (what is no number is none), and sampled again where that is more than it takes. "drive.unable" at
/// `where` for what is no period, and for eyes that differ where there is one channel.
Result<DriveSamples> drive_samples(const DrivePeriod& period, const DriveAbilities& able, const std::string& where);

}  // namespace focalstage
