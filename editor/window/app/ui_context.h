#pragma once

#include <functional>
#include <string>

#include <glm/vec2.hpp>

namespace focalstage {

class GlfwWindow;

/// Dear ImGui in a window: its context, theme and fonts, and one frame of it. One at a time.
class UiContext {
 public:
  explicit UiContext(GlfwWindow& window);
  ~UiContext();
  UiContext(const UiContext&) = delete;
  UiContext& operator=(const UiContext&) = delete;

  /// Theme and fonts for another content scale, from the next frame on.
  void set_scale(double scale);

  /// What fonts lack and the like; called with lines for the log.
  std::function<void(const std::string&)> warn;

  /// Renews fonts where needed, takes a frame's worth of what hands did, and begins ImGui's frame.
  void begin_frame(glm::ivec2 size_px, double delta_s);

  /// Ends it: ImGui's draw data is ready.
  void end_frame();

 private:
  void renew_fonts();

  GlfwWindow& window_;
  double scale_ = 1.0;
  bool stale_ = true;
};

}  // namespace focalstage
