#pragma once

#include <filesystem>
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
  /// `describe`: what the rig says without it. A file that was made on another rig (by name and kind) is left alone and
  /// logged. Faults as load_measurement's.
  static Result<std::unique_ptr<MeasuredValues>> open(const std::filesystem::path& folder, DescribeRig describe);

  /// From now on, and over a restart. "file.unwritable": nothing changes.
  Status keep(const RigMeasurement& measurement);

  /// The rig with what was measured: latency, shutters (of the two eyes the slower), both lenses at the harmonics of
  /// `frequency_hz` as far as they were measured.
  RigDescription describe(double frequency_hz) const;

 private:
  MeasuredValues(std::filesystem::path file, DescribeRig describe)
      : file_(std::move(file)), plain_(std::move(describe)) {}

  std::filesystem::path file_;
  DescribeRig plain_;
  mutable std::mutex mutex_;
  std::optional<RigMeasurement> measurement_;
};

/// `rig` with the values of `measurement`.
RigDescription with_measured(RigDescription rig, const RigMeasurement& measurement);

}  // namespace focalstage
