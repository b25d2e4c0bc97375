#pragma once

#include <memory>
#include <string>

#include <glm/vec2.hpp>

#include "core/base/result.h"
#include "editor/window/app/input.h"

struct GLFWwindow;

namespace focalstage {

struct WindowOptions {
  glm::ivec2 size_px{1600, 900};
  bool hidden = false;
  std::string title = "Focalstage";
};

/// The window of the system with its OpenGL 3.3 context, and what hands do in it.
class GlfwWindow {
 public:
  /// Fault "display.none" where there is no display or it cannot do OpenGL 3.3.
  static Result<std::unique_ptr<GlfwWindow>> open(const WindowOptions& options);
  ~GlfwWindow();
  GlfwWindow(const GlfwWindow&) = delete;
  GlfwWindow& operator=(const GlfwWindow&) = delete;

  Input& input() { return input_; }
  GLFWwindow* handle() const { return handle_; }

  glm::ivec2 framebuffer_px() const;
  double content_scale() const;  ///< of its monitor: 1 to 3
  bool minimized() const;
  void resize(glm::ivec2 size_px);
  void set_title(const std::string& title);
  void set_cursor(int imgui_cursor);

  /// Takes what hands did; waits for it, or for `wake`, at most that long (0: not at all).
  void take_events(double wait_s);
  /// From any thread: ends a wait.
  static void wake();

  /// Whether the person asked to close it since the last call.
  bool take_close();

  /// Whether the system lost what the window showed since the last call.
  bool take_exposed();

  void swap();

 private:
  explicit GlfwWindow(GLFWwindow* handle);
  void install_callbacks();

  GLFWwindow* handle_;
  Input input_;
  struct Cursors;
  std::unique_ptr<Cursors> cursors_;
  std::string title_;
  bool exposed_ = false;
};

}  // namespace focalstage
