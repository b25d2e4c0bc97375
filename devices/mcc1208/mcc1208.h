#pragma once

#include <memory>

#include "devices/mcc1208/settings.h"
#include "devices/roles/lens_drive.h"

namespace focalstage {

/// A USB-1208FS-Plus: channel 0 drives both lenses through the user's amplifier, channel 1 gives one rising edge at the
/// first sample of each period. `refill` returns the number that `DriveReport::periods` has once that period began, and
/// the period length must be the one that was started with. `clamped` counts the samples of each period that was handed
/// over, once.
///
/// Faults: "mcc1208.settings" (one makes no sense), "drive.unable" (a period that it cannot make), "drive.off" (not
/// open, or lost), "drive.running", "drive.stopped" (a stop came while it started); in the state also "drive.underrun"
/// (the host came too late, or the device says so), "drive.stalled" (it takes no more samples), and those of
/// devices/usb.
std::unique_ptr<LensDrive> make_mcc1208(const Mcc1208Settings& settings);

}  // namespace focalstage
