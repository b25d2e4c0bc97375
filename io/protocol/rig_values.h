#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/rig_measure/measurement.h"
#include "core/scene/project.h"

namespace focalstage {

/// What a rig says of itself: enough to compile for it.
struct RigDescription {
  std::string name;
  std::string kind;  ///< "sim" or the hardware's
  std::vector<Projector> projectors;
  Glasses glasses;                  ///< measured lens response per eye, shutter times, limits
  double frequency_hz = 60.0;       ///< of the sweep whose harmonics the lens response lists
  double lens_current_max_a = 0.0;  ///< limits of the rig's own configuration
  double shutter_changes_per_s_max = 0.0;
  std::optional<RigMeasurement> measurement = {};  ///< of the newest self-test, whose values are those above

  bool operator==(const RigDescription&) const = default;
};

/// Asked beside delivered for one exposure, worst over the sweeps watched.
struct SlotReport {
  int slot = 0;
  int image = 0;
  int eye = 0;
  double asked_power_d = 0.0;
  double delivered_power_d = 0.0;
  double asked_s = 0.0;
  double delivered_s = 0.0;
  bool right_image = false;
  bool own_shutter_open = false;
  bool other_shutter_closed = false;
  bool delivered = false;  ///< all of it within 0.02 D and 20 us
  std::uint64_t exposures = 0;
  std::uint64_t missed = 0;
  double asked_smear_d = 0.0;  ///< how much the power changes over the exposure
  double delivered_smear_d = 0.0;
  bool unmeasured = false;  ///< the rig can't see its light: what is said to be delivered means nothing

  bool operator==(const SlotReport&) const = default;
};

/// How many sweeps were handed over at most so much later than planned, and later than the bin before.
struct LatenessBin {
  double up_to_us = 0.0;  ///< infinite in the last
  std::uint64_t sweeps = 0;

  bool operator==(const LatenessBin&) const = default;
};

struct Temperature {
  std::string part;
  double celsius = 0.0;

  bool operator==(const Temperature&) const = default;
};

/// A device that is plugged in.
struct DeviceReport {
  std::string driver;
  std::string model;
  std::string serial;   ///< empty where it has none
  std::string address;  ///< where it is now

  bool operator==(const DeviceReport&) const = default;
};

/// A driver that could not look.
struct DriverFailure {
  std::string driver;
  Fault fault;

  bool operator==(const DriverFailure&) const = default;
};

struct DeviceListing {
  std::vector<DeviceReport> devices;
  std::vector<DriverFailure> failures;

  bool operator==(const DeviceListing&) const = default;
};

/// One device that a rig is made of.
struct PartReport {
  DeviceReport device;
  std::string phase;  ///< "off", "ready", "running", "lost", "refused"
  std::string fault;  ///< empty when none

  bool operator==(const PartReport&) const = default;
};

struct RigState {
  std::string state;        ///< "empty", "ready", "playing", "holding", "dark"
  std::string show_sha256;  ///< empty where a live revision is there instead
  std::uint64_t sweeps = 0;
  std::uint64_t missed_exposures = 0;
  double lens_phase = 0.0;
  double temperature_c = 0.0;  ///< of the warmest part
  std::string fault;           ///< latched; empty when none
  std::vector<SlotReport> slots;
  std::string holder;  ///< who holds the rig; empty when nobody
  int frame = 0;       ///< of the show; of the project where a live revision is there
  std::uint64_t late_sweeps = 0;
  std::vector<LatenessBin> lateness;
  std::uint64_t revision = 0;  ///< of the live link whose frame this is; 0: a show that was pushed
  std::vector<Temperature> temperatures;
  double pose_to_light_ms = 0.0;  ///< from light on the tracker's sensors to the sweep that shows it; 0: none tracked
  std::vector<PartReport> parts;

  bool operator==(const RigState&) const = default;
};

}  // namespace focalstage
