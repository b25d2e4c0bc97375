#include "editor/window/app/input.h"

#include <GLFW/glfw3.h>
#include <doctest/doctest.h>
#include <imgui.h>

using namespace focalstage;

namespace {

/// One frame's share of the queue, and ImGui's state after it.
struct Frames {
  ImGuiIO io;
  Input input;
  void next() { input.feed(io); }
};

}  // namespace

TEST_CASE("a click takes a frame for the move, one for the press and one for the release") {
  Frames frames;
  frames.input.move({10.0f, 20.0f});
  frames.input.button(0, true);
  frames.input.button(0, false);
  frames.next();
  CHECK(frames.io.MousePos.x == 10.0f);
  CHECK_FALSE(frames.io.MouseDown[0]);
  frames.next();
  CHECK(frames.io.MouseDown[0]);
  frames.next();
  CHECK_FALSE(frames.io.MouseDown[0]);
  CHECK(frames.input.empty());
}

TEST_CASE("moves that queue up become one, but never jump over a press") {
  Frames frames;
  frames.input.move({1.0f, 1.0f});
  frames.input.move({2.0f, 2.0f});
  frames.input.button(0, true);
  frames.input.move({3.0f, 3.0f});
  frames.next();
  CHECK(frames.io.MousePos.x == 2.0f);
  frames.next();
  CHECK(frames.io.MouseDown[0]);
  CHECK(frames.io.MousePos.x == 2.0f);
  frames.next();
  CHECK(frames.io.MousePos.x == 3.0f);
}

TEST_CASE("a key press is a chord with what is held, its release another frame") {
  Frames frames;
  frames.input.key(GLFW_KEY_LEFT_CONTROL, true);
  frames.input.key(GLFW_KEY_Z, true);
  frames.input.key(GLFW_KEY_Z, false);
  frames.input.key(GLFW_KEY_LEFT_CONTROL, false);
  frames.next();
  REQUIRE(frames.input.pressed().size() == 1);
  CHECK(frames.input.pressed()[0] == KeyChord{GLFW_KEY_Z, true, false, false});
  CHECK(frames.io.KeysDown[GLFW_KEY_Z]);
  frames.next();
  CHECK(frames.input.pressed().empty());
  CHECK_FALSE(frames.io.KeysDown[GLFW_KEY_Z]);
  frames.next();
  CHECK_FALSE(frames.io.KeyCtrl);
}

TEST_CASE("leaving lets go of everything") {
  Frames frames;
  frames.input.key(GLFW_KEY_LEFT_SHIFT, true);
  frames.input.button(1, true);
  while (!frames.input.empty()) frames.next();
  CHECK(frames.io.MouseDown[1]);
  frames.input.leave();
  frames.next();
  CHECK_FALSE(frames.io.MouseDown[1]);
  CHECK_FALSE(frames.io.KeyShift);
}

TEST_CASE("dropped files are those of this frame only, and unknown buttons and keys are nothing") {
  Frames frames;
  frames.input.drop({"a.glb", "b.png"});
  frames.input.button(9, true);
  frames.input.button(-1, true);
  frames.input.key(-1, true);
  frames.input.key(100000, true);
  frames.next();
  CHECK(frames.input.dropped().size() == 2);
  CHECK(frames.input.empty());
  frames.next();
  CHECK(frames.input.dropped().empty());
}
