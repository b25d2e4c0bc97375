#pragma once

#include <optional>
#include <vector>

#include "editor/session/outline_rows.h"
#include "editor/session/thing.h"

namespace focalstage {

class Session;

/// The rows of the outline and where they were drawn.
struct DrawnRows {
  const std::vector<OutlineRow>& rows;
  float top_px;  ///< of the first, on the screen
  float row_px;  ///< how high each is
};

/// A thing of the outline that is dragged to another place of its list.
class OutlineDrag {
 public:
  bool active() const { return dragged_.has_value(); }

  /// Begins where the row drawn last is being dragged.
  void follow(const OutlineRow& row);

  /// The line where it would be put.
  void draw(const DrawnRows& drawn) const;

  /// Puts it there once the hand lets go.
  void drop(Session& session, const DrawnRows& drawn);

 private:
  /// Before or after which thing.
  struct Place {
    Thing beside;
    bool after;
  };
  /// By the row under the pointer and the half of it, if what is dragged may stand there.
  std::optional<Place> place(const DrawnRows& drawn) const;

  std::optional<Thing> dragged_;
};

}  // namespace focalstage
