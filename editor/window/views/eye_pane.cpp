#include "editor/window/views/eye_pane.h"

#include <algorithm>
#include <cmath>

#include "editor/session/session.h"
#include "editor/tools/fixed_text.h"
#include "editor/window/base/chips.h"
#include "editor/window/base/im.h"
#include "editor/window/base/widgets.h"
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
  draw_chips(session, rect);
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
  ButtonStyle kind;
  kind.icon = "compare";
  kind.down = view.conventional;
  kind.tip = {"Against a conventional projection: one slice at 0 D, no sweep", "C", {}};
  if (chips.button("conventional", view.conventional ? "Conventional" : "Multifocal", kind)) {
    (void)session.run("eye.conventional");
  }
  ButtonStyle which;
  which.icon = "eye";
  which.tip = {"Left eye, right eye, or both red-cyan", "E", {}};
  const char* eye = view.eye == EyeShown::left ? "Left" : view.eye == EyeShown::right ? "Right" : "Red-cyan";
  if (chips.button("which", eye, which)) (void)session.run("eye.which");
  const auto picture = session.eye_picture();
  if (picture->divisor > 1) chips.label("", picture->divisor == 2 ? "half size" : "quarter size");
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
