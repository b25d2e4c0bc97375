#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "core/base/result.h"
#include "core/rig_measure/measurement.h"

namespace focalstage {

/// What a rig measured of itself, and of which rig it was: its name and kind.
struct KeptMeasurement {
  std::string rig;
  RigMeasurement measurement;

  bool operator==(const KeptMeasurement&) const = default;
};

/// JSON text; reading it back gives the same (docs/formats/measured.md).
std::string measurement_text(const KeptMeasurement& kept);
Result<KeptMeasurement> parse_measurement(std::string_view text, const std::string& source);

/// Nothing where there is no such file. Faults "json.*", "measured.schema", "file.*".
Result<std::optional<KeptMeasurement>> load_measurement(const std::filesystem::path& file);
Status save_measurement(const std::filesystem::path& file, const KeptMeasurement& kept);

}  // namespace focalstage
