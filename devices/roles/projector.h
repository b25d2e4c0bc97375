#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "devices/roles/device.h"
#include "devices/roles/picture.h"

namespace focalstage {

/// Who says when an exposure begins.
enum class Pacing {
  triggered,  ///< an electrical edge for each one: the rig's clock is elsewhere
  master,     ///< the projector itself: the rig follows the start of each of its periods
};

/// What a projector can do.
struct ProjectorAbilities {
  int width_px = 0;
  int height_px = 0;
  Pacing pacing = Pacing::triggered;
  double latency_s = 0.0;      ///< from trigger to light
  int most_periods_ahead = 2;  ///< that `post` takes before they are shown
};

/// What it shows in every period.
struct Exposures {
  double period_s = 0.0;
  PictureForm form;
  std::vector<double> start_s;  ///< of the light, from the period's start, in time order; one per picture
  double exposure_s = 0.0;      ///< of each

  bool operator==(const Exposures&) const = default;
};

struct ProjectorReport {
  double told_s = 0.0;          ///< when the counts stood so, on the monotonic clock
  std::uint64_t periods = 0;    ///< shown since `start`
  std::uint64_t exposures = 0;  ///< shown since `start`
  std::uint64_t missed = 0;     ///< triggered (or due, where it is the master) without a picture
  std::optional<double>
      newest_period_s;  ///< when the newest period began, on the monotonic clock; where it is the master
};

/// A projector that shows several pictures in each period. Whatever it is told, it is dark before `start`, after
/// `dark`, and by itself where nobody posts: then periods are black and counted as missed.
class ProjectorDevice : public Device {
 public:
  virtual ProjectorAbilities abilities() const = 0;

  /// Prepares what `start` begins; dark until then. "projector.unable" names what it cannot do. Waits 3 s at most.
  virtual Status arm(const Exposures& exposures) = 0;
  virtual Status start() = 0;

  /// The pictures of the next period that has none yet, one per exposure; none: a period in the dark. Does not wait:
  /// "projector.full" where as many periods as it takes are waiting.
  virtual Status post(std::vector<Picture> pictures) = 0;

  /// Light off within 200 ms, whatever goes on, and waiting periods forgotten; safe to call from a watchdog. False: it
  /// could not be told, and whatever else can make it dark is needed.
  virtual bool dark() noexcept = 0;

  virtual ProjectorReport report() const = 0;
};

}  // namespace focalstage
