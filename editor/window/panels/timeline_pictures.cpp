#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>

#include "editor/session/edits.h"
#include "editor/session/session.h"
#include "editor/window/base/fonts.h"
#include "editor/window/base/icons.h"
#include "editor/window/base/im.h"
#include "editor/window/base/widgets.h"
#include "editor/window/panels/timeline_ruler.h"

// What the ruler looks like.

namespace focalstage {
namespace {

constexpr double label_room = 46.0;  ///< design pixels between numbers

/// 1, 2, 5, 10, 20 ... frames: the first that leaves room for its number.
int label_step(double px_per_frame) {
  double step = 1.0;
  for (int k = 0; step * px_per_frame < static_cast<double>(px(label_room)) && k < 30; ++k) {
    step *= k % 3 == 1 ? 2.5 : 2.0;
  }
  return static_cast<int>(step);
}

void draw_diamond(glm::vec2 centre, float radius, std::uint32_t fill, std::uint32_t line) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImVec2 corners[4] = {{centre.x, centre.y - radius},
                             {centre.x + radius, centre.y},
                             {centre.x, centre.y + radius},
                             {centre.x - radius, centre.y}};
  list.AddConvexPolyFilled(corners, 4, fill);
  if (line != 0) list.AddPolyline(corners, 4, line, ImDrawFlags_Closed, px(1));
}

}  // namespace

void TimelineRuler::draw_ticks(const Session&) const {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const double px_per_frame = static_cast<double>(x_of(1.0) - x_of(0.0));
  const int step = count_ > 1 ? label_step(px_per_frame) : 1;
  const int fine = px_per_frame >= static_cast<double>(px(5)) ? 1 : std::max(step / 5, 1);
  const float top = rect_.min.y + px(band);
  ImFont* font = small_font();
  for (int frame = 0; frame < count_; frame += fine) {
    const bool numbered = frame % step == 0;
    const float x = std::floor(x_of(frame));
    list.AddRectFilled({x, top - (numbered ? px(4) : px(2))}, {x + std::max(px(1), 1.0f), top},
                       numbered ? theme::dim : theme::faint);
    if (!numbered) continue;
    const std::string text = std::to_string(frame);
    const float width = font->CalcTextSizeA(font->FontSize, 1e6f, 0.0f, text.c_str()).x;
    const float left = std::clamp(x - std::floor(0.5f * width), rect_.min.x + px(2),
                                  std::max(rect_.min.x + rect_.size.x - width - px(2), rect_.min.x));
    list.AddText(font, font->FontSize, {left, rect_.min.y - px(1)}, theme::dim, text.c_str());
  }
  list.AddLine({rect_.min.x, top}, {rect_.min.x + rect_.size.x, top}, theme::line);
}

void TimelineRuler::draw_cues(const Session& session, const Mark& hovered) const {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const std::vector<Cue>& cues = session.project().cues;
  ImFont* font = small_font();
  const float top = rect_.min.y + px(band);
  const std::string_view flag = icon("cue");
  for (std::size_t i = 0; i < cues.size(); ++i) {
    const float x = std::floor(x_of(cues[i].time_s * rate_hz_));
    const bool lit = hovered.kind == Held::cue && hovered.cue == cues[i].name;
    const std::uint32_t colour = lit ? theme::text : theme::dim;
    list.AddRectFilled({x, top}, {x + px(1), rect_.min.y + rect_.size.y}, theme::green);
    list.AddText(font, std::round(font->FontSize * 0.8f), {x + px(2), top + px(2)}, theme::green, flag.data(),
                 flag.data() + flag.size());
    see_widget("cue " + cues[i].name, {x - px(5), top}, {x + px(5), rect_.min.y + rect_.size.y});
    float end = rect_.min.x + rect_.size.x;
    for (const Cue& other : cues) {
      const float other_x = x_of(other.time_s * rate_hz_);
      if (other_x > x + 1.0f) end = std::min(end, other_x);
    }
    for (const Keyframe& key : keys_of(session)) {
      const float key_x = x_of(key.time_s * rate_hz_) - px(8);
      if (key_x > x + px(4)) end = std::min(end, key_x);
    }
    if (end - x < px(36)) continue;
    ImGui::PushFont(font);
    const std::string name = elided(cues[i].name, end - x - px(20));
    ImGui::PopFont();
    list.AddText(font, font->FontSize, {x + px(16), top}, colour, name.c_str());
  }
}

void TimelineRuler::draw_keys(const Session& session, const Mark& hovered) const {
  const auto& chosen = session.view().key_time_s;
  const float y = std::floor(0.5f * (rect_.min.y + px(band) + rect_.min.y + rect_.size.y));
  std::size_t number = 0;
  for (const Keyframe& key : keys_of(session)) {
    const double frame = key.time_s * rate_hz_;
    see_widget("key " + std::to_string(number++), {x_of(frame) - px(5), y - px(5)}, {x_of(frame) + px(5), y + px(5)});
    if (frame > count_ - 0.5) continue;  // after the last frame
    const bool is_chosen = chosen && same_key(*chosen, key.time_s);
    const bool here = same_key(key.time_s, session.view().frame / rate_hz_);
    const bool lit = hovered.kind == Held::key && same_key(hovered.time_s, key.time_s);
    draw_diamond({x_of(frame), y}, px(lit || is_chosen ? 7 : 6),
                 is_chosen ? theme::accent
                 : lit     ? theme::colour(0xFFFFFF)
                 : here    ? theme::text
                           : theme::dim,
                 theme::panel);
  }
}

void TimelineRuler::draw_playhead(const Session& session) const {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float x = std::floor(x_of(session.view().frame)) + 0.5f;
  list.AddLine({x, rect_.min.y + px(4)}, {x, rect_.min.y + rect_.size.y}, theme::accent, std::max(px(1), 1.0f));
  const std::string text = std::to_string(session.view().frame);
  ImFont* font = small_font();
  const float width = font->CalcTextSizeA(font->FontSize, 1e6f, 0.0f, text.c_str()).x + px(8);
  const float left =
      std::clamp(std::floor(x - 0.5f * width), rect_.min.x, std::max(rect_.min.x + rect_.size.x - width, rect_.min.x));
  list.AddRectFilled({left, rect_.min.y}, {left + width, rect_.min.y + px(15)}, theme::accent_fill, px(3));
  list.AddText(font, font->FontSize, {left + px(4), rect_.min.y - px(1)}, theme::colour(0xFFFFFF), text.c_str());
}

}  // namespace focalstage
