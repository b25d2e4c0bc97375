#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace focalstage {

struct FollowSettings {
  double period_s = 0.0;      ///< the projector's
  double wanted_s = 0.0;      ///< the lens drive's edge after the projector's, 0 to the period
  double most_off_s = 20e-6;  ///< in step no further off than this
  std::size_t looks = 16;  ///< at the edge, whose mean counts without those that were stamped late: edges come with the
                           ///< steps of the drive's own time
  double queue_s = 0.15;   ///< from asking the drive to what it then plays, about
  double settle_s = 0.4;   ///< until that must be seen: the queue, and the board's next answer
  double most_correction = 1e-3;  ///< of the drive's period, either way
  double gap_s = 0.5;             ///< without a look for so long, it begins to look anew
};

/// What the lens drive is to do from its next free period on.
struct Steering {
  double period_s = 0.0;  ///< its periods, by its own clock
  double later_s = 0.0;   ///< and once, spread over as many as it takes

  bool operator==(const Steering&) const = default;
};

/// Keeps a lens drive in step with a projector that is the clock, from where a board sees the drive's edge against the
/// projector's. It looks, corrects the phase whole and the drive's period by what the phase crept since the last
/// correction, waits until that must be seen, and looks again. Pure.
class BeatFollower {
 public:
  BeatFollower() = default;
  explicit BeatFollower(const FollowSettings& settings);

  /// Another place for the drive's edge, of a projector's period that is known better by now.
  void want(double wanted_s) { settings_.wanted_s = wanted_s; }

  /// At `seen_s`, by the drive's periods, its edge was seen `after_s` after the projector's, of a period as the
  /// settings have it; what is to be done about it.
  std::optional<Steering> sees(double seen_s, double after_s);

  /// As of the newest looks the drive is within the bound, and was before.
  bool in_step() const;

  /// How late the edge was against where it is wanted, at the newest looks.
  std::optional<double> late_s() const { return late_s_; }

 private:
  double late(double after_s) const;
  std::optional<Steering> correct(double seen_s);

  FollowSettings settings_;
  std::vector<double> looks_s_;
  double first_look_s_ = 0.0;
  double look_from_s_ = -1e300;
  double looked_s_ = -1e300;
  double steer_period_s_ = 0.0;
  std::optional<double> late_s_;
  std::optional<double> corrected_from_s_;
  int well_ = 0;  ///< corrections in a row that found it within the bound
};

}  // namespace focalstage
