#include "devices/rig/trigger_watch.h"

#include <algorithm>

namespace focalstage {

namespace {
// Two looks further apart tell nothing of what was between them.
constexpr double longest_between_looks_s = 0.004;
// Pauses within this share of the longest count as longest.
constexpr double alike = 0.8;
}  // namespace

TriggerWatch::TriggerWatch(const std::vector<TableTrigger>& triggers, double period_s) : per_period_(triggers.size()) {
  std::vector<double> pauses_s;
  for (std::size_t i = 0; i < triggers.size(); ++i) {
    const double next_s = i + 1 < triggers.size() ? triggers[i + 1].at_s : triggers[0].at_s + period_s;
    pauses_s.push_back(next_s - triggers[i].at_s);
  }
  if (pauses_s.empty()) return;
  const double least_s = alike * *std::ranges::max_element(pauses_s);
  pause_s_ = 0.5 * least_s;
  for (std::size_t i = 0; i < pauses_s.size(); ++i) {
    if (pauses_s[i] >= least_s) {
      standing_.push_back((i + 1) % per_period_);
    } else {
      pause_s_ = std::max(pause_s_, pauses_s[i]);
    }
  }
}

bool TriggerWatch::sample(double time_s, std::uint64_t exposures) {
  const bool blind = time_s - last_s_ > longest_between_looks_s;
  last_s_ = time_s;
  if (blind || count_ != exposures) {
    count_ = exposures;
    since_s_ = time_s;
    return true;
  }
  const bool begun = exposures > 0;
  if (per_period_ == 0 || !begun || time_s - since_s_ < pause_s_) return true;
  const std::uint64_t stands = exposures % per_period_;
  if (std::ranges::find(standing_, stands) != standing_.end()) {
    wrong_.reset();
    return true;
  }
  const bool new_pause = !wrong_ || wrong_->exposures != exposures;
  const bool again = wrong_ && new_pause && wrong_->stands == stands;
  if (new_pause) wrong_ = Wrong{exposures, stands};
  return !again;
}

}  // namespace focalstage
