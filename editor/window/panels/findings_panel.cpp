#include "editor/window/panels/findings_panel.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <string>
#include <vector>

#include "core/check/words.h"
#include "editor/session/edit_words.h"
#include "editor/session/session.h"
#include "editor/window/base/fonts.h"
#include "editor/window/base/icons.h"
#include "editor/window/base/im.h"
#include "editor/window/base/widgets.h"

namespace focalstage {
namespace {

/// A finding in the words of the table.
struct Row {
  std::string name;  ///< of its widgets
  std::string message;
  std::string place;   ///< "rabbit", "Slice at 0.5 D"
  std::string amount;  ///< "0.72 D, allowed 0.6 D"
  std::string remedy;  ///< "Add a slice at 0.6 D"; empty: none is known
};

std::string amount_words(const Finding& finding) {
  if (!finding.amount) return {};
  const Amount& amount = *finding.amount;
  const std::string unit = amount.unit.empty() ? "" : " " + amount.unit;
  return words(amount.value) + unit + ", limit " + words(amount.limit) + unit;
}

/// Messages begin in lower case, as faults do; in a table they stand alone.
std::string sentence(std::string text) {
  if (!text.empty()) text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  return text;
}

struct Mark {
  std::string_view icon;
  std::uint32_t colour;
};

Mark mark_of(Severity severity) {
  if (severity == Severity::error) return {"error", theme::red};
  if (severity == Severity::warning) return {"warning", theme::amber};
  return {"info", theme::dim};
}

/// Where the columns of the table begin, for its width; those there is no room for have no width.
struct Columns {
  explicit Columns(float width) {
    code = width >= px(1000) ? px(190) : 0.0f;
    place = width >= px(700) ? px(150) : 0.0f;
    amount = width >= px(1200) ? px(180) : 0.0f;
    remedy = width >= px(560) ? std::floor(width * 0.28f) : px(70);
  }
  float code, place, amount, remedy;
};

class FindingsPanel final : public Panel {
 public:
  std::string_view name() const override { return "findings"; }
  PanelPlace place() const override { return PanelPlace::bottom; }
  std::string_view title() const override { return "Findings"; }

  std::string badge(const Session& session) const override {
    const std::size_t count = session.findings().size();
    return count > 0 ? std::to_string(count) : "";
  }

  void draw(Session& session, const PaneRect&) override {
    take(session);
    if (findings_.empty()) {
      const auto known = session.checked();
      const bool looked = known && known->measured;
      paragraph(looked ? "Nothing wrong." : "Looking…", theme::dim);
      return;
    }
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {px(8), px(2)});
    for (std::size_t i = 0; i < findings_.size(); ++i) {
      if (draw_finding(session, i)) break;  // a remedy was applied: the rest may be gone
    }
    ImGui::PopStyleVar();
  }

 private:
  void take(const Session& session) {
    std::vector<Finding> now = session.findings();
    if (now == findings_ && session.revision() == revision_) return;
    findings_ = std::move(now);
    revision_ = session.revision();
    rows_.clear();
    for (const Finding& finding : findings_) {
      rows_.push_back({finding.code + " " + finding.where, sentence(finding.message),
                       place_words(finding.where, session.project()), amount_words(finding),
                       edit_words(finding.remedy, session.project())});
      want_glyphs(finding.message);
      want_glyphs(rows_.back().place);
      want_glyphs(rows_.back().remedy);
    }
  }

  /// True when its remedy was applied.
  bool draw_finding(Session& session, std::size_t index) {
    const Row& row = rows_[index];
    const glm::vec2 min = from_im(ImGui::GetCursorScreenPos());
    const glm::vec2 size(std::max(ImGui::GetContentRegionAvail().x, px(40)), ImGui::GetFrameHeight());
    ImGui::PushID(static_cast<int>(index));
    const bool pressed = ImGui::InvisibleButton("finding", to_im(size));
    ImGui::SetItemAllowOverlap();
    see_last_item(row.name);
    const bool hovered = ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenOverlapped);
    bool applied = false;
    if (ImGui::IsItemVisible()) {
      draw_words(index, min, size, hovered);
      applied = draw_remedy(session, index, min, size);
    }
    ImGui::SetCursorScreenPos({min.x, min.y + size.y + px(2)});
    if (open_ == row.name) draw_whole(index);
    ImGui::PopID();
    if (pressed && !applied) {
      open_ = open_ == row.name ? std::string() : row.name;
      Value args;
      args.set("index", static_cast<double>(index));
      (void)session.run("finding.show", args);
    }
    return applied;
  }

  void draw_words(std::size_t index, glm::vec2 min, glm::vec2 size, bool hovered) const {
    const Finding& finding = findings_[index];
    const Row& row = rows_[index];
    const bool open = open_ == row.name;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    if (open || hovered) {
      list.AddRectFilled(to_im(min), to_im(min + size), open ? theme::field : theme::raised, px(4));
    }
    const Columns columns(size.x);
    const float y = min.y + ImGui::GetStyle().FramePadding.y;
    float x = min.x + px(6);
    const auto column = [&](const std::string& text, float width, std::uint32_t colour) {
      if (width <= 0.0f) return;
      list.AddText({x, y}, colour, elided(text, width - px(12)).c_str());
      x += width;
    };
    const Mark mark = mark_of(finding.severity);
    const std::string_view glyph = icon(mark.icon);
    list.AddText({x, y}, mark.colour, glyph.data(), glyph.data() + glyph.size());
    x += px(28);
    column(finding.code, columns.code, theme::dim);
    column(row.place, columns.place, theme::text);
    const float right = min.x + size.x - columns.remedy - columns.amount;
    column(row.message, right - x, theme::text);
    column(row.amount, columns.amount, theme::dim);
  }

  bool draw_remedy(Session& session, std::size_t index, glm::vec2 min, glm::vec2 size) {
    const std::string& remedy = rows_[index].remedy;
    if (remedy.empty()) return false;
    const float room = Columns(size.x).remedy;
    const std::string help = "Apply: " + remedy;
    ButtonStyle style;
    style.icon = "remedy";
    style.tip.help = help;
    const float words_room = room - button_size("", style).x - px(20);
    const std::string label = words_room > px(60) ? elided(remedy, words_room) : "Apply";
    if (words_room <= px(60)) style.icon = {};
    ImGui::SetCursorScreenPos({min.x + size.x - button_size(label, style).x, min.y});
    if (!named_button("remedy " + rows_[index].name, label, style)) return false;
    Value args;
    args.set("index", static_cast<double>(index));
    (void)session.run("finding.remedy", args);
    return true;
  }

  /// Everything about the finding that was clicked.
  void draw_whole(std::size_t index) const {
    const Finding& finding = findings_[index];
    const Row& row = rows_[index];
    ImGui::Indent(px(34));
    paragraph(row.message);
    std::string facts = finding.code + "   " + finding.where;
    if (!row.amount.empty()) facts += "   " + row.amount;
    paragraph(facts, theme::dim);
    paragraph(row.remedy.empty() ? "No remedy is known." : "Remedy: " + row.remedy, theme::dim);
    ImGui::Unindent(px(34));
    ImGui::Dummy({0.0f, px(4)});
  }

  std::vector<Finding> findings_;
  std::vector<Row> rows_;
  std::uint64_t revision_ = 0;
  std::string open_;  ///< the name of the row that was clicked
};

}  // namespace

std::unique_ptr<Panel> make_findings_panel() { return std::make_unique<FindingsPanel>(); }

}  // namespace focalstage
