#include "editor/window/base/vtk_target.h"

#include <doctest/doctest.h>
#include <imgui.h>
#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkNew.h>
#include <vtkPlaneSource.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>

#include <memory>
#include <string>

#include "editor/window/app/frame_painter.h"
#include "editor/window/app/glfw_window.h"
#include "editor/window/app/ui_context.h"

using namespace focalstage;

namespace {

constexpr glm::ivec2 size_px(200, 100);

struct Rgb {
  int r, g, b;
  bool operator==(const Rgb&) const = default;
};

/// VTK's picture as the window shows it over its whole area.
struct Shown {
  FramePainter painter;
  Shown(UiContext& ui, const Picture& picture) {
    ui.begin_frame(size_px, 1.0 / 60.0);
    ImGui::SetNextWindowPos({0.0f, 0.0f});
    ImGui::SetNextWindowSize({200.0f, 100.0f});
    ImGui::Begin("picture", nullptr, ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoBackground);
    draw_picture(picture, {0.0f, 0.0f}, {200.0f, 100.0f});
    ImGui::End();
    ui.end_frame();
    (void)painter.paint(*ImGui::GetDrawData(), size_px);
  }
  Rgb at(int x, int y) const {
    const auto pixels = painter.pixels();
    const std::size_t i = (static_cast<std::size_t>(y) * 200 + static_cast<std::size_t>(x)) * 3;
    return {pixels[i], pixels[i + 1], pixels[i + 2]};
  }
};

}  // namespace

TEST_CASE("what VTK renders reaches the window: right way up, unchanged, at one and at two samples a side") {
  auto window = GlfwWindow::open({size_px, true, "test"});
  REQUIRE(window.ok());
  UiContext ui(**window);
  std::string said;
  send_vtk_messages_to([&](std::string_view line) { said += line; });
  VtkTarget target;
  CHECK(target.texture() == 0);
  // A red plane over the upper half of a parallel view two units high.
  vtkNew<vtkPlaneSource> plane;
  plane->SetOrigin(-5.0, 0.0, 0.0);
  plane->SetPoint1(5.0, 0.0, 0.0);
  plane->SetPoint2(-5.0, 5.0, 0.0);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(plane->GetOutputPort());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->LightingOff();
  actor->GetProperty()->SetColor(1.0, 0.0, 0.0);
  target.renderer()->AddActor(actor);
  target.renderer()->SetBackground(0.0, 0.0, 1.0);
  vtkCamera& camera = *target.renderer()->GetActiveCamera();
  camera.ParallelProjectionOn();
  camera.SetParallelScale(1.0);
  camera.SetPosition(0.0, 0.0, 3.0);
  for (const int supersample : {1, 2}) {
    target.render(size_px, supersample);
    CHECK(target.picture().size_px == size_px * supersample);
    const Shown shown(ui, target.picture());
    CHECK(shown.at(100, 20) == Rgb{255, 0, 0});
    CHECK(shown.at(100, 80) == Rgb{0, 0, 255});
  }
  target.render({0, 50});  // too small to be seen: nothing happens
  CHECK(target.picture().size_px == size_px * 2);
  target.finalize();
  CHECK(target.texture() == 0);
  target.render(size_px);
  CHECK(target.texture() == 0);
  CHECK(said.empty());
  send_vtk_messages_to(nullptr);
}
