#pragma once

#include <array>
#include <deque>
#include <filesystem>
#include <string>
#include <vector>

#include <glm/vec2.hpp>

#include "editor/window/app/keys.h"

struct ImGuiIO;

namespace focalstage {

/// What came from hands, in order: a person's through GLFW's callbacks, a script's and a monkey's by the same calls.
/// Each frame takes from its front as much as one frame can tell apart: a press and its release are two frames, a
/// button waits for the frame after the move that brought the pointer there.
class Input {
 public:
  void move(glm::vec2 at_px);
  void button(int button, bool down);
  void scroll(glm::vec2 steps);
  void key(int key, bool down);  ///< GLFW's code
  void character(unsigned code);
  void drop(std::vector<std::filesystem::path> files);
  void leave();  ///< the pointer left the window, or the window lost the keyboard: nothing is held any more

  bool empty() const { return events_.empty(); }

  /// What one frame gets, put into ImGui's state. Call between the backend's NewFrame and ImGui's.
  void feed(ImGuiIO& io);

  /// What of that frame is not for ImGui.
  const std::vector<KeyChord>& pressed() const { return pressed_; }
  const std::vector<std::filesystem::path>& dropped() const { return dropped_; }
  glm::vec2 pointer_px() const { return pointer_px_; }

 private:
  struct Event {
    enum class Kind { move, button, scroll, key, character, drop, leave };
    Kind kind;
    glm::vec2 at{0.0f};
    int code = 0;
    bool down = false;
    std::vector<std::filesystem::path> files;
  };

  /// What has happened in this frame already.
  struct Frame {
    bool moved = false;
    bool scrolled = false;
    bool typed = false;
    bool keyed = false;
    std::array<bool, 5> buttons{};
  };

  bool fits(const Event& event, const Frame& frame) const;
  void take(const Event& event, Frame& frame, ImGuiIO& io);
  void take_key(const Event& event, ImGuiIO& io);

  std::deque<Event> events_;
  std::vector<KeyChord> pressed_;
  std::vector<std::filesystem::path> dropped_;
  glm::vec2 pointer_px_{-1.0e6f};
};

}  // namespace focalstage
