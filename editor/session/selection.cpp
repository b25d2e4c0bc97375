#include "editor/session/selection.h"

#include <algorithm>

namespace focalstage {

bool Selection::has(const Thing& thing) const { return std::find(things.begin(), things.end(), thing) != things.end(); }

void Selection::toggle(const Thing& thing) {
  const auto at = std::find(things.begin(), things.end(), thing);
  if (at == things.end()) {
    things.push_back(thing);
  } else {
    things.erase(at);
  }
}

}  // namespace focalstage
