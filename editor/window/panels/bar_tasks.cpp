// What runs behind the window, with a button that ends it.
#include <algorithm>
#include <string>
#include <vector>

#include "editor/session/session.h"
#include "editor/window/base/im.h"
#include "editor/window/base/widgets.h"
#include "editor/window/panels/bar_part.h"

namespace focalstage {
namespace {

class TasksPart final : public BarPart {
 public:
  BarItem look(const Session& session) override {
    shown_.clear();
    std::ranges::copy_if(session.tasks(), std::back_inserter(shown_), [](const Task& task) { return !task.quiet; });
    if (shown_.empty()) return {{0.0f}, {}};
    text_ = shown_[0].title;
    if (shown_.size() > 1) text_ += " and " + std::to_string(shown_.size() - 1) + " more";
    const float cancel = button_size("", {}).x;
    const float words = std::min(ImGui::CalcTextSize(text_.c_str()).x, px(most_words));
    return {{words + px(bar + 12) + cancel, px(bar + 4) + cancel, 0.0f}, {20, 76}};
  }

  void draw(Session& session, std::size_t form) override {
    const glm::vec2 min = from_im(ImGui::GetCursorScreenPos());
    float x = min.x;
    if (form == 0) {
      ImGui::SetCursorScreenPos({x, min.y + ImGui::GetStyle().FramePadding.y});
      const float words = std::min(ImGui::CalcTextSize(text_.c_str()).x, px(most_words));
      elided_line(text_, words + 1.0f, theme::dim);
      x += words + px(8);
    }
    ImGui::SetCursorScreenPos({x, min.y + 0.5f * (ImGui::GetFrameHeight() - px(4))});
    progress_bar(shown_[0].share, px(bar));
    std::string help = shown_[0].title;
    if (!shown_[0].detail.empty()) help += "\n" + shown_[0].detail;
    tip_for_last_item({help, {}, {}});
    ImGui::SetCursorScreenPos({x + px(bar + 4), min.y});
    ButtonStyle style;
    style.look = ButtonLook::quiet;
    style.icon = "cancel";
    style.tip.help = "Cancel";
    if (icon_button("cancel task", style)) session.cancel_task(shown_[0].id);
  }

 private:
  static constexpr double most_words = 200.0;
  static constexpr double bar = 70.0;
  std::vector<Task> shown_;
  std::string text_;
};

}  // namespace

BarPartPtr make_tasks_part() { return std::make_unique<TasksPart>(); }

}  // namespace focalstage
