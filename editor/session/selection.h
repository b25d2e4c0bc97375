#pragma once

#include <vector>

#include "editor/session/thing.h"

namespace focalstage {

/// What is selected, in the order it was; the last is the one whose properties are shown.
struct Selection {
  std::vector<Thing> things;

  bool has(const Thing& thing) const;
  bool empty() const { return things.empty(); }
  const Thing* primary() const { return things.empty() ? nullptr : &things.back(); }
  void toggle(const Thing& thing);
  bool operator==(const Selection&) const = default;
};

}  // namespace focalstage
