#include "devices/mcc1208/pace.h"

#include <algorithm>
#include <cmath>

namespace focalstage {

void Mcc1208Pace::taken(double time_s) {
  late_s_[taken_ % late_s_.size()] = time_s - first_s_ - static_cast<double>(taken_) * period_s_;
  ++taken_;
  if (taken_ == late_s_.size()) first_late_s_ = least_late_s();
}

double Mcc1208Pace::least_late_s() const { return *std::min_element(late_s_.begin(), late_s_.end()); }

double Mcc1208Pace::start_s() const { return first_late_s_ ? first_s_ + least_late_s() - *first_late_s_ : first_s_; }

std::uint64_t Mcc1208Pace::begun(double now_s) const {
  if (period_s_ <= 0.0 || now_s < start_s()) return 0;
  const auto by_clock = static_cast<std::uint64_t>((now_s - start_s()) / period_s_) + 1;
  if (!first_late_s_) return std::min(by_clock, taken_ + 1);
  // What it keeps is known: it plays at most one period before it takes the next.
  const double kept = std::max(1.0 - *first_late_s_ / period_s_, 0.0);
  const auto played = static_cast<std::uint64_t>(std::max(static_cast<double>(taken_) - kept, 0.0));
  return std::clamp(by_clock, played + 1, played + 2);
}

double Mcc1208Pace::began_s(std::uint64_t number) const {
  return number == 0 ? 0.0 : start_s() + static_cast<double>(number - 1) * period_s_;
}

}  // namespace focalstage
