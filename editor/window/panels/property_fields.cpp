#include "editor/window/panels/property_fields.h"

#include <algorithm>
#include <cmath>

#include "editor/session/colour_text.h"
#include "editor/tools/srgb.h"
#include "editor/window/base/fonts.h"
#include "editor/window/base/icons.h"
#include "editor/window/base/im.h"
#include "editor/window/base/widgets.h"

namespace focalstage {
namespace {

constexpr double picker_width = 232.0;
constexpr double picker_height = 270.0;

float text_width(const std::string& text) { return ImGui::CalcTextSize(text.c_str()).x; }
float remove_width() { return ImGui::GetFrameHeight() + px(2); }

Tip tip_of(const Property& row) { return {row.help, {}, row.unavailable}; }

/// Dim and small, left of the column that begins at the cursor: the same in another unit. Left out, and told by the
/// label's tip, where the label needs the room.
void draw_other(const Property& row, float column_x) {
  if (row.other.empty() || row.mixed) return;
  const float label_end = ImGui::GetWindowPos().x + ImGui::GetStyle().WindowPadding.x + text_width(row.label) + px(8);
  ImGui::PushFont(small_font());
  const float x = column_x - px(9) - text_width(row.other);
  if (x >= label_end) {
    const float y =
        ImGui::GetItemRectMin().y + std::floor(0.5f * (ImGui::GetFrameHeight() + px(2) - ImGui::GetFontSize()));
    ImGui::GetWindowDrawList()->AddText({x, y}, theme::dim, row.other.c_str());
  }
  ImGui::PopFont();
}

/// The label and the place of the field, `room_px` kept free right of it. Returns the field's width.
float begin_field(const Property& row, float room_px = 0.0f) {
  property_row(row.label, tip_of(row));
  draw_other(row, ImGui::GetCursorScreenPos().x);
  const float width = ImGui::CalcItemWidth() - room_px;
  return std::max(width, px(20));
}

/// A small cross, quiet until the hand is on it. True when pressed.
bool cross(const Property& row) {
  const glm::vec2 min = from_im(ImGui::GetCursorScreenPos());
  const glm::vec2 size(ImGui::GetFrameHeight());
  const std::string name = row.id + " remove";
  ImGui::PushID(name.c_str());
  const bool pressed = ImGui::InvisibleButton("cross", to_im(size));
  ImGui::PopID();
  see_last_item(name);
  tip_for_last_item({"Take it away", {}, {}});
  const std::string_view glyph = icon("close");
  const float font_size = std::round(0.8f * ImGui::GetFontSize());
  const ImVec2 text = ImGui::GetFont()->CalcTextSizeA(font_size, 1e6f, 0.0f, glyph.data(), glyph.data() + glyph.size());
  const glm::vec2 at = glm::floor(min + 0.5f * (size - from_im(text)));
  ImGui::GetWindowDrawList()->AddText(ImGui::GetFont(), font_size, to_im(at),
                                      ImGui::IsItemHovered() ? theme::text : theme::faint, glyph.data(),
                                      glyph.data() + glyph.size());
  return pressed;
}

/// The cross behind a field that can go. True when pressed.
bool remove_button(const Property& row) {
  ImGui::SameLine(0.0f, px(2));
  return cross(row);
}

glm::dvec3 rgb_of(const Value& value) {
  glm::dvec3 color(0.0);
  const Value::Array* items = value.array();
  for (int i = 0; items && i < 3 && static_cast<std::size_t>(i) < items->size(); ++i) {
    const double* number = (*items)[static_cast<std::size_t>(i)].number();
    if (number) color[i] = *number;
  }
  return color;
}

Value value_of_rgb(const glm::dvec3& color) { return Value(Value::Array{color.r, color.g, color.b}); }

std::uint32_t packed(const glm::dvec3& coded) {
  const glm::uvec3 bytes(glm::round(glm::clamp(coded, 0.0, 1.0) * 255.0));
  return theme::colour((bytes.r << 16) | (bytes.g << 8) | bytes.b);
}

std::uint32_t tone_colour(Property::Tone tone) {
  return tone == Property::Tone::red ? theme::red : tone == Property::Tone::amber ? theme::amber : theme::text;
}

PropertyChange set_to(Value value) {
  PropertyChange change;
  change.value = std::move(value);
  change.changed = true;
  return change;
}

PropertyChange draw_shown(const Property& row) {
  const float right = ImGui::GetCursorScreenPos().x + ImGui::GetContentRegionAvail().x;
  const std::string text = row.mixed ? "—" : row.value.text() ? *row.value.text() : "";
  const ImVec2 min = ImGui::GetCursorScreenPos();
  property_value(row.label, text, tone_colour(row.tone));
  const ImVec2 max = ImGui::GetItemRectMax();
  see_widget(row.id, from_im(min), from_im(max));
  tip_for_last_item(tip_of(row));
  draw_other(row, right - std::min(text_width(text), 0.65f * (right - min.x)) - ImGui::GetStyle().FramePadding.x);
  if (!row.removable) return {};
  // The cross stands before the value, which keeps its place in the column.
  const float x = right - text_width(text) - ImGui::GetStyle().FramePadding.x - remove_width();
  const ImVec2 below = ImGui::GetCursorScreenPos();
  ImGui::SetCursorScreenPos({x - px(2), min.y});
  const bool pressed = cross(row);
  ImGui::SetCursorScreenPos(below);
  return pressed ? set_to({}) : PropertyChange{};
}

PropertyChange draw_action(const Property& row, const std::string& unavailable) {
  ButtonStyle style;
  style.width_px = ImGui::GetContentRegionAvail().x;
  style.tip = {row.help, {}, unavailable};
  PropertyChange change;
  change.pressed = button(row.label, style);
  return change;
}

}  // namespace

PropertyChange PropertyFields::draw(const Property& row, const std::string& unavailable) {
  switch (row.kind) {
    case Property::Kind::number:
    case Property::Kind::integer:
      return row.value.is_null() && !row.mixed ? draw_unset(row) : draw_number(row);
    case Property::Kind::text:
      return draw_text(row);
    case Property::Kind::flag:
      return draw_flag(row);
    case Property::Kind::choice:
      return draw_choice(row);
    case Property::Kind::colour:
      return draw_colour(row);
    case Property::Kind::shown:
      return draw_shown(row);
    case Property::Kind::action:
      return draw_action(row, unavailable);
  }
  return {};
}

PropertyChange PropertyFields::draw_unset(const Property& row) {
  ButtonStyle style;
  style.width_px = begin_field(row);
  style.tip = tip_of(row);
  return named_button(row.id, "not set", style) ? set_to(row.fresh) : PropertyChange{};
}

PropertyChange PropertyFields::draw_number(const Property& row) {
  NumberStyle style;
  style.width_px = begin_field(row, row.removable ? remove_width() : 0.0f);
  style.unit = row.unit;
  style.digits = row.digits;
  style.step = row.step;
  style.least = row.least;
  style.most = row.most;
  style.mixed = row.mixed;
  style.tip = {{}, {}, row.unavailable};
  double value = row.value.number() ? *row.value.number() : 0.0;
  const NumberChange changed = number_field(row.id, value, style);
  PropertyChange change;
  change.changed = changed.changed;
  change.value = Value(value);
  change.moving = changed.changed && !changed.finished;
  change.let_go = changed.finished && !changed.changed;
  if (row.removable && remove_button(row)) return set_to({});
  return change;
}

PropertyChange PropertyFields::draw_text(const Property& row) {
  FieldStyle style;
  style.width_px = begin_field(row);
  style.select_all = true;
  style.mixed = row.mixed;
  style.tip = {{}, {}, row.unavailable};
  const std::string now = row.mixed || !row.value.text() ? std::string() : *row.value.text();
  std::string text = typing_id_ == row.id ? typed_ : now;
  const TextChange typed = text_field(row.id, text, style);
  const bool left = ImGui::IsItemDeactivated();
  if (typed.changed) {
    typing_id_ = row.id;
    typed_ = text;
  }
  if (!left && !typed.finished) return {};
  const bool was_typed = typing_id_ == row.id;
  typing_id_.clear();
  return was_typed && typed.finished && text != now ? set_to(Value(text)) : PropertyChange{};
}

PropertyChange PropertyFields::draw_choice(const Property& row) {
  FieldStyle style;
  style.width_px = begin_field(row);
  style.mixed = row.mixed;
  style.tip = {{}, {}, row.unavailable};
  std::vector<std::string> labels;
  int index = -1;
  for (const PropertyChoice& choice : row.choices) {
    if (choice.value == row.value) index = static_cast<int>(labels.size());
    labels.push_back(choice.label);
  }
  if (row.mixed) index = -1;
  if (!combo(row.id, index, labels, style)) return {};
  return set_to(row.choices[static_cast<std::size_t>(index)].value);
}

PropertyChange PropertyFields::draw_flag(const Property& row) {
  FieldStyle style;
  style.width_px = begin_field(row);
  style.mixed = row.mixed;
  style.tip = {{}, {}, row.unavailable};
  bool on = row.value.boolean() && *row.value.boolean();
  // Of several that differ the first press switches all on.
  if (!check(row.id, on, style)) return {};
  return set_to(Value(row.mixed || on));
}

PropertyChange PropertyFields::draw_colour(const Property& row) {
  const float width = begin_field(row);
  const glm::vec2 min = from_im(ImGui::GetCursorScreenPos());
  const glm::vec2 size(width, ImGui::GetFrameHeight());
  const glm::dvec3 color = rgb_of(row.value);
  const std::string popup = "colour/" + row.id;
  ImGui::PushID(row.id.c_str());
  const bool pressed = ImGui::InvisibleButton("swatch", to_im(size)) && row.unavailable.empty();
  ImGui::PopID();
  see_last_item(row.id, row.unavailable.empty());
  tip_for_last_item({{}, {}, row.unavailable});
  if (pressed) ImGui::OpenPopup(popup.c_str());
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const glm::vec2 swatch(px(34), size.y);
  list.AddRectFilled(to_im(min), to_im(min + size), ImGui::IsItemHovered() ? theme::field_hovered : theme::field,
                     px(4));
  if (!row.mixed) {
    list.AddRectFilled(to_im(min + glm::vec2(px(4))), to_im(min + swatch - glm::vec2(0.0f, px(4))),
                       packed(srgb_from_linear(color)), px(3));
  }
  const std::string text = row.mixed ? "—" : colour_text(color);
  list.AddText({min.x + swatch.x + px(8), min.y + ImGui::GetStyle().FramePadding.y}, theme::text, text.c_str());
  // Left of the panel, so that the swatch stays in sight; as far up as the window's end asks for.
  const float lowest = std::max(ImGui::GetIO().DisplaySize.y - px(picker_height), px(4));
  ImGui::SetNextWindowPos({std::max(ImGui::GetWindowPos().x - px(picker_width + 26), px(4)), std::min(min.y, lowest)});
  if (!ImGui::BeginPopup(popup.c_str(), ImGuiWindowFlags_NoMove)) return {};
  const NameScope scope(row.id);
  PropertyChange change = draw_picker(row);
  ImGui::EndPopup();
  return change;
}

/// The picker and, below it, the colour as people write it.
PropertyChange PropertyFields::draw_picker(const Property& row) {
  // The picker keeps its own hue while the project's colour is gray.
  const glm::dvec3 now = rgb_of(row.value);
  const glm::dvec3 coded = srgb_from_linear(now);
  float channels[3] = {static_cast<float>(coded.r), static_cast<float>(coded.g), static_cast<float>(coded.b)};
  ImGui::SetNextItemWidth(px(picker_width));
  PropertyChange change;
  if (ImGui::ColorPicker3("##picker", channels,
                          ImGuiColorEditFlags_NoInputs | ImGuiColorEditFlags_NoSidePreview |
                              ImGuiColorEditFlags_NoLabel | ImGuiColorEditFlags_NoOptions)) {
    change = set_to(value_of_rgb(linear_from_srgb({channels[0], channels[1], channels[2]})));
    change.moving = true;
  }
  see_last_item("picker");
  const std::string id = row.id + "/code";
  std::string text = typing_id_ == id ? typed_ : colour_text(now);
  FieldStyle style;
  style.width_px = px(picker_width);
  style.select_all = true;
  const TextChange typed = text_field("code", text, style);
  if (typed.changed) {
    typing_id_ = id;
    typed_ = text;
  }
  if (!typed.finished) return change;
  typing_id_.clear();
  if (const auto written = typed_colour(text)) return set_to(value_of_rgb(*written));
  return change;
}

}  // namespace focalstage
