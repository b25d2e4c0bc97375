#include "devices/rig/beat_follower.h"

#include <algorithm>
#include <cmath>

namespace focalstage {

namespace {

// Of a creeping phase, so much is put right at each correction once it is small: the looks have noise of their own.
constexpr double small_creep_share = 0.3;
// So often it must have been within the bound.
constexpr int well_enough = 2;

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

}  // namespace

BeatFollower::BeatFollower(const FollowSettings& settings) : settings_(settings), steer_period_s_(settings.period_s) {}

/// Within half a period either way.
double BeatFollower::late(double after_s) const {
  const double off_s = after_s - settings_.wanted_s;
  return off_s - settings_.period_s * std::round(off_s / settings_.period_s);
}

std::optional<Steering> BeatFollower::sees(double now_s, double after_s) {
  if (now_s - looked_s_ > settings_.silence_s) looks_s_.clear();
  looked_s_ = now_s;
  if (now_s < look_from_s_) return std::nullopt;
  // Around the first look, so that an edge half a period off is not torn in two.
  double late_s = late(after_s);
  if (!looks_s_.empty()) {
    late_s += settings_.period_s * std::round((looks_s_.front() - late_s) / settings_.period_s);
  }
  if (looks_s_.empty()) first_look_s_ = now_s;
  looks_s_.push_back(late_s);
  return looks_s_.size() < settings_.looks ? std::nullopt : correct(now_s);
}

std::optional<Steering> BeatFollower::correct(double now_s) {
  const double found_s = median(looks_s_);
  const double middle_s = 0.5 * (first_look_s_ + now_s);
  looks_s_.clear();
  late_s_ = found_s;
  const bool well = std::abs(found_s) <= settings_.most_off_s;
  well_ = well ? well_ + 1 : 0;
  // What is found after a correction of all that was wrong crept in since, and creeps on until the drive plays what it
  // is told now. A whole phase says nothing of that yet.
  double creep = 0.0;
  if (corrected_from_s_ && std::abs(found_s) < 0.1 * settings_.period_s) {
    creep = (well ? small_creep_share : 1.0) * found_s / (middle_s - *corrected_from_s_);
    const double most_s = settings_.most_correction * settings_.period_s;
    steer_period_s_ =
        std::clamp(steer_period_s_ * (1.0 - creep), settings_.period_s - most_s, settings_.period_s + most_s);
  }
  const double effect_s = now_s + settings_.queue_s;
  const double due_s = found_s + creep * (effect_s - middle_s);
  corrected_from_s_ = middle_s;  // what creeps on until the drive plays it is in this correction, or in the next
  // A phase is put right by a hundredth of each period.
  look_from_s_ = now_s + settings_.settle_s + 100.0 * std::abs(due_s);
  return Steering{steer_period_s_, -due_s};
}

bool BeatFollower::in_step(double now_s) const {
  const double patience_s = settings_.settle_s + settings_.silence_s;
  return well_ >= well_enough && now_s - looked_s_ <= patience_s;
}

}  // namespace focalstage
