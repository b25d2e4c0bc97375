#pragma once

#include <optional>
#include <string>

#include "editor/session/thing.h"

namespace focalstage {

class Session;
struct OutlineRow;

/// A row of the outline whose name is being typed, a thing's or a group's.
class OutlineRename {
 public:
  bool is_of(const Session& session, const OutlineRow& row) const;
  void begin(Session& session, const OutlineRow& row);

  /// The row, `row_px` high, as a field; what was typed becomes an edit, unless Escape ended it.
  void draw(Session& session, const OutlineRow& row, float row_px);

 private:
  void finish(Session& session, const OutlineRow& row, bool take);

  std::optional<Thing> renamed_group_;  ///< things are in the view state, where commands begin it
  std::string typed_;
  std::optional<Thing> typing_for_;  ///< whose name has the keyboard
};

}  // namespace focalstage
