#pragma once

#include <string>
#include <string_view>

#include "editor/window/base/pane.h"

namespace focalstage {

class Session;

/// Where a panel stands in the window.
enum class PanelPlace {
  bar,         ///< along the top
  outline,     ///< left
  properties,  ///< right
  timeline,    ///< the strip below the views
  bottom,      ///< one of the tabs below
  start,       ///< in the place of the views while nothing is open
  over,        ///< above all else: palette, questions, notices. It begins windows of its own, or none.
};

/// One part of the window beside the views. `draw` is called inside an ImGui window that fills `rect` (but for
/// `over`), with the panel's name as the scope of its widgets' names.
class Panel {
 public:
  virtual ~Panel() = default;

  /// In lower case, stable: the scope of its widgets' names ("outline", "toolbar").
  virtual std::string_view name() const = 0;
  virtual PanelPlace place() const = 0;
  /// Of a tab; elsewhere unused.
  virtual std::string_view title() const { return name(); }
  /// Beside the title of a tab: how many it holds. Empty: nothing.
  virtual std::string badge(const Session&) const { return {}; }

  virtual void draw(Session& session, const PaneRect& rect) = 0;
};

}  // namespace focalstage
