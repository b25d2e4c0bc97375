#pragma once

#include <optional>
#include <vector>

#include "core/base/sides.h"
#include "devices/roles/device.h"

namespace focalstage {

struct LightAbilities {
  double step_s = 0.0;   ///< between samples
  int most_samples = 0;  ///< of one record
  int bits = 0;          ///< of a sample
};

/// What one eye's sensor is to look at.
struct LightRequest {
  Side eye = Side::left;
  double after_edge_s = 0.0;  ///< from a sync edge to the first sample, about: the record says when it really was
  int samples = 0;
  int edges_to_skip = 0;  ///< about so many first: records that come at the same moments of the mains add up its hum
};

/// What it saw. All times are by the sensor's own clock: whoever takes the record scales them by the sync edges'
/// period, which both know.
struct LightRecord {
  Side eye = Side::left;
  double after_edge_s = 0.0;
  double step_s = 0.0;
  double period_s = 0.0;      ///< of the sync edges
  std::vector<double> light;  ///< shares of the range: 0 at its lower end, 1 at its upper, where it is cut
};

/// What measures light behind each eye's lens and shutter, in step with the rig's sync edge (docs/self-test.md). Looks
/// only when it is asked to.
class LightSensor : public Device {
 public:
  virtual LightAbilities abilities() const = 0;

  /// One record, after one of the next sync edges; takes the place of what was armed before. Waits for no light.
  virtual Status arm(const LightRequest& request) = 0;

  /// What was armed, once all of it is there: once. "light.unsynced" where no sync edge came for half a second.
  virtual Result<std::optional<LightRecord>> take() = 0;
};

}  // namespace focalstage
