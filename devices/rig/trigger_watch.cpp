#include "devices/rig/trigger_watch.h"

#include <algorithm>
#include <cmath>

namespace focalstage {

namespace {
// Two looks further apart tell nothing of what was between them.
constexpr double longest_between_looks_s = 0.004;
// Pauses within this share of the longest count as longest.
constexpr double alike = 0.8;
// From the longest of the others to these: so long a stand is none of the others', though counts come with jitter, and
// a look every millisecond or so sees that much of it.
constexpr double beyond_others = 0.4;
}  // namespace

TriggerWatch::TriggerWatch(const std::vector<TableTrigger>& triggers, double period_s) : per_period_(triggers.size()) {
  std::vector<double> pauses_s;
  for (std::size_t i = 0; i < triggers.size(); ++i) {
    const double next_s = i + 1 < triggers.size() ? triggers[i + 1].at_s : triggers[0].at_s + period_s;
    pauses_s.push_back(next_s - triggers[i].at_s);
  }
  if (pauses_s.empty()) return;
  const double longest_s = *std::ranges::max_element(pauses_s);
  double next_longest_s = 0.0;
  for (std::size_t i = 0; i < pauses_s.size(); ++i) {
    if (pauses_s[i] >= alike * longest_s) {
      standing_.push_back((i + 1) % per_period_);
    } else {
      next_longest_s = std::max(next_longest_s, pauses_s[i]);
    }
  }
  pause_s_ = std::lerp(next_longest_s, longest_s, beyond_others);
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
  const bool well = std::ranges::find(standing_, exposures % per_period_) != standing_.end();
  const bool again = !well && wrong_ && *wrong_ != exposures;
  if (well) {
    wrong_.reset();
  } else if (!wrong_) {
    wrong_ = exposures;
  }
  return !again;
}

}  // namespace focalstage
