#pragma once

#include <memory>
#include <string>

#include "devices/display/display.h"

namespace focalstage {

struct GlfwSettings {
  std::string monitor;  ///< as the window system calls it; empty: the only one with a mode of that size
  int width_px = 912;
  int height_px = 1140;
  int rate_hz = 60;
  bool windowed = false;  ///< a plain window anywhere, to look at
  std::size_t most_waiting = 2;
};

/// A full-screen window, for machines with a window system. Its vblanks are as good as that tells them: where a
/// compositor stands between, a frame may be late, and bits may be changed on the way. Rigs use the kernel's outputs
/// (display_kms). No other part of the program may use GLFW at the same time.
std::unique_ptr<Display> make_glfw_display(const GlfwSettings& settings);

}  // namespace focalstage
