#include "editor/window/app/glfw_window.h"

#include <GLFW/glfw3.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace focalstage {
namespace {

GlfwWindow& window_of(GLFWwindow* handle) { return *static_cast<GlfwWindow*>(glfwGetWindowUserPointer(handle)); }

/// From the coordinates of the screen to pixels, which differ on some systems.
glm::vec2 pixels_of(GLFWwindow* handle, double x, double y) {
  glm::ivec2 window;
  glm::ivec2 framebuffer;
  glfwGetWindowSize(handle, &window.x, &window.y);
  glfwGetFramebufferSize(handle, &framebuffer.x, &framebuffer.y);
  const glm::vec2 ratio = glm::vec2(framebuffer) / glm::vec2(std::max(window.x, 1), std::max(window.y, 1));
  return glm::vec2(static_cast<float>(x), static_cast<float>(y)) * ratio;
}

/// GLFW names letters by where they lie on an American keyboard; shortcuts mean what is printed on this one.
int key_as_printed(int key) {
  if (key < GLFW_KEY_A || key > GLFW_KEY_Z) return key;
  const char* name = glfwGetKeyName(key, 0);
  if (name == nullptr || name[1] != '\0') return key;
  if (name[0] >= 'a' && name[0] <= 'z') return name[0] - 'a' + GLFW_KEY_A;
  return key;
}

void set_hints(const WindowOptions& options) {
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
  glfwWindowHint(GLFW_SAMPLES, 0);
  glfwWindowHint(GLFW_DEPTH_BITS, 0);
  glfwWindowHint(GLFW_STENCIL_BITS, 0);
  glfwWindowHint(GLFW_VISIBLE, options.hidden ? GLFW_FALSE : GLFW_TRUE);
}

Fault no_display() {
  const char* reason = nullptr;
  glfwGetError(&reason);
  return {"display.none", "the window", reason != nullptr ? reason : "no window can be opened here",
          "start it where there is a display with OpenGL 3.3; every other command of focalstage works without"};
}

}  // namespace

struct GlfwWindow::Cursors {
  std::array<GLFWcursor*, ImGuiMouseCursor_COUNT> shapes{};
  int shown = ImGuiMouseCursor_Arrow;

  Cursors() {
    shapes[ImGuiMouseCursor_Arrow] = glfwCreateStandardCursor(GLFW_ARROW_CURSOR);
    shapes[ImGuiMouseCursor_TextInput] = glfwCreateStandardCursor(GLFW_IBEAM_CURSOR);
    shapes[ImGuiMouseCursor_ResizeNS] = glfwCreateStandardCursor(GLFW_VRESIZE_CURSOR);
    shapes[ImGuiMouseCursor_ResizeEW] = glfwCreateStandardCursor(GLFW_HRESIZE_CURSOR);
    shapes[ImGuiMouseCursor_Hand] = glfwCreateStandardCursor(GLFW_HAND_CURSOR);
    shapes[ImGuiMouseCursor_ResizeAll] = glfwCreateStandardCursor(GLFW_CROSSHAIR_CURSOR);
  }
  ~Cursors() {
    for (GLFWcursor* shape : shapes) {
      if (shape != nullptr) glfwDestroyCursor(shape);
    }
  }
};

Result<std::unique_ptr<GlfwWindow>> GlfwWindow::open(const WindowOptions& options) {
  if (glfwInit() != GLFW_TRUE) return no_display();
  set_hints(options);
  GLFWwindow* handle = glfwCreateWindow(options.size_px.x, options.size_px.y, options.title.c_str(), nullptr, nullptr);
  if (handle == nullptr) {
    Fault fault = no_display();
    glfwTerminate();
    return fault;
  }
  glfwMakeContextCurrent(handle);
  glfwSwapInterval(1);
  return std::unique_ptr<GlfwWindow>(new GlfwWindow(handle));
}

GlfwWindow::GlfwWindow(GLFWwindow* handle) : handle_(handle), cursors_(std::make_unique<Cursors>()) {
  glfwSetWindowSizeLimits(handle_, 320, 200, GLFW_DONT_CARE, GLFW_DONT_CARE);
  install_callbacks();
}

GlfwWindow::~GlfwWindow() {
  cursors_.reset();
  glfwDestroyWindow(handle_);
  glfwTerminate();
}

void GlfwWindow::install_callbacks() {
  glfwSetWindowUserPointer(handle_, this);
  glfwSetCursorPosCallback(
      handle_, [](GLFWwindow* handle, double x, double y) { window_of(handle).input_.move(pixels_of(handle, x, y)); });
  glfwSetMouseButtonCallback(handle_, [](GLFWwindow* handle, int button, int action, int) {
    window_of(handle).input_.button(button, action == GLFW_PRESS);
  });
  glfwSetScrollCallback(handle_, [](GLFWwindow* handle, double x, double y) {
    window_of(handle).input_.scroll({static_cast<float>(x), static_cast<float>(y)});
  });
  glfwSetKeyCallback(handle_, [](GLFWwindow* handle, int key, int, int action, int) {
    if (action != GLFW_REPEAT) window_of(handle).input_.key(key_as_printed(key), action == GLFW_PRESS);
  });
  glfwSetCharCallback(handle_, [](GLFWwindow* handle, unsigned code) { window_of(handle).input_.character(code); });
  glfwSetDropCallback(handle_, [](GLFWwindow* handle, int count, const char** paths) {
    window_of(handle).input_.drop({paths, paths + count});
  });
  glfwSetWindowRefreshCallback(handle_, [](GLFWwindow* handle) { window_of(handle).exposed_ = true; });
  glfwSetWindowFocusCallback(handle_, [](GLFWwindow* handle, int focused) {
    if (focused == GLFW_FALSE) window_of(handle).input_.leave();
  });
}

glm::ivec2 GlfwWindow::framebuffer_px() const {
  glm::ivec2 size;
  glfwGetFramebufferSize(handle_, &size.x, &size.y);
  return size;
}

double GlfwWindow::content_scale() const {
  float x = 1.0f;
  glfwGetWindowContentScale(handle_, &x, nullptr);
  return std::clamp(static_cast<double>(x), 1.0, 3.0);
}

bool GlfwWindow::minimized() const { return glfwGetWindowAttrib(handle_, GLFW_ICONIFIED) == GLFW_TRUE; }

void GlfwWindow::resize(glm::ivec2 size_px) { glfwSetWindowSize(handle_, size_px.x, size_px.y); }

void GlfwWindow::set_title(const std::string& title) {
  if (title == title_) return;
  title_ = title;
  glfwSetWindowTitle(handle_, title.c_str());
}

void GlfwWindow::set_cursor(int imgui_cursor) {
  if (imgui_cursor < 0 || imgui_cursor >= ImGuiMouseCursor_COUNT || imgui_cursor == cursors_->shown) return;
  cursors_->shown = imgui_cursor;
  glfwSetCursor(handle_, cursors_->shapes[static_cast<std::size_t>(imgui_cursor)]);
}

void GlfwWindow::take_events(double wait_s) {
  if (wait_s <= 0.0) {
    glfwPollEvents();
  } else {
    glfwWaitEventsTimeout(std::min(wait_s, 3600.0));
  }
}

void GlfwWindow::wake() { glfwPostEmptyEvent(); }

bool GlfwWindow::take_close() {
  const bool asked = glfwWindowShouldClose(handle_) == GLFW_TRUE;
  glfwSetWindowShouldClose(handle_, GLFW_FALSE);
  return asked;
}

bool GlfwWindow::take_exposed() { return std::exchange(exposed_, false); }

void GlfwWindow::swap() { glfwSwapBuffers(handle_); }

}  // namespace focalstage
