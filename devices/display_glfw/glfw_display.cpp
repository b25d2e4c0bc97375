#include "devices/display_glfw/glfw_display.h"

#include <epoxy/gl.h>

#include <GLFW/glfw3.h>

#include <algorithm>
#include <cmath>
#include <future>
#include <thread>

#include "devices/display/queued_display.h"
#include "devices/roles/clock.h"

namespace focalstage {

namespace {

Fault fault(const char* code, const std::string& message, const std::string& remedy) {
  return {code, "display", message, remedy};
}

bool has_mode(GLFWmonitor* monitor, const GlfwSettings& settings) {
  int count = 0;
  const GLFWvidmode* modes = glfwGetVideoModes(monitor, &count);
  for (int i = 0; i < count; ++i) {
    if (modes[i].width == settings.width_px && modes[i].height == settings.height_px) return true;
  }
  return false;
}

Result<GLFWmonitor*> choose_monitor(const GlfwSettings& settings) {
  int count = 0;
  GLFWmonitor** monitors = glfwGetMonitors(&count);
  GLFWmonitor* found = nullptr;
  std::string names;
  for (int i = 0; i < count; ++i) {
    const std::string name = glfwGetMonitorName(monitors[i]);
    names += (names.empty() ? "" : ", ") + name;
    if (!settings.monitor.empty() && settings.monitor != name) continue;
    if (!has_mode(monitors[i], settings)) continue;
    if (found != nullptr) {
      return fault("display.which", "several displays have that size: " + names, "name one of them in the settings");
    }
    found = monitors[i];
  }
  if (found == nullptr) {
    return fault("display.mode",
                 "no such display has a mode of " + std::to_string(settings.width_px) + " x " +
                     std::to_string(settings.height_px) + "; there are: " + (names.empty() ? "none" : names),
                 "connect the projector, or name another display in the settings");
  }
  return found;
}

class GlfwDisplay final : public QueuedDisplay {
 public:
  explicit GlfwDisplay(GlfwSettings settings) : QueuedDisplay(settings.most_waiting), settings_(std::move(settings)) {}
  ~GlfwDisplay() override { close(); }

  VideoMode mode() const override { return {settings_.width_px, settings_.height_px, 1.0 / settings_.rate_hz}; }

 private:
  /// A window belongs to the thread that draws in it.
  Result<std::jthread> take() override {
    std::promise<Status> opened;
    std::future<Status> result = opened.get_future();
    std::jthread thread(
        [this, promise = std::move(opened)](const std::stop_token& stop) mutable { run(stop, promise); });
    if (const Status status = result.get(); !status) return status.fault();
    return thread;
  }

  void run(const std::stop_token& stop, std::promise<Status>& opened) {
    if (glfwInit() != GLFW_TRUE) {
      opened.set_value(fault("display.absent", "there is no window system", "use the kernel's outputs instead"));
      return;
    }
    Result<GLFWwindow*> window = make_window();
    if (!window) {
      opened.set_value(window.fault());
    } else {
      glfwMakeContextCurrent(*window);
      glfwSwapInterval(1);
      draw(*window, nullptr);
      queue_.open(static_cast<std::size_t>(settings_.width_px) * static_cast<std::size_t>(settings_.height_px));
      opened.set_value({});
      show(stop, *window);
      glfwDestroyWindow(*window);
    }
    glfwTerminate();
  }

  Result<GLFWwindow*> make_window() const {
    GLFWmonitor* monitor = nullptr;
    if (!settings_.windowed) {
      const Result<GLFWmonitor*> chosen = choose_monitor(settings_);
      if (!chosen) return chosen.fault();
      monitor = *chosen;
    }
    glfwWindowHint(GLFW_REFRESH_RATE, settings_.rate_hz);
    glfwWindowHint(GLFW_AUTO_ICONIFY, GLFW_FALSE);
    glfwWindowHint(GLFW_DECORATED, GLFW_FALSE);
    glfwWindowHint(GLFW_RESIZABLE, GLFW_FALSE);
    GLFWwindow* window =
        glfwCreateWindow(settings_.width_px, settings_.height_px, "Focalstage projector", monitor, nullptr);
    if (window == nullptr) return fault("display.refused", "no window can be opened", "look at the graphics driver");
    glfwSetInputMode(window, GLFW_CURSOR, GLFW_CURSOR_HIDDEN);
    return window;
  }

  void draw(GLFWwindow* window, const std::vector<std::uint32_t>* pixels) const {
    glDisable(GL_DITHER);
    glClearColor(0.0F, 0.0F, 0.0F, 1.0F);
    glClear(GL_COLOR_BUFFER_BIT);
    if (pixels != nullptr) {
      glWindowPos2i(0, settings_.height_px);
      glPixelZoom(1.0F, -1.0F);
      glDrawPixels(settings_.width_px, settings_.height_px, GL_BGRA, GL_UNSIGNED_INT_8_8_8_8_REV, pixels->data());
    }
    glfwSwapBuffers(window);
    glFinish();
  }

  void show(const std::stop_token& stop, GLFWwindow* window) {
    const double interval_s = 1.0 / settings_.rate_hz;
    double before_s = monotonic_s();
    while (!stop.stop_requested()) {
      glfwPollEvents();
      if (glfwWindowShouldClose(window) != 0) {
        queue_.lose(fault("display.lost", "its window was closed", "open it again"));
        return;
      }
      draw(window, queue_.take().get());
      if (monotonic_s() < before_s + 0.5 * interval_s) sleep_until(before_s + interval_s);  // nobody keeps the beat
      const double now_s = monotonic_s();
      const auto passed = static_cast<std::uint64_t>(std::max(1L, std::lround((now_s - before_s) / interval_s)));
      before_s = now_s;
      queue_.shown(now_s, passed - 1);
    }
    draw(window, nullptr);
  }

  GlfwSettings settings_;
};

}  // namespace

std::unique_ptr<Display> make_glfw_display(const GlfwSettings& settings) {
  return std::make_unique<GlfwDisplay>(settings);
}

}  // namespace focalstage
