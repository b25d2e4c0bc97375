#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "core/rig_measure/lens_drives.h"
#include "devices/player/player.h"
#include "io/protocol/rig_values.h"

namespace focalstage {

/// What the projector shows while something is measured.
struct MeasuringPicture {
  enum class Kind { black, white, rectangle };
  Kind kind = Kind::black;
  std::array<int, 4> rectangle_px{};  ///< left, top, width, height: white, all else black
};

/// When something begins and ends, as shares of the period from its sync edge; the end may lie in the next one.
struct PeriodWindow {
  double from = 0.0;
  double to = 0.0;
};

/// One thing to be measured: what the rig does in every sweep meanwhile.
struct MeasuringStep {
  MeasuringPicture picture;
  std::optional<PeriodWindow> light;            ///< exposures one after the other; none: no trigger at all
  bool one_exposure = false;                    ///< the first of them alone
  PerEye<std::optional<PeriodWindow>> shutter;  ///< open so long; none: closed
  DriveTones drive;                             ///< of both lenses
};

/// When the exposures of a step begin and how long each is, for a rig of that description. At most 30: what a trigger
/// board takes. Their light is planned by the latency that the rig is thought to have.
struct MeasuringLight {
  std::vector<double> start_s;
  double exposure_s = 0.0;
};
MeasuringLight measuring_light(const MeasuringStep& step, const RigDescription& rig, double period_s);

/// The step as a show that plays over and over. `on_light`: as LoadedShow has it.
std::shared_ptr<const LoadedShow> measuring_show(const MeasuringStep& step, const RigDescription& rig, double period_s,
                                                 std::function<void()> on_light);

}  // namespace focalstage
