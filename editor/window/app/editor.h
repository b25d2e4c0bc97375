#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "editor/session/session.h"
#include "editor/window/app/frame_painter.h"
#include "editor/window/app/glfw_window.h"
#include "editor/window/app/steering.h"
#include "editor/window/app/ui_context.h"
#include "editor/window/app/window_config.h"
#include "editor/window/app/workbench.h"

namespace focalstage {

struct EditorOptions {
  WindowOptions window;
  double scale = 0.0;            ///< 0: the monitor's
  std::filesystem::path config;  ///< folder where the window's layout is remembered; empty: nowhere
  WindowConfig remembered;
  bool space_mouse = false;  ///< look for one; not where hands are played
};

/// What a frame is for.
struct FrameKind {
  double delta_s = 1.0 / 60.0;  ///< since the last, as ImGui is told
  bool drawn = true;            ///< false: all is done but nothing is painted
};

/// The editor in its window: a Session, everything that shows it, and the frames between a hand and the screen. The
/// same `frame` serves a person, a script and a monkey.
class Editor {
 public:
  Editor(std::unique_ptr<GlfwWindow> window, const EditorOptions& options);
  ~Editor();
  Editor(const Editor&) = delete;
  Editor& operator=(const Editor&) = delete;

  /// Until the person leaves.
  void run();

  /// One frame: takes what hands did, what came from behind, shows what came of it.
  void frame(const FrameKind& kind);

  /// Takes what the system has and gives the session its turn; true if a frame is worth drawing.
  bool take_news(double wait_s);

  /// Whether another frame would show something else without anything more happening.
  bool unsettled() const;

  /// How long the frames took since the last call, in milliseconds: what a person waits for after a hand's move.
  std::vector<double> take_frame_times_ms();

  Session& session() { return session_; }
  GlfwWindow& window() { return *window_; }
  const FramePainter& painter() const { return painter_; }
  void set_scale(double scale);

 private:
  void show_frame(const FrameKind& kind);
  bool close_popup();
  void follow_shortcuts();
  void import_dropped();
  void follow_fill_press();
  void want_names();
  double wait_s(double last_frame_s) const;
  void remember();

  std::unique_ptr<GlfwWindow> window_;
  UiContext ui_;
  FramePainter painter_;
  Session session_;
  Workbench workbench_;
  std::optional<Steering> steering_;
  std::filesystem::path config_;
  WindowConfig remembered_;
  double scale_ = 1.0;
  glm::ivec2 drawn_size_px_{0};
  double wish_at_s_ = 0.0;  ///< when something that moves by itself wants a frame
  int lively_frames_ = 3;   ///< to draw before sleeping
  std::uint64_t named_revision_ = ~0ull;
  std::size_t named_log_ = 0;
  std::vector<double> frame_times_ms_;
};

/// Seconds since the program started, as the session's clock counts them.
double seconds_now();

}  // namespace focalstage
