#pragma once

#include <cstdint>
#include <vector>

#include "core/base/result.h"
#include "devices/mcc1208/settings.h"
#include "devices/roles/lens_drive.h"

namespace focalstage {

/// "mcc1208.settings" names the setting that makes no sense; with such nothing is opened.
Status check_mcc1208(const Mcc1208Settings& settings);

/// The limit of the settings in amperes: what the codes of channel 0 reach where that is less, and never beyond the
/// hard one. 0 where the amplifier is not told.
double mcc1208_most_a(const Mcc1208Settings& settings);

/// Code of channel 0 for a current, cut at the limit; `clamped` counts those that were.
int mcc1208_code(double drive_a, const Mcc1208Settings& settings, std::uint64_t& clamped);

/// One period as the device plays it.
struct Mcc1208Wave {
  std::uint32_t pacer = 0;
  double period_s = 0.0;            ///< by the device's clock
  int first_code = 0;               ///< of channel 0
  std::vector<std::uint8_t> bytes;  ///< scans of both channels: the lens, and the sync edge at the first
  std::vector<int> codes;           ///< of channel 0, the same
  int pulse_scans = 1;              ///< that the sync edge stays high
  std::uint64_t clamped = 0;
};

/// Sampled again by linear interpolation, the period being a ring. "drive.unable" names what it cannot make.
Result<Mcc1208Wave> mcc1208_wave(const DrivePeriod& period, const Mcc1208Settings& settings);

/// From no current to `first_code` in the settings' ramp, before the first period: whole packets, no edge.
std::vector<std::uint8_t> mcc1208_lead_in(int first_code, double scans_per_s, const Mcc1208Settings& settings);

}  // namespace focalstage
