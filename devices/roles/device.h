#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"

namespace focalstage {

/// A device that is plugged in, as its driver's `probe` finds it without disturbing it.
struct DeviceId {
  std::string driver;   ///< the folder of its driver: "lightcrafter", "mcc1208", "uno"
  std::string model;    ///< in words: "USB-1208FS-Plus"
  std::string serial;   ///< what tells two of them apart; empty where the device has none
  std::string address;  ///< where it is now: "/dev/ttyACM0", "usb 1-2"; may change with every plugging in

  bool operator==(const DeviceId&) const = default;
};

enum class DevicePhase {
  off,      ///< not opened, or closed
  ready,    ///< answers; gives nothing out
  running,  ///< gives out what it is asked to
  lost,     ///< it answered and no longer does: unplugged, silent, or broken; see the fault
  refused,  ///< what is there cannot be used, and waiting will not mend it; see the fault
};
const char* name_of(DevicePhase phase);

struct DeviceTemperature {
  std::string part;  ///< "left lens", "projector"
  double celsius = 0.0;
};

/// How a device stands now.
struct DeviceState {
  DevicePhase phase = DevicePhase::off;
  std::optional<Fault>
      fault;             ///< where lost or refused; or why it went dark by itself, until it is told to (`dark`, `stop`)
  double heard_s = 0.0;  ///< when it last answered well (monotonic clock, devices/roles/clock.h); 0: never
  std::vector<DeviceTemperature> temperatures;
};

/// What every device of a rig can do, whatever its role. A device works in threads of its own: calls may come from any
/// thread and none throws. Opening again after a loss is `open` again: by serial, since the address may be another.
class Device {
 public:
  Device() = default;
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;
  virtual ~Device() = default;

  /// Finds the device, makes it safe (dark, no current) and ready. Waits 3 s at most. Opening what is open changes
  /// nothing.
  virtual Status open() = 0;
  /// Safe first. Nothing may be asked of it afterwards but `open`.
  virtual void close() = 0;

  virtual DeviceId id() const = 0;
  virtual DeviceState state() const = 0;

  /// Makes it do something that a person in the room can see and that is safe to look at: a lamp that blinks. Waits 2 s
  /// at most; refused while running.
  virtual Status identify() = 0;
};

}  // namespace focalstage
