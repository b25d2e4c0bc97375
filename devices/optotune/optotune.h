#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "devices/optotune/packets.h"
#include "devices/optotune/settings.h"
#include "devices/roles/device.h"

namespace focalstage {

struct OptotuneReport {
  std::string lens_serial;  ///< as the lens says it; empty: it did not
  std::string firmware;     ///< type and version: "E 1.12.240.800"
  double most_a = 0.0;      ///< what full scale is now, as the device has it
  std::optional<OptotuneMode> mode;
  double asked_a = 0.0;       ///< after the limit
  std::uint64_t clamped = 0;  ///< currents that were beyond it
  std::optional<double> celsius;
  bool warm = false;  ///< from `warm_celsius` on
  OptotuneStatus status;
};

/// An Optotune Lens Driver 4 or 4i, for setting up, looking at temperatures and slow currents. It cannot be the rig's
/// lens drive: nothing keeps its generator in step with a projector. For a rig the coil hangs on another amplifier, or
/// this one follows its analogue input.
///
/// Faults: those of devices/serial, "optotune.missing", "optotune.which", "optotune.stranger", "optotune.damaged",
/// "optotune.limit" (it does not take the limit: nothing is driven), "optotune.hot", "optotune.off", "optotune.mode"
/// (it left its mode by itself), "optotune.current" (it says that a current flows that it should not), and what the
/// device refuses ("optotune.checksum", "optotune.unavailable", "optotune.unknown", "optotune.lens").
class OptotuneLens : public Device {
 public:
  /// Holds a current, cut at the limit. Refused in analogue mode, and while the lens is hot.
  virtual Status set_current(double amperes) = 0;
  /// From now on the analogue input gives the current, within the device's own limits; `stop` ends it.
  virtual Status follow_input() = 0;
  /// Halves the current five times and ends at zero in current mode, where the device says so itself, within 200 ms;
  /// another question that is under way may take that long as well. False: it did not say so.
  virtual bool stop() noexcept = 0;
  virtual OptotuneReport report() const = 0;
};

std::unique_ptr<OptotuneLens> make_optotune(const OptotuneSettings& settings);

}  // namespace focalstage
