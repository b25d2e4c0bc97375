#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/scene/project.h"
#include "editor/session/thing.h"
#include "editor/window/base/pane.h"

namespace focalstage {

class Session;

/// The frames in a row, with the playhead, the keys of the selected thing and the cues on it; all can be dragged.
class TimelineRuler {
 public:
  void draw(Session& session, const PaneRect& rect);

 private:
  enum class Held { nothing, playhead, key, cue };

  struct Mark {
    Held kind = Held::nothing;
    double time_s = 0.0;
    std::string cue;
  };

  static constexpr double band = 17.0;  ///< design pixels: the upper one, of numbers; marks stand in the lower

  /// The keys of what is selected.
  static const std::vector<Keyframe>& keys_of(const Session& session);
  float x_of(double frame) const;
  double frame_at(float x) const;  ///< within the show
  Mark mark_at(const Session& session, glm::vec2 at) const;

  void follow_hand(Session& session);
  void take(Session& session, const Mark& mark);
  void drag(Session& session);
  void drag_key(Session& session, double time_s);
  void drag_cue(Session& session, double time_s);

  void draw_ticks(const Session& session) const;
  void draw_cues(const Session& session, const Mark& hovered) const;
  void draw_keys(const Session& session, const Mark& hovered) const;
  void draw_playhead(const Session& session) const;
  void draw_menu(Session& session);
  void draw_rename(Session& session);

  PaneRect rect_;
  int count_ = 1;
  double rate_hz_ = 1.0;
  Mark held_;
  float held_from_x_ = 0.0f;
  bool moved_ = false;
  Mark menu_for_;
  std::string renamed_cue_;
  std::string typed_;
  bool open_rename_ = false;
};

}  // namespace focalstage
