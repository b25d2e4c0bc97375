// What is open, in the bar: undo and redo, the project's name, how its compile stands, what was found.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>

#include "editor/session/session.h"
#include "editor/window/base/fonts.h"
#include "editor/window/base/frame_wish.h"
#include "editor/window/base/im.h"
#include "editor/window/base/widgets.h"
#include "editor/window/panels/bar_part.h"
#include "editor/window/panels/command_widgets.h"
#include "editor/window/panels/status_text.h"

namespace focalstage {
namespace {

class UndoPart final : public BarPart {
 public:
  BarItem look(const Session& session) override {
    if (!session.has_document()) return {{0.0f}, {}};
    const History& history = session.document().history();
    undo_ = history.can_undo() ? "Undo: " + history.steps()[history.place() - 1].words : "Undo";
    redo_ = history.can_redo() ? "Redo: " + history.steps()[history.place()].words : "Redo";
    want_glyphs(undo_);
    want_glyphs(redo_);
    return {{2.0f * button_size("", {}).x + px(2), 0.0f}, {80}};
  }

  void draw(Session& session, std::size_t) override {
    ButtonStyle style;
    style.look = ButtonLook::quiet;
    style.tip.help = undo_;
    command_button(session, "edit.undo", "Undo", "", style);
    ImGui::SameLine(0.0f, px(2));
    style.tip.help = redo_;
    command_button(session, "edit.redo", "Redo", "", style);
  }

 private:
  std::string undo_;
  std::string redo_;
};

/// The project's name, a dot while there is something to save, and the revision.
class ProjectPart final : public BarPart {
 public:
  BarItem look(const Session& session) override {
    if (!session.has_document()) return {{0.0f}, {}};
    name_ = session.project().name.empty() ? "Untitled" : session.project().name;
    want_glyphs(name_);
    unsaved_ = session.document().unsaved();
    revision_ = "revision " + std::to_string(session.document().history().revision());
    file_ = session.document().untitled() ? "Never saved" : session.document().file().string();
    if (unsaved_) file_ += session.document().untitled() ? "" : "\nEdited since it was saved";
    ImGui::PushFont(strong_font());
    const auto named = [&](double most) {
      return std::min(std::ceil(ImGui::CalcTextSize(name_.c_str()).x), px(most)) + px(unsaved_ ? 28 : 12);
    };
    const BarItem item{
        {named(320) + px(8) + ImGui::CalcTextSize(revision_.c_str()).x, named(320), named(180), named(90), 0.0f},
        {10, 40, 60, 75}};
    ImGui::PopFont();
    return item;
  }

  void draw(Session&, std::size_t form) override {
    constexpr std::array<double, 4> most{320, 320, 180, 90};
    const glm::vec2 min = from_im(ImGui::GetCursorScreenPos());
    const float y = min.y + ImGui::GetStyle().FramePadding.y;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    ImGui::PushFont(strong_font());
    const std::string shown = elided(name_, px(most[form]) + 1.0f);
    const float width = std::ceil(ImGui::CalcTextSize(shown.c_str()).x);
    ImGui::PopFont();
    list.AddText(strong_font(), strong_font()->FontSize, {min.x + px(6), y}, theme::text, shown.c_str());
    float x = min.x + px(6) + width;
    if (unsaved_) {
      list.AddCircleFilled({x + px(9), y + ImGui::GetFontSize() * 0.55f}, px(3), theme::accent, 16);
      x += px(16);
    }
    if (form == 0) list.AddText({x + px(10), y}, theme::dim, revision_.c_str());
    const float whole = form == 0 ? x + px(10) + ImGui::CalcTextSize(revision_.c_str()).x - min.x : x + px(6) - min.x;
    ImGui::Dummy({whole, ImGui::GetFrameHeight()});
    see_last_item("project");
    const std::string help = shown == name_ ? file_ : name_ + "\n" + file_;
    tip_for_last_item({help, {}, {}});
  }

 private:
  std::string name_;
  std::string file_;
  std::string revision_;
  bool unsaved_ = false;
};

class CompilePart final : public BarPart {
 public:
  BarItem look(const Session& session) override {
    if (!session.has_document()) return {{0.0f}, {}};
    take(session);
    status_.text = text_;
    status_.tip.help = help_;
    status_.least_width_px = px(160);  // numbers come and go beside other things of the bar
    StatusText small = status_;
    small.text = {};
    small.least_width_px = 0.0f;
    return {{status_width(status_), status_width(small), 0.0f}, {30, 78}};
  }

  void draw(Session&, std::size_t form) override {
    StatusText shown = status_;
    if (form > 0) {
      shown.text = {};
      shown.least_width_px = 0.0f;
      shown.tip.help = whole_;
    }
    status_text("compile", shown);
  }

 private:
  /// A compile of a few milliseconds is not worth a word that flickers.
  static constexpr double patience_s = 0.2;

  void say(const char* icon, std::uint32_t colour, std::uint32_t text_colour, std::string text, std::string help) {
    status_.icon = icon;
    status_.icon_colour = colour;
    status_.text_colour = text_colour;
    text_ = std::move(text);
    help_ = std::move(help);
    whole_ = text_ + ". " + help_;
  }

  void take(const Session& session) {
    const bool busy = session.compiling();
    if (!busy) busy_since_s_ = -1.0;
    if (busy && busy_since_s_ < 0.0) busy_since_s_ = ImGui::GetTime();
    const bool long_busy = busy && ImGui::GetTime() - busy_since_s_ > patience_s;
    if (busy && !long_busy) want_frame_within(patience_s);
    const auto slices = session.slices();
    if (const auto fault = session.compile_fault()) {
      say("error", theme::red, theme::text, "does not compile", describe(*fault));
    } else if (session.project().slices.powers_d.empty() || session.project().projectors.empty()) {
      say("info", theme::dim, theme::dim, "nothing to compile", "It takes a projector and a slice.");
    } else if (!slices || long_busy) {
      say("refresh", theme::dim, theme::dim, "compiling…", "The frame in view, behind the window.");
    } else if (slices->divisor > 1) {
      say("refresh", theme::dim, theme::dim, slices->divisor == 2 ? "half size" : "quarter size",
          "While things move, slices are compiled small; whole once the hand rests.");
    } else {
      std::array<char, 48> text{};
      std::snprintf(text.data(), text.size(), slices->compile_ms < 9.95 ? "compiled in %.1f ms" : "compiled in %.0f ms",
                    slices->compile_ms);
      say("check", theme::green, theme::text, text.data(),
          "Frame " + std::to_string(slices->frame) + ", " + std::to_string(slices->images.count) + " images of " +
              std::to_string(slices->settings.projector.width_px) + " × " +
              std::to_string(slices->settings.projector.height_px) + " pixels.");
    }
  }

  StatusText status_;
  std::string text_;
  std::string help_;
  std::string whole_;
  double busy_since_s_ = -1.0;
};

/// How many things are wrong; a click shows them.
class FindingsPart final : public BarPart {
 public:
  BarItem look(const Session& session) override {
    if (!session.has_document()) return {{0.0f}, {}};
    const std::size_t count = session.findings().size();
    number_ = std::to_string(count);
    text_ = count == 0 ? "no findings" : number_ + (count == 1 ? " finding" : " findings");
    status_.icon = count == 0 ? "check" : "warning";
    status_.icon_colour = count == 0 ? theme::dim : theme::amber;
    status_.text_colour = count == 0 ? theme::dim : theme::text;
    status_.answers = true;
    status_.tip.help = count == 0 ? "Nothing is wrong with the project" : "What is wrong with the project";
    status_.text = text_;
    StatusText small = status_;
    small.text = number_;
    return {{status_width(status_), status_width(small), 0.0f}, {35, 79}};
  }

  void draw(Session& session, std::size_t form) override {
    status_.text = form == 0 ? text_ : number_;
    if (status_text("findings", status_)) (void)session.run("view.findings");
  }

 private:
  StatusText status_;
  std::string text_;
  std::string number_;
};

}  // namespace

BarPartPtr make_undo_part() { return std::make_unique<UndoPart>(); }
BarPartPtr make_project_part() { return std::make_unique<ProjectPart>(); }
BarPartPtr make_compile_part() { return std::make_unique<CompilePart>(); }
BarPartPtr make_findings_part() { return std::make_unique<FindingsPart>(); }

}  // namespace focalstage
