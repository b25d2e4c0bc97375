#include "editor/window/panels/outline_panel.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "editor/session/edits.h"
#include "editor/session/outline_rows.h"
#include "editor/session/session.h"
#include "editor/window/base/fonts.h"
#include "editor/window/base/frame_wish.h"
#include "editor/window/base/icons.h"
#include "editor/window/base/im.h"
#include "editor/window/base/widgets.h"
#include "editor/window/panels/key_pressed.h"
#include "editor/window/panels/outline_drag.h"
#include "editor/window/panels/outline_menus.h"
#include "editor/window/panels/outline_rename.h"
#include "editor/window/panels/outline_toggles.h"

namespace focalstage {
namespace {

/// With more things than this a filter is worth its line.
constexpr std::size_t many_things = 12;

class OutlinePanel final : public Panel {
 public:
  std::string_view name() const override { return "outline"; }
  PanelPlace place() const override { return PanelPlace::outline; }

  void draw(Session& session, const PaneRect&) override {
    refresh(session);
    draw_head(session);
    if (session.project().surfaces.empty() && session.project().objects.empty()) draw_empty();
    open_menu_ = false;
    if (ImGui::BeginChild("rows", {0.0f, 0.0f}, false, ImGuiWindowFlags_NoNav)) draw_rows(session);
    ImGui::EndChild();
    outline_menu(session, open_menu_);
    drag_.drop(session, drawn());
  }

 private:
  DrawnRows drawn() const { return {rows_, rows_top_px_, row_px_}; }

  void refresh(const Session& session) {
    if (session.revision() == shown_revision_ && folded_ == shown_folded_ && filter_ == shown_filter_) return;
    shown_revision_ = session.revision();
    shown_folded_ = folded_;
    const Project& project = session.project();
    things_ = project.surfaces.size() + project.objects.size() + project.lights.size() + project.projectors.size();
    if (things_ <= many_things) filter_.clear();
    shown_filter_ = filter_;
    rows_ = outline_rows(project, folded_, filter_);
  }

  void draw_head(Session& session) {
    ButtonStyle style;
    style.icon = "add";
    const float width = button_size("Add", style).x;
    const float right = ImGui::GetCursorPosX() + ImGui::GetContentRegionAvail().x - width;
    ImGui::AlignTextToFramePadding();
    ImGui::PushFont(strong_font());
    text_line("Outline");
    ImGui::PopFont();
    ImGui::SameLine(std::max(right, px(60)));
    add_button(session);
    if (things_ <= many_things) return;
    FieldStyle field;
    field.hint = "Filter";
    field.width_px = ImGui::GetContentRegionAvail().x;
    (void)text_field("filter", filter_, field);
    if (!filter_.empty() && key_pressed(ImGuiKey_Escape) && ImGui::IsItemDeactivated()) filter_.clear();
    if (!filter_.empty() && rows_.empty()) paragraph("Nothing is called so.", theme::dim);
  }

  static void draw_empty() {
    ImGui::Dummy({0.0f, px(4)});
    paragraph("Add a surface to project on, then an object.", theme::dim);
    ImGui::Dummy({0.0f, px(4)});
  }

  void draw_rows(Session& session) {
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {px(8), 0.0f});
    const float height = ImGui::GetFontSize() + px(6);
    reveal(session, height);
    rows_top_px_ = ImGui::GetCursorScreenPos().y;
    row_px_ = height;
    ImGuiListClipper clipper;  // hundreds of rows cost what is seen of them
    clipper.Begin(static_cast<int>(rows_.size()), height);
    while (clipper.Step()) {
      for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
        draw_row(session, rows_[static_cast<std::size_t>(i)]);
      }
    }
    clipper.End();
    if (drag_.active()) drag_.draw(drawn());
    ImGui::PopStyleVar();
    select_none_below(session);
  }

  /// A press beside all rows.
  static void select_none_below(Session& session) {
    if (ImGui::IsWindowHovered() && !ImGui::IsAnyItemHovered() && ImGui::IsMouseClicked(ImGuiMouseButton_Left)) {
      session.select({});
    }
  }

  /// What was selected elsewhere is brought into sight, its folds opened.
  void reveal(const Session& session, float height) {
    const Thing* primary = session.selection().primary();
    const Thing now = primary ? *primary : Thing{};
    if (now == revealed_) return;
    revealed_ = now;
    if (!primary) return;
    unfold(session, now);
    const auto at = std::find_if(rows_.begin(), rows_.end(), [&](const OutlineRow& row) {
      return row.kind == OutlineRow::Kind::thing && row.thing == now;
    });
    if (at == rows_.end()) return;
    const float top = static_cast<float>(at - rows_.begin()) * height;
    const float scroll = ImGui::GetScrollY();
    const float room = ImGui::GetWindowHeight();
    if (top < scroll) ImGui::SetScrollY(std::max(0.0f, top - height));
    if (top + 2.0f * height > scroll + room) ImGui::SetScrollY(top + 2.0f * height - room);
  }

  void unfold(const Session& session, const Thing& thing) {
    folded_.erase(thing.name.empty() ? "/" : thing.list + "/");
    const Object* object = thing.list == "objects" ? object_named(session.project(), thing.name) : nullptr;
    const Surface* surface = thing.list == "surfaces" ? surface_named(session.project(), thing.name) : nullptr;
    const std::string group = object ? object->group : surface ? surface->group : "";
    if (!group.empty()) folded_.erase(thing.list + "/" + group);
    refresh(session);
  }

  void draw_row(Session& session, const OutlineRow& row) {
    if (row.kind == OutlineRow::Kind::section) {
      draw_section(row);
    } else if (rename_.is_of(session, row)) {
      rename_.draw(session, row, row_px_);
    } else {
      draw_thing(session, row);
    }
  }

  void fold(const OutlineRow& row) {
    if (!folded_.erase(fold_key(row))) folded_.insert(fold_key(row));
    want_frame_within(0.0);
  }

  void draw_section(const OutlineRow& row) {
    const glm::vec2 min = from_im(ImGui::GetCursorScreenPos());
    const glm::vec2 size(ImGui::GetContentRegionAvail().x, row_px_);
    ImGui::PushID(row.label.c_str());
    const bool pressed = ImGui::InvisibleButton("section", {std::max(size.x, px(20)), size.y});
    ImGui::PopID();
    see_last_item(row.label);
    if (pressed && filter_.empty()) fold(row);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    ImFont* font = small_font();
    const float y = std::floor(min.y + 0.5f * (size.y - font->FontSize)) + px(1);
    list.AddText(font, font->FontSize, {min.x + px(2), y}, theme::dim, row.label.c_str());
    const float label = font->CalcTextSizeA(font->FontSize, 1e6f, 0.0f, row.label.c_str()).x;
    if (row.count > 1 || !row.open) {
      const std::string count = std::to_string(row.count);
      list.AddText(font, font->FontSize, {min.x + px(10) + label, y}, theme::faint, count.c_str());
    }
    if (row.open && !ImGui::IsItemHovered()) return;
    const std::string_view caret = icon(row.open ? "down" : "collapse");
    list.AddText(font, std::round(font->FontSize * 0.75f), {min.x + size.x - px(14), y + px(2)}, theme::dim,
                 caret.data(), caret.data() + caret.size());
  }

  bool is_selected(const Session& session, const OutlineRow& row) const {
    if (row.kind == OutlineRow::Kind::thing) return session.selection().has(row.thing);
    if (row.open) return false;
    const auto members = members_of(session.project(), row.thing);
    return std::all_of(members.begin(), members.end(), [&](const Thing& one) { return session.selection().has(one); });
  }

  void draw_thing(Session& session, const OutlineRow& row) {
    const glm::vec2 min = from_im(ImGui::GetCursorScreenPos());
    const float width = ImGui::GetContentRegionAvail().x;
    const float toggle = px(22);
    ListRowStyle style;
    style.icon = row.icon;
    if (row.kind == OutlineRow::Kind::group) style.icon = row.open ? "down" : "collapse";
    style.selected = is_selected(session, row);
    style.icon_colour = row.hidden ? theme::faint : style.selected ? theme::text : theme::dim;
    style.text_colour = row.hidden ? theme::dim : theme::text;
    style.indent_px = row.inside ? px(18) : 0.0f;
    style.right_room_px = row.can_hide ? 2.0f * toggle : 0.0f;
    const std::string count = row.kind == OutlineRow::Kind::group ? std::to_string(row.count) : "";
    style.right = count;
    const bool over = ImGui::IsMouseHoveringRect(to_im(min), {min.x + width, min.y + row_px_}) && !drag_.active();
    if (over && elided_at(row.label, width, style)) style.tip.help = row.label;
    const RowPress press = list_row(row.label, row.label, style);
    if (filter_.empty()) drag_.follow(row);
    if (row.can_hide) draw_toggles(session, row, {min.x + width - 2.0f * toggle, min.y}, {toggle, row_px_}, over);
    follow_press(session, row, press);
  }

  static bool elided_at(const std::string& label, float width, const ListRowStyle& style) {
    const float room = width - style.indent_px - style.right_room_px - px(34);
    return label.size() > 400 || ImGui::CalcTextSize(label.c_str()).x > room;
  }

  // Selecting -----------------------------------------------------------------------------------------------------

  void follow_press(Session& session, const OutlineRow& row, const RowPress& press) {
    if (press.double_clicked) {
      rename_.begin(session, row);
    } else if (press.clicked && !drag_.active()) {
      select(session, row);
    } else if (press.right_clicked) {
      const std::vector<Thing> things = things_of(session.project(), row);
      const bool among =
          std::all_of(things.begin(), things.end(), [&](const Thing& thing) { return session.selection().has(thing); });
      if (!among) choose(session, things);
      open_menu_ = true;
    }
  }

  void choose(Session& session, const std::vector<Thing>& things) {
    session.select(things);
    if (!things.empty()) anchor_ = revealed_ = things.back();
  }

  void select(Session& session, const OutlineRow& row) {
    const ImGuiIO& io = ImGui::GetIO();
    const bool caret = row.kind == OutlineRow::Kind::group && io.MousePos.x < ImGui::GetWindowPos().x + px(24);
    if (caret) {
      fold(row);
    } else if (io.KeyShift) {
      select_range(session, row, io.KeyCtrl);
    } else if (io.KeyCtrl) {
      Selection next = session.selection();
      for (const Thing& thing : things_of(session.project(), row)) next.toggle(thing);
      choose(session, next.things);
      anchor_ = row.thing;
    } else {
      choose(session, things_of(session.project(), row));
    }
  }

  /// All rows between the last one pressed and this one; it becomes the last of them.
  void select_range(Session& session, const OutlineRow& row, bool add) {
    const auto place = [&](const Thing& thing) {
      return std::find_if(rows_.begin(), rows_.end(), [&](const OutlineRow& one) {
        return one.kind == OutlineRow::Kind::thing && one.thing == thing;
      });
    };
    auto from = place(anchor_), to = place(row.thing);
    if (to == rows_.end()) return;
    if (from == rows_.end()) from = to;
    std::vector<Thing> things = add ? session.selection().things : std::vector<Thing>{};
    const bool down = from <= to;
    for (auto at = from;; down ? ++at : --at) {
      if (at->kind == OutlineRow::Kind::thing && std::find(things.begin(), things.end(), at->thing) == things.end()) {
        things.push_back(at->thing);
      }
      if (at == to) break;
    }
    const Thing kept = from->thing;
    choose(session, things);
    anchor_ = kept;
  }

  std::vector<OutlineRow> rows_;
  std::uint64_t shown_revision_ = ~0ull;
  std::set<std::string> folded_, shown_folded_;
  std::string filter_, shown_filter_;
  std::size_t things_ = 0;
  Thing anchor_;    ///< where a range begins
  Thing revealed_;  ///< the last one that was brought into sight
  OutlineRename rename_;
  OutlineDrag drag_;
  bool open_menu_ = false;
  float rows_top_px_ = 0.0f;
  float row_px_ = 1.0f;
};

}  // namespace

std::unique_ptr<Panel> make_outline_panel() { return std::make_unique<OutlinePanel>(); }

}  // namespace focalstage
