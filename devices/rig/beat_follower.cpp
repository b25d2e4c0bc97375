#include "devices/rig/beat_follower.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace focalstage {

namespace {

// Of a creeping phase, so much is put right at each correction once it is small: the looks have noise of their own.
constexpr double small_creep_share = 0.3;
// And of a small phase.
constexpr double small_phase_share = 0.4;
// Further from the middle one a look is a late stamp.
constexpr double most_step_s = 30e-6;
// So often it must have been within the bound.
constexpr int well_enough = 2;

/// Of those that are not further from the middle one than steps of the drive's own time make them.
double mean_of_good(std::vector<double> values) {
  std::ranges::sort(values);
  const double middle = values[values.size() / 2];
  std::erase_if(values, [&](double value) { return std::abs(value - middle) > most_step_s; });
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

}  // namespace

BeatFollower::BeatFollower(const FollowSettings& settings) : settings_(settings), steer_period_s_(settings.period_s) {}

/// Within half a period either way.
double BeatFollower::late(double after_s) const {
  const double off_s = after_s - settings_.wanted_s;
  return off_s - settings_.period_s * std::round(off_s / settings_.period_s);
}

std::optional<Steering> BeatFollower::sees(double seen_s, double after_s) {
  if (seen_s - looked_s_ > settings_.gap_s) looks_s_.clear();
  looked_s_ = seen_s;
  if (seen_s < look_from_s_) return std::nullopt;
  // Around the first look, so that an edge half a period off is not torn in two.
  double late_s = late(after_s);
  if (!looks_s_.empty()) {
    late_s += settings_.period_s * std::round((looks_s_.front() - late_s) / settings_.period_s);
  }
  if (looks_s_.empty()) first_look_s_ = seen_s;
  looks_s_.push_back(late_s);
  return looks_s_.size() < settings_.looks ? std::nullopt : correct(seen_s);
}

std::optional<Steering> BeatFollower::correct(double seen_s) {
  const double found_s = mean_of_good(looks_s_);
  const double middle_s = 0.5 * (first_look_s_ + seen_s);
  looks_s_.clear();
  late_s_ = found_s;
  const bool well = std::abs(found_s) <= settings_.most_off_s;
  well_ = well ? well_ + 1 : 0;
  // What is found after a correction of all that was wrong crept in since, and creeps on until the drive plays what it
  // is told now. A whole phase says nothing of that yet.
  double creep = 0.0;
  if (corrected_from_s_ && std::abs(found_s) < 0.25 * settings_.period_s) {
    creep = (well ? small_creep_share : 1.0) * found_s / (middle_s - *corrected_from_s_);
    const double most_s = settings_.most_correction * settings_.period_s;
    steer_period_s_ =
        std::clamp(steer_period_s_ * (1.0 - creep), settings_.period_s - most_s, settings_.period_s + most_s);
  }
  const double effect_s = seen_s + settings_.queue_s;
  const double due_s = (well ? small_phase_share : 1.0) * found_s + creep * (effect_s - middle_s);
  corrected_from_s_ = middle_s;  // what creeps on until the drive plays it is in this correction, or in the next
  // A phase is put right by a hundredth of each period.
  look_from_s_ = seen_s + settings_.settle_s + 100.0 * std::abs(due_s);
  return Steering{steer_period_s_, -due_s};
}

bool BeatFollower::in_step() const { return well_ >= well_enough; }

}  // namespace focalstage
