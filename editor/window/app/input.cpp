#include "editor/window/app/input.h"

#include <GLFW/glfw3.h>
#include <imgui.h>

#include <algorithm>
#include <cfloat>

namespace focalstage {

void Input::move(glm::vec2 at_px) {
  Event event{Event::Kind::move, at_px, 0, false, {}};
  // A mouse reports faster than frames are drawn: only where it ended counts.
  if (!events_.empty() && events_.back().kind == Event::Kind::move) {
    events_.back() = event;
  } else {
    events_.push_back(event);
  }
}

void Input::button(int button, bool down) {
  if (button >= 0 && button < 5) events_.push_back({Event::Kind::button, {}, button, down, {}});
}

void Input::scroll(glm::vec2 steps) { events_.push_back({Event::Kind::scroll, steps, 0, false, {}}); }

void Input::key(int key, bool down) {
  if (key > 0 && key <= GLFW_KEY_LAST) events_.push_back({Event::Kind::key, {}, key, down, {}});
}

void Input::character(unsigned code) {
  events_.push_back({Event::Kind::character, {}, static_cast<int>(code), true, {}});
}

void Input::drop(std::vector<std::filesystem::path> files) {
  events_.push_back({Event::Kind::drop, {}, 0, false, std::move(files)});
}

void Input::leave() { events_.push_back({Event::Kind::leave, {}, 0, false, {}}); }

bool Input::fits(const Event& event, const Frame& frame) const {
  const bool any_button = std::ranges::any_of(frame.buttons, [](bool b) { return b; });
  switch (event.kind) {
    case Event::Kind::move:
      return !any_button && !frame.moved;
    case Event::Kind::button:
      return !frame.moved && !frame.scrolled && !frame.keyed && !frame.buttons[static_cast<std::size_t>(event.code)];
    case Event::Kind::scroll:
      return !frame.moved && !any_button;
    case Event::Kind::key:
      return !frame.typed && !frame.keyed && !any_button;
    case Event::Kind::character:
      return true;  // the key that made it came just before
    case Event::Kind::drop:
    case Event::Kind::leave:
      return !frame.moved && !any_button;
  }
  return false;
}

void Input::take_key(const Event& event, ImGuiIO& io) {
  io.KeysDown[event.code] = event.down;
  io.KeyCtrl = io.KeysDown[GLFW_KEY_LEFT_CONTROL] || io.KeysDown[GLFW_KEY_RIGHT_CONTROL];
  io.KeyShift = io.KeysDown[GLFW_KEY_LEFT_SHIFT] || io.KeysDown[GLFW_KEY_RIGHT_SHIFT];
  io.KeyAlt = io.KeysDown[GLFW_KEY_LEFT_ALT] || io.KeysDown[GLFW_KEY_RIGHT_ALT];
  const bool modifier = event.code >= GLFW_KEY_LEFT_SHIFT && event.code <= GLFW_KEY_RIGHT_SUPER;
  if (event.down && !modifier) pressed_.push_back({event.code, io.KeyCtrl, io.KeyShift, io.KeyAlt});
}

void Input::take(const Event& event, Frame& frame, ImGuiIO& io) {
  switch (event.kind) {
    case Event::Kind::move:
      pointer_px_ = event.at;
      frame.moved = true;
      break;
    case Event::Kind::button:
      io.MouseDown[event.code] = event.down;
      frame.buttons[static_cast<std::size_t>(event.code)] = true;
      break;
    case Event::Kind::scroll:
      io.MouseWheelH += event.at.x;
      io.MouseWheel += event.at.y;
      frame.scrolled = true;
      break;
    case Event::Kind::key:
      take_key(event, io);
      // A modifier and the key it goes with may share a frame; a second key may not.
      frame.keyed = event.code < GLFW_KEY_LEFT_SHIFT || event.code > GLFW_KEY_RIGHT_SUPER;
      break;
    case Event::Kind::character:
      io.AddInputCharacter(static_cast<unsigned>(event.code));
      frame.typed = true;
      break;
    case Event::Kind::drop:
      dropped_.insert(dropped_.end(), event.files.begin(), event.files.end());
      break;
    case Event::Kind::leave:
      std::fill(std::begin(io.KeysDown), std::end(io.KeysDown), false);
      std::fill(std::begin(io.MouseDown), std::end(io.MouseDown), false);
      io.KeyCtrl = io.KeyShift = io.KeyAlt = io.KeySuper = false;
      break;
  }
}

void Input::feed(ImGuiIO& io) {
  pressed_.clear();
  dropped_.clear();
  Frame frame;
  while (!events_.empty() && fits(events_.front(), frame)) {
    take(events_.front(), frame, io);
    events_.pop_front();
  }
  io.MousePos = pointer_px_.x < -1.0e5f ? ImVec2(-FLT_MAX, -FLT_MAX) : ImVec2(pointer_px_.x, pointer_px_.y);
}

}  // namespace focalstage
