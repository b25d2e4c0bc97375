#include "editor/viewer/observer.h"

#include "core/study/seeded.h"

namespace focalstage {

Result<Choice> KeyObserver::choose(int, std::size_t, const WhileWaiting& check) {
  input_.forget();
  for (;;) {
    const auto byte = input_.next(check);
    if (!byte) return byte.fault();
    const KeyPress press = decoder_.take(*byte);
    if (press.key == meaning_.first_arrow || press.character == meaning_.first) return Choice::first;
    if (press.key == meaning_.second_arrow || press.character == meaning_.second) return Choice::second;
    if (press.character == 'q') return Choice::give_up;
  }
}

Result<Choice> ScriptedObserver::choose(int question, std::size_t level, const WhileWaiting& check) {
  if (check) {
    if (Status good = check(); !good) return good.fault();
  }
  if (!seen_.contains(level)) {
    const auto difference = difference_(level);
    if (!difference) return difference.fault();
    seen_[level] = *difference;
  }
  Seeded chance(seed_, "question " + std::to_string(question));
  return seen_[level] + noise_ * chance.gaussian() > 0.0 ? Choice::first : Choice::second;
}

}  // namespace focalstage
