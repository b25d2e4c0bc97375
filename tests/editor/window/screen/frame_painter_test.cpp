#include "editor/window/app/frame_painter.h"

#include <doctest/doctest.h>
#include <imgui.h>

#include <memory>
#include <random>

#include "editor/window/app/glfw_window.h"
#include "editor/window/app/ui_context.h"
#include "editor/window/base/picture.h"
#include "editor/window/base/theme.h"

using namespace focalstage;

namespace {

constexpr glm::ivec2 size_px(640, 400);
constexpr ImGuiWindowFlags plain = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoSavedSettings;

/// A hidden window, ImGui in it, and three panes: two of ImGui's shapes, one with a texture.
struct Screen {
  std::unique_ptr<GlfwWindow> window;
  std::unique_ptr<UiContext> ui;
  CodesTexture codes;
  float box_x = 20.0f;
  std::uint32_t colour = theme::accent;

  Screen() {
    auto opened = GlfwWindow::open({size_px, true, "test"});
    REQUIRE(opened.ok());
    window = std::move(*opened);
    ui = std::make_unique<UiContext>(*window);
    show_code(10);
  }
  ~Screen() {
    codes.release();
    ui.reset();
  }

  void show_code(std::uint8_t code) {
    const std::vector<std::uint8_t> bytes(16, code);
    codes.set({4, 4}, 1, bytes);
  }

  ImDrawData& frame() {
    ui->begin_frame(size_px, 1.0 / 60.0);
    ImGui::SetNextWindowPos({0.0f, 0.0f});
    ImGui::SetNextWindowSize({300.0f, 400.0f});
    ImGui::Begin("left", nullptr, plain);
    ImGui::GetWindowDrawList()->AddRectFilled({box_x, 50.0f}, {box_x + 60.0f, 90.0f}, colour, 6.0f);
    ImGui::TextUnformatted("words");
    ImGui::End();
    ImGui::SetNextWindowPos({310.0f, 0.0f});
    ImGui::SetNextWindowSize({200.0f, 200.0f});
    ImGui::Begin("picture", nullptr, plain | ImGuiWindowFlags_NoBackground);
    draw_picture(codes.picture(), {310.0f, 0.0f}, {200.0f, 200.0f});
    ImGui::End();
    ui->end_frame();
    return *ImGui::GetDrawData();
  }
};

std::uint8_t red_at(const FramePainter& painter, int x, int y) {
  return painter.pixels()[(static_cast<std::size_t>(y) * size_px.x + static_cast<std::size_t>(x)) * 3];
}

}  // namespace

TEST_CASE("a frame in which part changed is the same picture as one drawn whole") {
  Screen screen;
  FramePainter partial;
  (void)partial.paint(screen.frame(), size_px);
  std::mt19937_64 chance(3);
  for (int i = 0; i < 20; ++i) {
    screen.box_x = static_cast<float>(chance() % 220);
    screen.colour = theme::with_alpha(theme::amber, static_cast<double>(chance() % 100) / 100.0);
    CAPTURE(i);
    CHECK(partial.paint(screen.frame(), size_px));
    FramePainter whole;
    CHECK(whole.paint(screen.frame(), size_px));
    CHECK(partial.pixels() == whole.pixels());
  }
}

TEST_CASE("a frame in which nothing changed is not drawn") {
  Screen screen;
  FramePainter painter;
  CHECK(painter.paint(screen.frame(), size_px));
  CHECK(painter.paint(screen.frame(), size_px) == false);
  painter.touch_all();
  CHECK(painter.paint(screen.frame(), size_px));
}

TEST_CASE("new codes in a texture show once their place is touched, unchanged and opaque") {
  Screen screen;
  FramePainter painter;
  (void)painter.paint(screen.frame(), size_px);
  (void)painter.paint(screen.frame(), size_px);
  CHECK(red_at(painter, 400, 100) == 10);
  for (const int code : {0, 1, 127, 128, 200, 255}) {
    screen.show_code(static_cast<std::uint8_t>(code));
    painter.touch({310.0f, 0.0f}, {510.0f, 200.0f});
    CHECK(painter.paint(screen.frame(), size_px));
    CHECK(red_at(painter, 400, 100) == code);
  }
}

TEST_CASE("without a place to draw nothing is drawn") {
  Screen screen;
  FramePainter painter;
  CHECK_FALSE(painter.paint(screen.frame(), {0, 0}));
}
