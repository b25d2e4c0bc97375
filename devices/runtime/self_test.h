#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/rig_measure/lens_fit.h"
#include "core/rig_measure/measurement.h"
#include "devices/player/limits.h"
#include "devices/runtime/light_watch.h"
#include "devices/runtime/measuring_show.h"
#include "devices/runtime/rig_setup.h"
#include "devices/runtime/rig_thread.h"

namespace focalstage {

struct SelfTestSettings {
  double frequency_hz = 60.0;
  int harmonics = 4;
  int traces = 24;       ///< of everything but the lenses
  int lens_traces = 12;  ///< of each drive and line
};

/// Said of a rig that has none.
Fault no_light_sensor();

/// A rig that measures itself (docs/self-test.md): plays what is to be measured, looks through the light sensor, works
/// out what it saw. Of one thread; leaves the rig dark, however it ends, and the show that was there in its place.
class SelfTest {
 public:
  /// `may_go_on`: a fault of it (a lost lease, a client that went) ends the test. `tell`: what is done now, and how
  /// much of all is done.
  SelfTest(RigThread& rig, const RigSetup& setup, const RigLimits& limits, const SelfTestSettings& settings,
           std::function<Status()> may_go_on, std::function<void(const std::string&, double)> tell);

  /// `setup` has a light sensor.
  /// "rig.refused" (something plays, or the rig is dark), "measure.*", "light.*", and whatever
  /// made the rig dark meanwhile.
  Result<RigMeasurement> run();

 private:
  Status ready() const;
  Status begin_in_the_dark();
  Result<RigMeasurement> measure();
  Status show(const MeasuringStep& step, const std::string& doing);
  Status may_go_on() const;
  Result<LightTraces> look(Side eye, const PeriodWindow& window, int traces) const;
  Result<FullLight> full_light(Side eye, bool early, const std::string& doing);
  Status check_sides(Side eye, double own_swing) const;
  Status measure_shutter(Side eye);
  Status measure_latency();
  Status measure_lens(Side eye);
  Status look_through(Side eye, bool early, const LensFitTask& task, std::vector<LensLook>& looks);
  double delay_spread_s() const;
  std::vector<KnownPower> known_powers() const;

  RigThread& rig_;
  const RigSetup& setup_;
  RigLimits limits_;
  SelfTestSettings settings_;
  std::function<Status()> others_may_;
  std::function<void(const std::string&, double)> tell_;
  double period_s_;
  RigDescription nominal_;
  LightWatch watch_;
  PerEye<DarkLight> dark_;
  RigMeasurement found_;
  int steps_done_ = 0;
  bool playing_ = false;
  mutable double looked_s_ = 0.0;
};

}  // namespace focalstage
