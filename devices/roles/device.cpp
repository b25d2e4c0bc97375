#include "devices/roles/device.h"

namespace focalstage {

const char* name_of(DevicePhase phase) {
  switch (phase) {
    case DevicePhase::off:
      return "off";
    case DevicePhase::ready:
      return "ready";
    case DevicePhase::running:
      return "running";
    case DevicePhase::lost:
      return "lost";
    case DevicePhase::refused:
      return "refused";
  }
  return "off";
}

}  // namespace focalstage
