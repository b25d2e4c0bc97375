#include "editor/window/app/monkey.h"

#include <GLFW/glfw3.h>

#include <algorithm>
#include <array>
#include <random>

#include <glm/common.hpp>

#include "editor/window/app/editor.h"
#include "editor/window/base/widget_registry.h"

namespace focalstage {
namespace {

constexpr int frames_per_picture = 50;
constexpr std::array modifiers = {GLFW_KEY_LEFT_CONTROL, GLFW_KEY_LEFT_SHIFT, GLFW_KEY_LEFT_ALT};
constexpr std::array special_keys = {
    GLFW_KEY_ESCAPE, GLFW_KEY_ENTER, GLFW_KEY_TAB,  GLFW_KEY_BACKSPACE, GLFW_KEY_DELETE,  GLFW_KEY_RIGHT, GLFW_KEY_LEFT,
    GLFW_KEY_DOWN,   GLFW_KEY_UP,    GLFW_KEY_HOME, GLFW_KEY_END,       GLFW_KEY_PAGE_UP, GLFW_KEY_F1,    GLFW_KEY_F2,
    GLFW_KEY_F3,     GLFW_KEY_F4,    GLFW_KEY_F5,   GLFW_KEY_SPACE,     GLFW_KEY_PERIOD,  GLFW_KEY_MINUS};
constexpr std::array<unsigned, 10> letters = {'0', '7', '.', '-', 'a', 'Z', 0x416, 0x5154, 0x1F430, '%'};

class Monkey {
 public:
  Monkey(Editor& editor, std::uint64_t seed) : editor_(editor), chance_(seed) {}

  void act() {
    switch (upto(10)) {
      case 0:
      case 1:
      case 2:
        return click();
      case 3:
      case 4:
        return drag();
      case 5:
      case 6:
        return key();
      case 7:
        return editor_.window().input().scroll({0.0f, static_cast<float>(upto(7)) - 3.0f});
      case 8:
        return type();
      default:
        return seldom();
    }
  }

 private:
  int upto(int n) { return static_cast<int>(chance_() % static_cast<std::uint64_t>(n)); }

  /// On a widget mostly, else anywhere, the edges and a bit beyond included.
  glm::vec2 somewhere() {
    const auto& widgets = seen_widgets();
    if (!widgets.empty() && upto(4) != 0) {
      const SeenWidget& widget = widgets[static_cast<std::size_t>(upto(static_cast<int>(widgets.size())))];
      const glm::vec2 share(static_cast<float>(upto(101)) / 100.0f, static_cast<float>(upto(101)) / 100.0f);
      return glm::mix(widget.min, widget.max, share);
    }
    const glm::ivec2 size = editor_.window().framebuffer_px();
    return {static_cast<float>(upto(size.x + 40) - 20), static_cast<float>(upto(size.y + 40) - 20)};
  }

  void click() {
    Input& input = editor_.window().input();
    const int button = upto(5) == 0 ? 1 + upto(2) : 0;
    input.move(somewhere());
    for (int times = upto(6) == 0 ? 2 : 1; times > 0; --times) {
      input.button(button, true);
      input.button(button, false);
    }
  }

  void drag() {
    Input& input = editor_.window().input();
    const int button = upto(3);
    input.move(somewhere());
    input.button(button, true);
    for (int steps = 1 + upto(4); steps > 0; --steps) {
      input.move(somewhere());
      if (upto(3) == 0) key();  // a key in the midst of a drag
    }
    if (upto(20) != 0) input.button(button, false);
  }

  void key() {
    Input& input = editor_.window().input();
    const int held = upto(3) == 0 ? modifiers[static_cast<std::size_t>(upto(3))] : 0;
    const int which = upto(2) == 0
                          ? GLFW_KEY_A + upto(26)
                          : special_keys[static_cast<std::size_t>(upto(static_cast<int>(special_keys.size())))];
    // Leaving and what opens files of the machine are not what is tried here.
    if (held == GLFW_KEY_LEFT_CONTROL && (which == GLFW_KEY_Q || which == GLFW_KEY_W)) return;
    if (held != 0) input.key(held, true);
    input.key(which, true);
    input.key(which, false);
    if (held != 0) input.key(held, false);
  }

  void type() {
    for (int count = 1 + upto(4); count > 0; --count) {
      editor_.window().input().character(letters[static_cast<std::size_t>(upto(static_cast<int>(letters.size())))]);
    }
  }

  void seldom() {
    Input& input = editor_.window().input();
    switch (upto(12)) {
      case 0:
        return input.drop({"/nowhere/rabbit.glb"});
      case 1:
        return input.leave();
      case 2:
        return editor_.window().resize({330 + upto(1400), 210 + upto(900)});
      case 3:
        return editor_.set_scale(1.0 + 0.25 * upto(9));
      default:
        return input.move(somewhere());
    }
  }

  Editor& editor_;
  std::mt19937_64 chance_;
};

}  // namespace

void play_monkey(Editor& editor, std::uint64_t seed, int events) {
  Monkey monkey(editor, seed);
  int frames = 0;
  const auto frame = [&] {
    editor.take_news(0.0);
    editor.frame({1.0 / 60.0, ++frames % frames_per_picture == 0});
  };
  for (int i = 0; i < events && !editor.session().wants_to_quit(); ++i) {
    monkey.act();
    do {
      frame();
    } while (!editor.window().input().empty());
  }
  editor.window().input().leave();
  for (int i = 0; i < 3; ++i) frame();
}

}  // namespace focalstage
