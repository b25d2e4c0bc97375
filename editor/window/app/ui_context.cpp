#include "editor/window/app/ui_context.h"

#include <GLFW/glfw3.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <algorithm>

#include "editor/window/app/glfw_window.h"
#include "editor/window/base/fonts.h"
#include "editor/window/base/theme.h"
#include "editor/window/base/widget_registry.h"

namespace focalstage {
namespace {

const char* get_clipboard(void* handle) { return glfwGetClipboardString(static_cast<GLFWwindow*>(handle)); }
void set_clipboard(void* handle, const char* text) { glfwSetClipboardString(static_cast<GLFWwindow*>(handle), text); }

void map_keys(ImGuiIO& io) {
  io.KeyMap[ImGuiKey_Tab] = GLFW_KEY_TAB;
  io.KeyMap[ImGuiKey_LeftArrow] = GLFW_KEY_LEFT;
  io.KeyMap[ImGuiKey_RightArrow] = GLFW_KEY_RIGHT;
  io.KeyMap[ImGuiKey_UpArrow] = GLFW_KEY_UP;
  io.KeyMap[ImGuiKey_DownArrow] = GLFW_KEY_DOWN;
  io.KeyMap[ImGuiKey_PageUp] = GLFW_KEY_PAGE_UP;
  io.KeyMap[ImGuiKey_PageDown] = GLFW_KEY_PAGE_DOWN;
  io.KeyMap[ImGuiKey_Home] = GLFW_KEY_HOME;
  io.KeyMap[ImGuiKey_End] = GLFW_KEY_END;
  io.KeyMap[ImGuiKey_Insert] = GLFW_KEY_INSERT;
  io.KeyMap[ImGuiKey_Delete] = GLFW_KEY_DELETE;
  io.KeyMap[ImGuiKey_Backspace] = GLFW_KEY_BACKSPACE;
  io.KeyMap[ImGuiKey_Space] = GLFW_KEY_SPACE;
  io.KeyMap[ImGuiKey_Enter] = GLFW_KEY_ENTER;
  io.KeyMap[ImGuiKey_KeyPadEnter] = GLFW_KEY_KP_ENTER;
  io.KeyMap[ImGuiKey_Escape] = GLFW_KEY_ESCAPE;
  io.KeyMap[ImGuiKey_A] = GLFW_KEY_A;
  io.KeyMap[ImGuiKey_C] = GLFW_KEY_C;
  io.KeyMap[ImGuiKey_V] = GLFW_KEY_V;
  io.KeyMap[ImGuiKey_X] = GLFW_KEY_X;
  io.KeyMap[ImGuiKey_Y] = GLFW_KEY_Y;
  io.KeyMap[ImGuiKey_Z] = GLFW_KEY_Z;
}

}  // namespace

UiContext::UiContext(GlfwWindow& window) : window_(window) {
  ImGui::CreateContext();
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;  // what is remembered is ours to say
  io.LogFilename = nullptr;
  io.BackendFlags |= ImGuiBackendFlags_HasMouseCursors;
  io.ConfigInputTextCursorBlink = false;  // a window that sleeps
  io.ConfigWindowsMoveFromTitleBarOnly = true;
  io.GetClipboardTextFn = get_clipboard;
  io.SetClipboardTextFn = set_clipboard;
  io.ClipboardUserData = window.handle();
  map_keys(io);
  ImGui_ImplOpenGL3_Init("#version 330");
}

UiContext::~UiContext() {
  ImGui_ImplOpenGL3_Shutdown();
  ImGui::DestroyContext();
}

void UiContext::set_scale(double scale) {
  scale = std::clamp(scale, 1.0, 3.0);
  stale_ = stale_ || scale != scale_;
  scale_ = scale;
}

void UiContext::renew_fonts() {
  const bool first = ImGui::GetIO().Fonts->Fonts.empty();
  apply_theme(scale_);
  for (const std::string& missing : build_fonts(scale_)) {
    if (first && warn) warn("not found: " + missing);
  }
  if (!first) {
    ImGui_ImplOpenGL3_DestroyFontsTexture();
    ImGui_ImplOpenGL3_CreateFontsTexture();
  }
  stale_ = false;
}

void UiContext::begin_frame(glm::ivec2 size_px, double delta_s) {
  if (stale_ || glyphs_are_wanting()) renew_fonts();
  ImGui_ImplOpenGL3_NewFrame();
  ImGuiIO& io = ImGui::GetIO();
  io.DisplaySize = {static_cast<float>(size_px.x), static_cast<float>(size_px.y)};
  io.DeltaTime = static_cast<float>(std::clamp(delta_s, 1.0e-4, 1.0));
  window_.input().feed(io);
  ImGui::NewFrame();
  forget_widgets();
}

void UiContext::end_frame() {
  window_.set_cursor(ImGui::GetMouseCursor());
  ImGui::Render();
}

}  // namespace focalstage
