#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>

#include "core/base/result.h"
#include "devices/runtime/admission.h"
#include "io/rig_config/measurement_file.h"

namespace focalstage {

/// What the rig measured of itself, kept beside its shows as `DIR/measured.json`, and put in the place of what its
/// configuration says. Any thread may call.
class MeasuredValues {
 public:
  /// `describe`: what the rig says without it; `share_drive`: whether both its lenses get one current (RigSetup). A
  /// file that was made on another rig (by name and kind) is left alone and logged. Faults as load_measurement's.
  static Result<std::unique_ptr<MeasuredValues>> open(const std::filesystem::path& folder, DescribeRig describe,
                                                      std::function<bool()> share_drive = nullptr);

  /// From now on, and over a restart. "file.unwritable": nothing changes.
  Status keep(const RigMeasurement& measurement);

  /// The rig with what was measured: latency, shutters (of the two eyes the slower), both lenses at the harmonics of
  /// `frequency_hz` as far as they were measured. Where they share a drive, one response for both, halfway between
  /// theirs.
  RigDescription describe(double frequency_hz) const;

 private:
  MeasuredValues(std::filesystem::path file, DescribeRig describe, std::function<bool()> share_drive)
      : file_(std::move(file)), plain_(std::move(describe)), share_drive_(std::move(share_drive)) {}

  std::filesystem::path file_;
  DescribeRig plain_;
  std::function<bool()> share_drive_;
  mutable std::mutex mutex_;
  std::optional<RigMeasurement> measurement_;
};

/// `rig` with the values of `measurement`.
RigDescription with_measured(RigDescription rig, const RigMeasurement& measurement);

}  // namespace focalstage
