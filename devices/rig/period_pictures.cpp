#include "devices/rig/period_pictures.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "core/base/periodic.h"

namespace focalstage {

namespace {

Picture black_as(const Picture& other) {
  auto codes = std::make_shared<std::vector<std::uint8_t>>(other.codes.size());
  return {codes, *codes};
}

}  // namespace

std::vector<TableTrigger> table_triggers(const Score& score) {
  std::vector<TableTrigger> triggers;
  for (std::size_t slot = 0; slot < score.trigger_s.size(); ++slot) {
    const double at_s = wrapped_s(score.trigger_s[slot], score.drive.period_s);
    const long periods = std::lround((score.trigger_s[slot] - at_s) / score.drive.period_s);
    triggers.push_back({at_s, slot, -static_cast<int>(periods)});
  }
  std::ranges::stable_sort(triggers, {}, &TableTrigger::at_s);
  return triggers;
}

std::optional<std::vector<Picture>> period_pictures(const std::vector<TableTrigger>& triggers,
                                                    const std::deque<HandedSweep>& sweeps) {
  std::vector<Picture> pictures;
  const Picture* lit = nullptr;
  for (const TableTrigger& trigger : triggers) {
    // A trigger after its own period's end is the sweep before's; that one is gone, and its light with it.
    if (trigger.sweeps_later < 0) {
      pictures.emplace_back();
      continue;
    }
    const auto place = static_cast<std::size_t>(trigger.sweeps_later);
    if (place >= sweeps.size()) return std::nullopt;
    const std::vector<Picture>& of_sweep = sweeps[place].pictures;
    pictures.push_back(trigger.slot < of_sweep.size() ? of_sweep[trigger.slot] : Picture{});
    if (!pictures.back().codes.empty()) lit = &of_sweep[trigger.slot];
  }
  if (lit == nullptr) return std::vector<Picture>{};
  const Picture black = black_as(*lit);
  for (Picture& picture : pictures) {
    if (picture.codes.empty()) picture = black;
  }
  return pictures;
}

Fault late_pictures() {
  return {"rig.missed-light", "projector", "a sweep's pictures were not there when it began",
          "see that nothing else keeps this machine busy, then say go"};
}

Status drop_past(std::deque<HandedSweep>& sweeps, double before_s) {
  while (!sweeps.empty() && sweeps.front().start_s < before_s) {
    if (!sweeps.front().pictures.empty()) return late_pictures();
    sweeps.pop_front();
  }
  return {};
}

}  // namespace focalstage
