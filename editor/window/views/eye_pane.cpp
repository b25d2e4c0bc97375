#include "editor/window/views/eye_pane.h"

#include <algorithm>
#include <cmath>

#include "core/base/number_words.h"
#include "core/percept/conflict.h"
#include "editor/session/session.h"
#include "editor/window/base/chips.h"
#include "editor/window/base/im.h"
#include "editor/window/base/widgets.h"
#include "editor/window/views/off_rig_popup.h"
#include "editor/window/views/pane_text.h"

namespace focalstage {
namespace {

/// The retina is computed at most this wide: finer than the blur of a pupil shows, and quick enough to follow a hand.
constexpr double widest_px = 480.0;
constexpr double nearest_d = 6.0;
constexpr double farthest_d = -0.5;

/// "at 0.50 m", "at infinity"
std::string distance_words(double focus_d) {
  if (focus_d < 0.02) return focus_d > -0.02 ? "infinity" : "beyond infinity";
  return fixed_text(1.0 / focus_d, focus_d > 1.0 ? 2 : 1) + " m";
}

const char* look_words(EyeLook look) {
  switch (look) {
    case EyeLook::left:
      return "Left";
    case EyeLook::right:
      return "Right";
    case EyeLook::red_cyan:
      return "Red-cyan";
    case EyeLook::side_by_side:
      return "Side by side";
  }
  return "";
}

/// Of the row of chips at the top, with the gap below it.
float chips_height() { return ImGui::GetFrameHeight() + px(16); }

float controls_height() { return ImGui::GetFrameHeight() + px(16); }

}  // namespace

bool EyePane::dirty(const Session& session, glm::ivec2 size_px) const {
  return session.eye_picture() != shown_ || size_px != size_px_;
}

void EyePane::render(const Session& session, glm::ivec2 size_px, double scale) {
  const auto picture = session.eye_picture();
  size_px_ = size_px;
  if (picture != shown_) {
    shown_ = picture;
    if (picture) {
      plane_.set({picture->width_px, picture->height_px}, 3, picture->rgb);
    } else {
      plane_.clear();
    }
  }
  plane_.render(size_px, fitted(plane_.size_px(), glm::dvec2(size_px)), scale);
}

void EyePane::draw(Session& session, const PaneRect& rect) {
  const double shrink = std::min(1.0, widest_px / std::max(rect.size.x, 1.0f));
  session.want_eye_size(static_cast<int>(rect.size.x * shrink), static_cast<int>(rect.size.y * shrink));
  draw_picture(plane_.picture(), rect.min, rect.size);
  const Project& project = session.project();
  if (project.surfaces.empty() || project.objects.empty() || !session.eye_picture()) {
    draw_hint(rect, project.surfaces.empty()  ? "The eye sees what falls on a surface: add one first."
                    : project.objects.empty() ? "Add an object: the eye sees it here, sharp or blurred."
                                              : "The eye sees the show once it is compiled.");
    return;
  }
  answer_mouse(session, rect);
  draw_panels(rect);
  draw_chips(session, rect);
  draw_conflicts(session, rect);
  if (rect.size.y > 4.0f * controls_height()) draw_controls(session, rect);
}

void EyePane::answer_mouse(Session& session, const PaneRect& rect) {
  ImGui::SetCursorScreenPos(to_im(rect.min));
  ImGui::InvisibleButton("retina", to_im(rect.size));
  ImGui::SetItemAllowOverlap();
  see_last_item("retina");
  const glm::vec2 at = from_im(ImGui::GetIO().MousePos) - rect.min;
  if (ImGui::IsItemClicked()) {
    const glm::dvec2 image =
        image_from_pane(fitted(plane_.size_px(), glm::dvec2(rect.size)), glm::dvec2(rect.size), glm::dvec2(at));
    session.focus_at(image / glm::dvec2(glm::max(plane_.size_px(), glm::ivec2(1))));
    asked_at_ = at;
  }
  if (ImGui::IsItemHovered() && ImGui::GetIO().MouseWheel != 0.0f) {
    session.view().focus_d =
        std::clamp(session.view().focus_d + 0.1 * ImGui::GetIO().MouseWheel, farthest_d, nearest_d);
    asked_at_.reset();
  }
  if (asked_at_) {
    const glm::vec2 centre = rect.min + *asked_at_;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddCircle(to_im(centre), px(7), theme::accent, 0, px(1.5f));
    list.AddCircleFilled(to_im(centre), px(2), theme::accent);
  }
}

void EyePane::draw_chips(Session& session, const PaneRect& rect) {
  const ViewState& view = session.view();
  Chips chips(rect, Chips::Corner::top_right);
  ButtonStyle conflict;
  conflict.icon = "exchange";
  conflict.down = view.conflict;
  conflict.tip = {
      "Where vergence and accommodation part: red where the focus lies further away, blue where nearer", "V", {}};
  if (chips.button("conflict", "", conflict)) (void)session.run("eye.conflict");
  ButtonStyle kind;
  kind.icon = "compare";
  kind.down = view.projection != EyeProjection::multifocal;
  kind.tip = {"Multifocal, conventional (one slice at 0 D, no sweep), or both beside each other", "C, Shift+C", {}};
  const char* const shown = view.projection == EyeProjection::both           ? "Both"
                            : view.projection == EyeProjection::conventional ? "Conventional"
                                                                             : "Multifocal";
  if (chips.button("conventional", shown, kind)) {
    Value next;
    next.set("projection", view.projection == EyeProjection::multifocal     ? "conventional"
                           : view.projection == EyeProjection::conventional ? "both"
                                                                            : "multifocal");
    (void)session.run("eye.conventional", next);
  }
  ButtonStyle which;
  which.icon = "eye";
  which.tip = {"Left eye, right eye, both red-cyan, or side by side", "E", {}};
  if (chips.button("which", look_words(view.eye), which)) (void)session.run("eye.which");
  ButtonStyle off;
  off.icon = "warning";
  off.down = !view.rig_errors.empty();
  off.tip = {"What is seen where the rig is not quite as the project says: lens, poses, eyes, delay", {}, {}};
  if (chips.button("off-rig", off.down ? "Off" : "What if", off)) ImGui::OpenPopup(off_rig_popup);
  draw_off_rig_popup(session, rect);
  const auto picture = session.eye_picture();
  if (picture->divisor > 1) chips.label("", picture->divisor == 2 ? "half size" : "quarter size");
}

/// Lines between the panels, and what each is where they differ.
void EyePane::draw_panels(const PaneRect& rect) {
  if (!shown_ || shown_->panels.size() < 2) return;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const std::size_t count = shown_->panels.size();
  const float width = rect.size.x / static_cast<float>(count);
  const bool looks = shown_->panels.front().look != shown_->panels.back().look;
  const bool projections = shown_->panels.front().projection != shown_->panels.back().projection;
  for (std::size_t i = 0; i < count; ++i) {
    const EyePanel& panel = shown_->panels[i];
    const float left = rect.min.x + width * static_cast<float>(i);
    if (i > 0) list.AddLine({left, rect.min.y}, {left, rect.min.y + rect.size.y}, theme::line, px(1));
    std::string words = looks ? look_words(panel.look) : "";
    if (projections) {
      const bool conventional = panel.projection == EyeProjection::conventional;
      words = words.empty() ? conventional ? "Conventional" : "Multifocal"
                            : words + (conventional ? ", conventional" : ", multifocal");
    }
    const ImVec2 size = ImGui::CalcTextSize(words.c_str());
    if (size.x + px(16) > width) continue;
    const glm::vec2 min(left + 0.5f * (width - size.x), rect.min.y + chips_height());
    list.AddRectFilled({min.x - px(6), min.y - px(3)}, {min.x + size.x + px(6), min.y + size.y + px(3)}, theme::chip,
                       px(3));
    list.AddText(to_im(min), theme::text, words.c_str());
  }
}

/// What the tints amount to, thing by thing, the worst first; as many as there is room for.
void EyePane::draw_conflicts(const Session& session, const PaneRect& rect) {
  if (!session.view().conflict || !shown_ || shown_->conflicts.empty()) return;
  std::vector<NamedConflict> worst = shown_->conflicts;
  std::stable_sort(worst.begin(), worst.end(), [](const NamedConflict& a, const NamedConflict& b) {
    return std::abs(a.mean_d) > std::abs(b.mean_d);
  });
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float line = ImGui::GetTextLineHeightWithSpacing(), gap = px(8);
  const float top = rect.min.y + 2.0f * chips_height();
  const float room = rect.size.y - 2.0f * chips_height() - controls_height() - 4.0f * gap;
  const auto rows = std::min(worst.size(), static_cast<std::size_t>(std::max(0.0f, room / line)));
  const float width = std::min(px(210), rect.size.x - 2.0f * gap);
  if (rows == 0) return;
  const glm::vec2 min(rect.min.x + gap, top);
  list.AddRectFilled(to_im(min), {min.x + width, min.y + line * static_cast<float>(rows) + gap}, theme::chip, px(4));
  for (std::size_t i = 0; i < rows; ++i) {
    const float y = min.y + 0.5f * gap + line * static_cast<float>(i);
    const std::string amount = signed_text(worst[i].mean_d, 2) + " D";
    const float amount_width = ImGui::CalcTextSize(amount.c_str()).x;
    const bool beyond = std::abs(worst[i].mean_d) > comfort_d;
    list.PushClipRect({min.x, y}, {min.x + width - amount_width - 2.0f * gap, y + line}, true);
    list.AddText({min.x + gap, y}, theme::text, worst[i].name.c_str());
    list.PopClipRect();
    list.AddText({min.x + width - gap - amount_width, y}, beyond ? theme::red : theme::dim, amount.c_str());
  }
}

void EyePane::draw_controls(Session& session, const PaneRect& rect) {
  ViewState& view = session.view();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float height = controls_height(), gap = px(8);
  const glm::vec2 min(rect.min.x + gap, rect.min.y + rect.size.y - height - gap);
  const float whole = rect.size.x - 2.0f * gap;
  list.AddRectFilled(to_im(min), to_im(min + glm::vec2(whole, height)), theme::chip, px(4));
  ImGui::SetCursorScreenPos({min.x + gap, min.y + px(8)});
  const bool roomy = whole > px(430);
  const float pupil = roomy ? px(150) : 0.0f, head = px(34);
  FieldStyle focus;
  focus.width_px = std::max(whole - pupil - head - px(110) - 5.0f * gap, px(60));
  focus.tip = {"Where the eye focuses. Click in the picture to focus there.", "[ ]", {}};
  if (slider("focus", view.focus_d, farthest_d, nearest_d, 2, "D", focus)) asked_at_.reset();
  ImGui::SameLine(0.0f, gap);
  ImGui::AlignTextToFramePadding();
  const std::string away = distance_words(view.focus_d);
  const float text_x = ImGui::GetCursorScreenPos().x;
  text_line(away, theme::dim);
  if (roomy) {
    ImGui::SameLine();
    ImGui::SetCursorScreenPos({text_x + px(104), min.y + px(8)});
    FieldStyle wide;
    wide.width_px = pupil;
    wide.tip = {"The pupil's diameter: the wider, the more blur beside the focus", {}, {}};
    (void)slider("pupil", view.pupil_mm, 1.0, 8.0, 1, "mm pupil", wide);
  }
  draw_head(session, {{min.x + whole - head - gap, min.y + px(4)}, {head, height - px(8)}});
}

/// A small pad: where the head stands beside where the images are made for, 5 cm to each side.
void EyePane::draw_head(Session& session, const PaneRect& rect) {
  ViewState& view = session.view();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  ImGui::SetCursorScreenPos(to_im(rect.min));
  ImGui::InvisibleButton("head", to_im(rect.size));
  see_last_item("head");
  tip_for_last_item(
      {"Move the head by up to 5 cm: the images stay those made for where it was. Double-click: back", {}, {}});
  const glm::vec2 centre = rect.min + 0.5f * rect.size;
  const float reach = 0.5f * std::min(rect.size.x, rect.size.y) - px(2);
  if (ImGui::IsItemActive()) {
    const glm::dvec2 at = glm::dvec2(from_im(ImGui::GetIO().MousePos) - centre) / static_cast<double>(reach);
    Value args;
    args.set("x_m", 0.05 * std::clamp(at.x, -1.0, 1.0));
    args.set("y_m", -0.05 * std::clamp(at.y, -1.0, 1.0));
    (void)session.run("eye.head", args);
  }
  if (ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) (void)session.run("eye.head");
  list.AddRectFilled(to_im(rect.min), to_im(rect.min + rect.size), theme::field, px(4));
  list.AddLine({centre.x - reach, centre.y}, {centre.x + reach, centre.y}, theme::line);
  list.AddLine({centre.x, centre.y - reach}, {centre.x, centre.y + reach}, theme::line);
  const glm::vec2 moved(static_cast<float>(view.head_offset_m.x / 0.05),
                        static_cast<float>(-view.head_offset_m.y / 0.05));
  const bool at_home = moved == glm::vec2(0.0f);
  list.AddCircleFilled(to_im(centre + moved * reach), px(4), at_home ? theme::dim : theme::accent);
}

void EyePane::finalize() { plane_.finalize(); }

}  // namespace focalstage
