#include "editor/window/app/editor.h"

#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <limits>
#include <utility>

#include "devices/input/spacemouse.h"
#include "editor/window/base/fonts.h"
#include "editor/window/base/frame_wish.h"
#include "editor/window/base/vtk_target.h"
#include "editor/window/panels/panels.h"
#include "editor/window/views/views.h"

namespace focalstage {
namespace {

constexpr double frame_s = 1.0 / 60.0;
constexpr std::size_t most_frame_times = 10000;
constexpr int frames_after_news = 3;  // ImGui answers a press in the frame after it; popups take one more

void warn(std::string_view line) {
  std::fprintf(stderr, "focalstage-editor: %.*s\n", static_cast<int>(line.size()), line.data());
}

bool same_chord(const KeyChord& chord, std::string_view shortcut) {
  const auto named = chord_named(shortcut);
  return named && *named == chord;
}

}  // namespace

double seconds_now() {
  static const auto start = std::chrono::steady_clock::now();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

Editor::Editor(std::unique_ptr<GlfwWindow> window, const EditorOptions& options)
    : window_(std::move(window)),
      ui_(*window_),
      session_(&GlfwWindow::wake),
      workbench_(make_panels(), make_panes(), options.remembered.splits),
      config_(options.config),
      remembered_(options.remembered),
      wish_at_s_(std::numeric_limits<double>::infinity()) {
  ui_.warn = [](const std::string& line) { warn(line); };
  send_vtk_messages_to(warn);
  set_scale(options.scale > 0.0 ? options.scale : window_->content_scale());
  session_.view().steering.how = remembered_.steer;
  if (options.space_mouse) steering_.emplace(make_spacemouse(), &GlfwWindow::wake);
}

Editor::~Editor() {
  remember();
  steering_.reset();
  workbench_.finalize();
  painter_.release();
  send_vtk_messages_to(nullptr);
}

void Editor::set_scale(double scale) {
  scale_ = std::clamp(scale, 1.0, 3.0);
  ui_.set_scale(scale_);
  lively_frames_ = frames_after_news;
}

bool Editor::unsettled() const {
  return !window_->input().empty() || workbench_.unsettled() || glyphs_are_wanting() || session_.compiling() ||
         lively_frames_ > 0;
}

double Editor::wait_s(double last_frame_s) const {
  const double now = seconds_now();
  const bool busy = lively_frames_ > 0 || workbench_.unsettled() || !window_->input().empty();
  if (busy) return std::max(0.0, last_frame_s + frame_s - now);
  return std::max(0.0, std::min(wish_at_s_, session_.next_update_s()) - now);
}

bool Editor::take_news(double wait_s) {
  window_->take_events(wait_s);
  if (window_->take_close()) (void)session_.run("app.quit");
  const bool news = session_.update(seconds_now());
  const bool hands = !window_->input().empty();
  const bool due = seconds_now() >= wish_at_s_;
  const bool resized = window_->framebuffer_px() != drawn_size_px_ || window_->take_exposed();
  if (resized) painter_.touch_all();
  const bool pushed = steering_ && steering_->wants_frame(session_);
  if (news || hands || resized || pushed) lively_frames_ = frames_after_news;
  return lively_frames_ > 0 || due || workbench_.unsettled();
}

void Editor::run() {
  double last_frame_s = -1.0;
  while (!session_.wants_to_quit()) {
    if (!take_news(wait_s(last_frame_s))) continue;
    const double now = seconds_now();
    if (now < last_frame_s + frame_s * 0.9) continue;  // woken before the next frame's time
    const double delta = last_frame_s < 0.0 ? frame_s : std::min(now - last_frame_s, 0.5);
    last_frame_s = now;
    frame({delta, !window_->minimized()});
  }
}

std::vector<double> Editor::take_frame_times_ms() { return std::exchange(frame_times_ms_, {}); }

void Editor::frame(const FrameKind& kind) {
  const double began_s = seconds_now();
  show_frame(kind);
  if (frame_times_ms_.size() < most_frame_times) frame_times_ms_.push_back((seconds_now() - began_s) * 1000.0);
}

void Editor::show_frame(const FrameKind& kind) {
  want_names();
  const glm::ivec2 size = window_->framebuffer_px();
  drawn_size_px_ = size;
  ui_.begin_frame(size, kind.delta_s);
  follow_shortcuts();
  import_dropped();
  if (steering_) steering_->follow(session_, kind.delta_s, seconds_now(), ImGui::IsAnyMouseDown());
  const auto& filled = session_.view().filled;
  WorkbenchFrame shown{size, scale_, session_.has_document(), std::nullopt, kind.drawn};
  if (filled) shown.filled = static_cast<int>(*filled);
  workbench_.draw(session_, shown, painter_);
  follow_fill_press();
  // A field that went away while it was dragged cannot say that the hand let go.
  const bool steered = steering_ && steering_->drags();
  if (session_.dragging() && !ImGui::IsAnyMouseDown() && !steered) session_.end_drag();
  ui_.end_frame();
  wish_at_s_ = seconds_now() + take_frame_wish();
  lively_frames_ = std::max(0, lively_frames_ - 1);
  if (kind.drawn && painter_.paint(*ImGui::GetDrawData(), size)) window_->swap();
  window_->set_title(session_.has_document() ? session_.project().name + " - Focalstage" : "Focalstage");
}

/// Escape closes the popup in front, if there is one that is no question.
bool Editor::close_popup() {
  const auto& popups = ImGui::GetCurrentContext()->OpenPopupStack;
  const bool escape = std::ranges::any_of(window_->input().pressed(),
                                          [](const KeyChord& chord) { return same_chord(chord, "Escape"); });
  if (!escape || popups.empty()) return false;
  const ImGuiWindow* front = popups.back().Window;
  if (front != nullptr && (front->Flags & ImGuiWindowFlags_Modal) == 0) {
    ImGui::ClosePopupToLevel(popups.Size - 1, true);
  }
  return true;
}

void Editor::follow_shortcuts() {
  const ImGuiIO& io = ImGui::GetIO();
  const bool asked =
      session_.question() != nullptr || session_.file_wish() != FileWish::none || session_.palette_open();
  const bool popup = ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopup);
  const bool elsewhere = io.WantTextInput || asked || (!asked && close_popup()) || popup;
  for (const KeyChord& chord : window_->input().pressed()) {
    for (const Command& command : commands()) {
      if (command.shortcut.empty() || !same_chord(chord, command.shortcut)) continue;
      if (elsewhere && command.id != "rig.blackout") break;  // darkness waits for no dialog
      (void)session_.run(command.id);
      break;
    }
  }
}

void Editor::import_dropped() {
  for (const std::filesystem::path& file : window_->input().dropped()) {
    Value args;
    args.set("path", file.string());
    (void)session_.run("file.import", args);
  }
}

void Editor::follow_fill_press() {
  const auto press = workbench_.take_fill_press();
  if (!press) return;
  auto& filled = session_.view().filled;
  filled = filled ? std::nullopt : std::optional(static_cast<PaneId>(*press));
  lively_frames_ = frames_after_news;
}

/// Names of the project and lines of the log are what may hold any script of the world.
void Editor::want_names() {
  if (session_.has_document() && session_.revision() != named_revision_) {
    named_revision_ = session_.revision();
    want_glyphs(session_.project().name);
    for (const Thing& thing : things_of(session_.project())) want_glyphs(thing.name);
  }
  const Log& log = session_.log();
  if (log.size() == named_log_) return;
  named_log_ = log.size();
  if (!log.empty()) want_glyphs(log.back().text);
}

void Editor::remember() {
  if (config_.empty()) return;
  const WindowConfig now{workbench_.splits(), drawn_size_px_.x > 0 ? drawn_size_px_ : remembered_.size_px,
                         session_.view().steering.how};
  if (now == remembered_) return;
  if (const Status saved = save_window_config(now, config_); !saved) warn(describe(saved.fault()));
}

}  // namespace focalstage
