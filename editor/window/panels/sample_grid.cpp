#include "editor/window/panels/sample_grid.h"

#include <algorithm>
#include <cmath>

#include "editor/session/session.h"
#include "editor/window/base/fonts.h"
#include "editor/window/base/im.h"
#include "editor/window/base/widgets.h"

namespace focalstage {
namespace {

constexpr double least_card = 190.0;
constexpr double most_card = 260.0;
constexpr double gap = 12.0;
constexpr double text_rows = 64.0;  ///< below the picture: the title and two lines

/// Words wrapped into at most two lines of `width_px`.
void draw_says(ImDrawList& list, glm::vec2 at, float width_px, const std::string& says) {
  list.PushClipRect(to_im(at), {at.x + width_px, at.y + 2.2f * small_font()->FontSize}, true);
  list.AddText(small_font(), small_font()->FontSize, to_im(at), theme::dim, says.data(), says.data() + says.size(),
               width_px);
  list.PopClipRect();
}

}  // namespace

Picture SampleGrid::picture_of(const SampleCard& card) {
  if (!card.picture) return {};
  auto& texture = textures_[card.name];
  if (!texture) {
    texture = std::make_unique<CodesTexture>();
    texture->set({card.picture->width_px, card.picture->height_px}, 3, card.picture->rgb);
  }
  Picture picture = texture->picture();
  picture.filter = Picture::Filter::linear;
  return picture;
}

void SampleGrid::draw_card(Session& session, const SampleCard& card, float width_px) {
  const glm::vec2 min = from_im(ImGui::GetCursorScreenPos());
  const glm::vec2 picture_size(width_px, std::round(width_px * 2.0f / 3.0f));
  const glm::vec2 size(width_px, picture_size.y + px(text_rows));
  ImGui::PushID(card.name.c_str());
  const bool pressed = ImGui::InvisibleButton("card", to_im(size));
  ImGui::PopID();
  see_last_item(card.name);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const bool hovered = ImGui::IsItemHovered();
  list.AddRectFilled(to_im(min), to_im(min + size), hovered ? theme::field_hovered : theme::raised, px(6));
  list.AddRectFilled(to_im(min), to_im(min + picture_size), theme::view, px(6), ImDrawFlags_RoundCornersTop);
  draw_picture(picture_of(card), min, picture_size);
  const glm::vec2 text = min + glm::vec2(px(10), picture_size.y + px(7));
  list.AddText(strong_font(), strong_font()->FontSize, to_im(text), theme::text, card.title.c_str());
  draw_says(list, text + glm::vec2(0.0f, px(20)), width_px - px(20), card.says);
  tip_for_last_item({card.says, {}, {}});
  if (!pressed) return;
  Value args;
  args.set("from", card.name);
  (void)session.run("file.new", args);
}

void SampleGrid::draw(Session& session) {
  session.want_sample_pictures();
  const NameScope scope("samples");
  const float room = ImGui::GetContentRegionAvail().x;
  const int columns = std::max(1, static_cast<int>((room + px(gap)) / (px(least_card) + px(gap))));
  const float spaces = static_cast<float>(columns - 1) * px(gap);
  const float width_px = std::floor(std::min((room - spaces) / static_cast<float>(columns), px(most_card)));
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {px(gap), px(gap)});
  for (std::size_t i = 0; i < session.sample_cards().size(); ++i) {
    if (i % static_cast<std::size_t>(columns) != 0) ImGui::SameLine(0.0f, px(gap));
    draw_card(session, session.sample_cards()[i], width_px);
    if (session.has_document()) break;
  }
  ImGui::PopStyleVar();
}

}  // namespace focalstage
