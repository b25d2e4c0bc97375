#include "editor/window/views/pane_text.h"

#include <algorithm>
#include <array>

#include "core/base/number_words.h"
#include "editor/window/base/fonts.h"
#include "editor/window/base/im.h"
#include "editor/window/base/theme.h"
#include "editor/window/base/widgets.h"

namespace focalstage {

std::string image_words(const ImageSpec& spec) {
  constexpr std::array<const char*, 3> eyes{"left eye, ", "right eye, ", "both eyes, "};
  std::string words = eyes[static_cast<std::size_t>(spec.eye)] + signed_text(spec.power_d, 2) + " D";
  if (spec.kind == ImageKind::surface_light) words += ", surface light";
  if (spec.kind == ImageKind::content_and_light) words += ", with surface light";
  return words;
}

std::string slot_label(const Slot& slot) {
  return (slot.eye == Side::left ? "L " : "R ") + signed_text(slot.power_d, 2);
}

std::string slot_words(const Slot& slot) {
  return std::string(slot.eye == Side::left ? "left" : "right") + " eye, " + signed_text(slot.power_d, 2) +
         " D, from " + fixed_text(slot.start_s * 1e3, 2) + " ms for " + fixed_text(slot.exposure_s * 1e3, 2) +
         " ms; trigger at " + fixed_text(slot.trigger_s * 1e3, 2) + " ms";
}

std::string pixel_words(glm::ivec2 pixel) {
  return "pixel " + std::to_string(pixel.x) + ", " + std::to_string(pixel.y);
}

std::string point_words(const PixelReading& reading) {
  std::string words = reading.surface + " at " + fixed_text(reading.point_m.x, 3) + ", " +
                      fixed_text(reading.point_m.y, 3) + ", " + fixed_text(reading.point_m.z, 3) + " m";
  if (!reading.seen) return words;
  return words + "; " + fixed_text(reading.surface_m, 3) + " m from the lens (" +
         fixed_text(1.0 / reading.surface_m, 2) + " D)";
}

std::string slice_words(const SliceReading& slice) {
  std::string words = signed_text(slice.power_d, 2) + " D: code " + std::to_string(slice.code);
  if (slice.object.empty()) return words;
  return words + "; " + slice.object + " wants " + signed_text(slice.wanted_d, 2) + " D, weight " +
         fixed_text(slice.weight, 2);
}

PaneTooltip::PaneTooltip() {
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {px(10), px(8)});
  ImGui::BeginTooltip();
}

PaneTooltip::~PaneTooltip() {
  ImGui::EndTooltip();
  ImGui::PopStyleVar();
}

void draw_hint(const PaneRect& rect, std::string_view words) {
  const std::string text(words);
  const float width = std::max(rect.size.x - px(48), px(60));
  const ImVec2 size = ImGui::CalcTextSize(text.c_str(), nullptr, false, width);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const glm::vec2 at = rect.min + 0.5f * (rect.size - from_im(size));
  list.AddText(ImGui::GetFont(), ImGui::GetFontSize(), to_im(glm::floor(at)), theme::dim, text.c_str(), nullptr, width);
}

glm::vec2 small_text_size(std::string_view text) {
  ImFont* font = small_font();
  return from_im(font->CalcTextSizeA(font->FontSize, 1e6f, 0.0f, text.data(), text.data() + text.size()));
}

void small_text(ImDrawList& list, glm::vec2 at, std::string_view text, std::uint32_t colour) {
  if (text.empty()) return;  // for ImGui an end of null is no end
  ImFont* font = small_font();
  list.AddText(font, font->FontSize, to_im(at), colour, text.data(), text.data() + text.size());
}

Thumbnail thumbnail_of(const FrameImages& images, std::size_t image) {
  const int step = std::max(1, images.width_px / 128);
  Thumbnail small;
  small.size_px = {std::max(1, images.width_px / step), std::max(1, images.height_px / step)};
  small.rgb.reserve(static_cast<std::size_t>(small.size_px.x) * static_cast<std::size_t>(small.size_px.y) * 3);
  const auto codes = images.image(image);
  const auto channels = static_cast<std::size_t>(images.channels);
  for (int y = 0; y < small.size_px.y; ++y) {
    for (int x = 0; x < small.size_px.x; ++x) {
      // The middle of each block; an eighth of the pixels says enough here.
      const auto column = static_cast<std::size_t>(std::min(x * step + step / 2, images.width_px - 1));
      const auto row = static_cast<std::size_t>(std::min(y * step + step / 2, images.height_px - 1));
      const std::size_t at = (row * static_cast<std::size_t>(images.width_px) + column) * channels;
      for (std::size_t c = 0; c < 3; ++c) small.rgb.push_back(codes[at + (channels == 3 ? c : 0)]);
    }
  }
  return small;
}

}  // namespace focalstage
