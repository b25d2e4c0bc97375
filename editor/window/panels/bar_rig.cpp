// The rig in the bar: its state and what leads to it, play, push, live, blackout.
#include <array>
#include <cstdio>
#include <string>

#include "editor/session/session.h"
#include "editor/window/base/fonts.h"
#include "editor/window/base/im.h"
#include "editor/window/base/widgets.h"
#include "editor/window/panels/bar_part.h"
#include "editor/window/panels/command_widgets.h"
#include "editor/window/panels/menu.h"
#include "editor/window/panels/rig_menu.h"
#include "editor/window/panels/status_text.h"

namespace focalstage {
namespace {

using Phase = RigStatus::Phase;

std::string state_word(const RigStatus& rig) {
  switch (rig.phase) {
    case Phase::none:
      return "no rig";
    case Phase::connecting:
      return "connecting…";
    case Phase::lost:
      return "rig lost";
    case Phase::connected:
      break;
  }
  return rig.state.state.empty() ? "connected" : rig.state.state;
}

std::string rig_words(const RigStatus& rig) {
  if (rig.phase == Phase::lost) return "rig lost, trying again";
  if (rig.phase != Phase::connected) return state_word(rig);
  return (rig.simulated ? std::string("simulated rig") : rig.address) + ", " + state_word(rig);
}

std::uint32_t rig_colour(const RigStatus& rig) {
  if (rig.phase == Phase::lost) return theme::amber;
  if (rig.fault || !rig.state.fault.empty()) return theme::red;
  if (rig.phase != Phase::connected) return theme::dim;
  return rig.state.state == "playing" ? theme::green : theme::text;
}

class RigPart final : public BarPart {
 public:
  BarItem look(const Session& session) override {
    const RigStatus rig = session.rig().status();
    long_ = rig_words(rig);
    short_ = state_word(rig);
    if (ImGui::CalcTextSize(long_.c_str()).x > px(260)) long_ = elided(long_, px(260));
    status_.icon = rig.phase == Phase::lost ? "disconnect" : "rig";
    status_.icon_colour = rig_colour(rig);
    status_.text_colour = rig.phase == Phase::lost ? theme::amber : rig.phase == Phase::none ? theme::dim : theme::text;
    status_.caret = true;
    status_.answers = true;
    help_ = rig.fault ? describe(*rig.fault) : "The rig, and how to get to one";
    status_.tip.help = help_;
    BarItem item{{}, {25, 55, 85}};
    for (const std::string& text : {long_, short_, std::string()}) {
      status_.text = text;
      item.widths.push_back(status_width(status_));
    }
    item.widths.push_back(0.0f);
    return item;
  }

  void draw(Session& session, std::size_t form) override {
    status_.text = form == 0 ? std::string_view(long_) : form == 1 ? std::string_view(short_) : std::string_view();
    const glm::vec2 min = from_im(ImGui::GetCursorScreenPos());
    const bool pressed = status_text("rig", status_);
    menu_.draw(session, pressed, min, from_im(ImGui::GetItemRectMax()));
  }

 private:
  StatusText status_;
  std::string long_;
  std::string short_;
  std::string help_;
  RigMenu menu_;
};

/// Play, Hold or Go: whichever the rig's state leads to next.
class PlayPart final : public BarPart {
 public:
  BarItem look(const Session& session) override {
    const RigStatus rig = session.rig().status();
    if (rig.phase != Phase::connected) return {{0.0f}, {}};
    const std::string& state = rig.state.state;
    command_ = state == "dark" ? "rig.go" : state == "playing" ? "rig.hold" : "rig.play";
    label_ = state == "dark" ? "Go" : state == "playing" ? "Hold" : "Play";
    style_.icon = state == "playing" ? "pause" : "play";
    style_.look = state == "dark" ? ButtonLook::accent : ButtonLook::plain;
    empty_ = state == "empty";
    return {{button_size(label_, style_).x, button_size("", style_).x, 0.0f}, {56, 70}};
  }

  void draw(Session& session, std::size_t form) override {
    const std::string_view label = form == 0 ? label_ : std::string_view();
    if (!empty_) {
      command_button(session, command_, label_, label, style_);
      return;
    }
    ButtonStyle style = style_;
    style.tip = {"Play on the rig", {}, "push a show first"};
    named_button(label_, label, style);
  }

 private:
  std::string_view command_;
  std::string_view label_;
  ButtonStyle style_;
  bool empty_ = false;
};

/// Push; while one is under way how far it is, and a way to end it.
class PushPart final : public BarPart {
 public:
  BarItem look(const Session& session) override {
    const RigStatus rig = session.rig().status();
    pushing_ = rig.pushing;
    if (!session.has_document() && !pushing_) return {{0.0f}, {}};
    share_ = rig.push_share;
    step_ = rig.push_step.empty() ? "Pushing" : rig.push_step;
    style_.icon = "push";
    style_.look = ButtonLook::accent;
    if (!pushing_) return {{button_size("Push", style_).x, button_size("", style_).x, 0.0f}, {57, 72}};
    const float bar_and_end = px(bar + 4) + button_size("", style_).x;
    return {{px(words) + bar_and_end, bar_and_end, 0.0f}, {57, 72}};
  }

  void draw(Session& session, std::size_t form) override {
    if (!pushing_) {
      command_button(session, "rig.push", "Push", form == 0 ? "Push" : "", style_);
      return;
    }
    const glm::vec2 min = from_im(ImGui::GetCursorScreenPos());
    float x = min.x;
    if (form == 0) {
      ImGui::SetCursorScreenPos({x, min.y + ImGui::GetStyle().FramePadding.y});
      elided_line(step_ + "…", px(words - 8), theme::dim);
      x += px(words);
    }
    ImGui::SetCursorScreenPos({x, min.y + 0.5f * (ImGui::GetFrameHeight() - px(4))});
    progress_bar(share_, px(bar));
    see_last_item("push progress");
    ImGui::SetCursorScreenPos({x + px(bar + 4), min.y});
    ButtonStyle style;
    style.look = ButtonLook::quiet;
    style.icon = "cancel";
    command_button(session, "rig.cancel-push", "cancel push", "", style);
  }

 private:
  static constexpr double words = 84.0;
  static constexpr double bar = 80.0;
  bool pushing_ = false;
  double share_ = 0.0;
  std::string step_;
  ButtonStyle style_;
};

class LivePart final : public BarPart {
 public:
  BarItem look(const Session& session) override {
    if (!session.has_document()) return {{0.0f}, {}};
    const RigStatus rig = session.rig().status();
    style_.icon = "live";
    style_.down = rig.live_wanted;
    help_ = "Edits go to the rig as they are made";
    delay_ = "Live";
    if (rig.live && rig.edit_to_light_ms >= 0.0) {
      std::array<char, 48> text{};
      std::snprintf(text.data(), text.size(), "Live  %.0f ms", rig.edit_to_light_ms);
      delay_ = text.data();
      help_ += ".\nFrom the last edit to its light took " + delay_.substr(6);
    }
    return {{button_size(delay_, style_).x, button_size("Live", style_).x, button_size("", style_).x, 0.0f},
            {15, 58, 71}};
  }

  void draw(Session& session, std::size_t form) override {
    style_.tip.help = help_;
    const std::string_view label = form == 0 ? std::string_view(delay_) : form == 1 ? "Live" : "";
    command_button(session, "rig.live", "Live", label, style_);
  }

 private:
  ButtonStyle style_;
  std::string delay_;
  std::string help_;
};

/// Always there, always to be pressed.
class BlackoutPart final : public BarPart {
 public:
  BarItem look(const Session&) override { return {{button_size("Blackout", style()).x}, {}}; }
  void draw(Session& session, std::size_t) override {
    const glm::vec2 min = from_im(ImGui::GetCursorScreenPos());
    command_button(session, "rig.blackout", "Blackout", "Blackout", style());
    if (ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopup)) draw_above(session, min, from_im(ImGui::GetItemRectMax()));
  }

 private:
  /// Menus and dialogs take the first click for themselves, and dim what is behind them: not this.
  static void draw_above(Session& session, glm::vec2 min, glm::vec2 max) {
    const bool under_hand = ImGui::IsMouseHoveringRect(to_im(min), to_im(max), false);
    ImDrawList& list = *ImGui::GetForegroundDrawList();
    list.AddRectFilled(to_im(min), to_im(max), under_hand ? theme::colour(0xCB3537) : theme::red_fill, px(4));
    const glm::vec2 at = glm::floor(0.5f * (min + max - from_im(ImGui::CalcTextSize("Blackout"))));
    list.AddText(ui_font(), ui_font()->FontSize, to_im(at), theme::colour(0xFFFFFF), "Blackout");
    if (under_hand && ImGui::IsMouseClicked(ImGuiMouseButton_Left)) (void)session.run("rig.blackout");
  }

  static ButtonStyle style() {
    ButtonStyle style;
    style.look = ButtonLook::danger;
    return style;
  }
};

}  // namespace

BarPartPtr make_rig_part() { return std::make_unique<RigPart>(); }
BarPartPtr make_play_part() { return std::make_unique<PlayPart>(); }
BarPartPtr make_push_part() { return std::make_unique<PushPart>(); }
BarPartPtr make_live_part() { return std::make_unique<LivePart>(); }
BarPartPtr make_blackout_part() { return std::make_unique<BlackoutPart>(); }

}  // namespace focalstage
