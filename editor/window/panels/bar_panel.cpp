#include "editor/window/panels/bar_panel.h"

#include <cmath>
#include <vector>

#include "editor/window/base/im.h"
#include "editor/window/base/theme.h"
#include "editor/window/panels/bar_part.h"

namespace focalstage {
namespace {

constexpr std::size_t parts_at_left = 6;

class BarPanel final : public Panel {
 public:
  BarPanel() {
    parts_.push_back(make_file_part());
    parts_.push_back(make_undo_part());
    parts_.push_back(make_project_part());
    parts_.push_back(make_compile_part());
    parts_.push_back(make_findings_part());
    parts_.push_back(make_tasks_part());
    parts_.push_back(make_rig_part());
    parts_.push_back(make_play_part());
    parts_.push_back(make_push_part());
    parts_.push_back(make_live_part());
    parts_.push_back(make_blackout_part());
  }

  std::string_view name() const override { return "bar"; }
  PanelPlace place() const override { return PanelPlace::bar; }

  void draw(Session& session, const PaneRect& rect) override {
    std::vector<BarItem> items;
    for (const BarPartPtr& part : parts_) items.push_back(part->look(session));
    const float gap = px(6);
    const float room = rect.size.x - px(2 * margin) + gap;
    const std::vector<std::size_t> forms = fit_bar(items, room, gap);
    const auto width_of = [&](std::size_t i) { return items[i].widths[forms[i]]; };
    float right_width = -gap;
    for (std::size_t i = parts_at_left; i < parts_.size(); ++i) right_width += width_of(i) > 0 ? width_of(i) + gap : 0;
    const float y = rect.min.y + std::floor(0.5f * (rect.size.y - ImGui::GetFrameHeight()));
    float x = rect.min.x + px(margin);
    // The red button is drawn last and at the very right, whatever else there is no room for.
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      if (i == parts_at_left) x = rect.min.x + rect.size.x - px(margin) - right_width;
      if (width_of(i) <= 0.0f) continue;
      ImGui::SetCursorScreenPos({x, y});
      parts_[i]->draw(session, forms[i]);
      x += width_of(i) + gap;
    }
  }

 private:
  static constexpr double margin = 8.0;
  std::vector<BarPartPtr> parts_;
};

}  // namespace

std::unique_ptr<Panel> make_bar_panel() { return std::make_unique<BarPanel>(); }

}  // namespace focalstage
