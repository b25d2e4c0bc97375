#include "core/scene/history.h"

#include <algorithm>
#include <utility>

namespace focalstage {
namespace {

/// Undo then replays at most this many steps, a few milliseconds, and a long day's history stays small.
constexpr std::size_t steps_per_snapshot = 16;

bool sets_the_same_key(const Edit& a, const Edit& b) {
  return a.kind == Edit::Kind::set && b.kind == Edit::Kind::set && a.list == b.list && a.name == b.name &&
         a.key == b.key;
}

bool sets_the_same(const Step& a, const Step& b) {
  return std::equal(a.edits.begin(), a.edits.end(), b.edits.begin(), b.edits.end(), sets_the_same_key);
}

}  // namespace

History::History(Project start) : now_(std::make_shared<const Project>(std::move(start))) { kept_[0] = now_; }

Status History::apply(Step step, Joining joining) {
  const bool merges =
      joining == Joining::continues_last && place_ > 0 && place_ == steps_.size() && sets_the_same(steps_.back(), step);
  const std::size_t base = merges ? place_ - 1 : place_;
  auto changed = apply_all(merges ? *state_at(base) : *now_, step.edits);
  if (!changed) return changed.fault();
  steps_.resize(base);
  steps_.push_back(std::move(step));
  kept_.erase(kept_.upper_bound(base), kept_.end());
  stand_at(base + 1, std::make_shared<const Project>(std::move(*changed)));
  return {};
}

void History::undo() {
  if (can_undo()) jump(place_ - 1);
}

void History::redo() {
  if (can_redo()) jump(place_ + 1);
}

void History::jump(std::size_t place) {
  place = std::min(place, steps_.size());
  if (place != place_) stand_at(place, state_at(place));
}

History::Snapshot History::state_at(std::size_t place) const {
  const auto kept = std::prev(kept_.upper_bound(place));
  if (kept->first == place) return kept->second;
  Project project = *kept->second;
  // These steps were applied once already, to the same states: they cannot fail.
  for (std::size_t i = kept->first; i < place; ++i) project = *apply_all(project, steps_[i].edits);
  return std::make_shared<const Project>(std::move(project));
}

void History::stand_at(std::size_t place, Snapshot state) {
  if (place % steps_per_snapshot == 0) kept_[place] = state;
  place_ = place;
  now_ = std::move(state);
  ++revision_;
}

}  // namespace focalstage
