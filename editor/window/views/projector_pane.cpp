#include "editor/window/views/projector_pane.h"

#include <algorithm>
#include <cmath>

#include "core/base/number_words.h"
#include "core/optics/image_plan.h"
#include "editor/preview/false_colour.h"
#include "editor/session/session.h"
#include "editor/tools/slice_tint.h"
#include "editor/window/base/chips.h"
#include "editor/window/base/im.h"
#include "editor/window/base/widgets.h"
#include "editor/window/views/pane_text.h"

namespace focalstage {
namespace {

constexpr double most_zoom = 64.0;

/// The image that the view state asks for, or the first of the side where it asks for one that is not there.
std::size_t image_of(const CompiledSlices& slices, const ViewState& view) {
  const auto& images = slices.settings.images;
  const auto asked = static_cast<std::size_t>(std::max(view.image, 0));
  if (asked < images.size()) return asked;
  return 0;
}

std::vector<glm::dvec3> colours_of(const CompiledSlices& slices) {
  const auto& powers_d = slices.project->slices.powers_d;
  std::vector<glm::dvec3> colours;
  for (std::size_t i = 0; i < powers_d.size(); ++i) colours.push_back(slice_colour(powers_d, i));
  return colours;
}

}  // namespace

float ProjectorPane::strip_height(const PaneRect& rect) {
  const float wanted = px(74);
  return rect.size.y > 3.0f * wanted ? wanted : 0.0f;
}

ImagePlacement ProjectorPane::placement(const Session& session, glm::dvec2 area_px) const {
  const auto slices = session.slices();
  if (!slices) return {};
  const glm::ivec2 image_px(slices->images.width_px, slices->images.height_px);
  ImagePlacement placed = fitted(image_px, area_px);
  const ViewState& view = session.view();
  if (view.zoom <= 0.0) return placed;
  // Zoom and pan are kept in full-size pixels, so that a smaller preview stays where the picture was.
  placed.zoom = view.zoom * slices->divisor;
  placed.centre_px = view.pan_px / static_cast<double>(slices->divisor);
  return placed;
}

ProjectorPane::Shown ProjectorPane::wanted(const Session& session, glm::ivec2 size_px) const {
  const auto slices = session.slices();
  const ViewState& view = session.view();
  const glm::ivec2 area_px(size_px.x, size_px.y - static_cast<int>(strip_height({{}, glm::vec2(size_px)})));
  return {slices.get(),
          slices ? static_cast<int>(image_of(*slices, view)) : 0,
          view.side,
          view.picture,
          view.compensation,
          placement(session, glm::dvec2(area_px)),
          area_px};
}

bool ProjectorPane::dirty(const Session& session, glm::ivec2 size_px) const {
  return !(wanted(session, size_px) == shown_);
}

void ProjectorPane::fill(const CompiledSlices& slices, const Shown& shown) {
  const FrameImages& images = slices.images;
  const glm::ivec2 size_px(images.width_px, images.height_px);
  if (shown.picture == ProjectorPicture::assignment) {
    plane_.set(size_px, 3, assignment_picture(slices, shown.side, colours_of(slices)));
    return;
  }
  const auto image = static_cast<std::size_t>(shown.image);
  if (image >= images.count) {
    plane_.clear();
    return;
  }
  const bool compared = shown.compensation != ShownBreathing::on && image < slices.uncompensated.count;
  if (compared && shown.compensation == ShownBreathing::difference) {
    plane_.set(size_px, 3, difference_picture(images.image(image), slices.uncompensated.image(image), images.channels));
  } else {
    plane_.set(size_px, images.channels, compared ? slices.uncompensated.image(image) : images.image(image));
  }
}

void ProjectorPane::render(const Session& session, glm::ivec2 size_px, double scale) {
  const Shown now = wanted(session, size_px);
  const bool same_codes = now.slices == shown_.slices && now.image == shown_.image && now.side == shown_.side &&
                          now.picture == shown_.picture && now.compensation == shown_.compensation;
  held_ = session.slices();
  shown_ = now;
  if (!held_) {
    plane_.clear();
  } else if (!same_codes) {
    fill(*held_, now);
  }
  plane_.render(now.size_px, now.placement, scale);
}

void ProjectorPane::draw(Session& session, const PaneRect& rect) {
  const float strip = strip_height(rect);
  const PaneRect area{rect.min, {rect.size.x, rect.size.y - strip}};
  draw_picture(plane_.picture(), area.min, area.size);
  const Project& project = session.project();
  if (project.surfaces.empty() || project.objects.empty() || !session.slices()) {
    draw_hint(rect, project.surfaces.empty()  ? "Add a surface: the projector's images fall on it."
                    : project.objects.empty() ? "Add an object: each slice shows its part of it."
                                              : "The images appear once they are compiled.");
    return;
  }
  answer_mouse(session, area);
  draw_reading(session);
  draw_chips(session, area);
  if (strip > 0.0f) draw_strip(session, {{rect.min.x, rect.min.y + area.size.y}, {rect.size.x, strip}});
}

void ProjectorPane::draw_chips(Session& session, const PaneRect& area) {
  const auto slices = session.slices();
  ViewState& view = session.view();
  Chips top(area, Chips::Corner::top_right);
  ButtonStyle assignment;
  assignment.icon = "assignment";
  assignment.down = view.picture == ProjectorPicture::assignment;
  assignment.tip = {"Which slice lights each pixel, in false colours", "A", {}};
  if (top.button("assignment", "Assignment", assignment)) (void)session.run("projector.assignment");
  ButtonStyle compensation;
  compensation.icon = "compare";
  compensation.down = view.compensation != ShownBreathing::on;
  compensation.tip = {"Breathing compensation: on, off, and what it changes", "B", {}};
  const char* words = view.compensation == ShownBreathing::on    ? "Compensated"
                      : view.compensation == ShownBreathing::off ? "Not compensated"
                                                                 : "Difference";
  if (top.button("compensation", words, compensation)) (void)session.run("projector.compensation");
  Chips bottom(area, Chips::Corner::bottom_left);
  const ImageSpec& spec = slices->settings.images[image_of(*slices, view)];
  if (view.picture == ProjectorPicture::slice) bottom.label("", image_words(spec));
  if (slices->divisor > 1) bottom.label("", slices->divisor == 2 ? "half size" : "quarter size");
  if (view.zoom > 0.0) {
    ButtonStyle fit;
    fit.icon = "fill";
    fit.tip = {"The whole image again", {}, {}};
    if (bottom.button("fit", fixed_text(view.zoom, 1) + "x", fit)) view.zoom = 0.0;
  }
}

void ProjectorPane::answer_mouse(Session& session, const PaneRect& area) {
  ImGui::SetCursorScreenPos(to_im(area.min));
  ImGui::InvisibleButton(
      "image", to_im(area.size),
      ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonMiddle | ImGuiButtonFlags_MouseButtonRight);
  ImGui::SetItemAllowOverlap();
  see_last_item("image");
  const auto slices = session.slices();
  ViewState& view = session.view();
  const ImGuiIO& io = ImGui::GetIO();
  const glm::dvec2 area_px(area.size), at(from_im(io.MousePos) - area.min);
  const ImagePlacement placed = placement(session, area_px);
  const glm::dvec2 pixel = image_from_pane(placed, area_px, at);
  const double divisor = slices->divisor;
  if (ImGui::IsItemHovered()) {
    session.read_pixel(view.side, glm::ivec2(glm::floor(pixel)));
    if (io.MouseWheel != 0.0f) {
      const double zoom = std::clamp(placed.zoom * std::pow(1.25, io.MouseWheel), 0.05, most_zoom);
      // What is under the pointer stays there.
      view.pan_px = (pixel - (at - 0.5 * area_px) / zoom) * divisor;
      view.zoom = zoom / divisor;
    }
    if (ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) view.zoom = 0.0;
  }
  if (ImGui::IsItemActive() && (io.MouseDelta.x != 0.0f || io.MouseDelta.y != 0.0f) && !ImGui::IsItemActivated()) {
    view.zoom = placed.zoom / divisor;
    view.pan_px = (placed.centre_px - glm::dvec2(from_im(io.MouseDelta)) / placed.zoom) * divisor;
  }
}

void ProjectorPane::draw_reading(const Session& session) {
  if (!ImGui::IsItemHovered() || ImGui::IsItemActive()) return;
  const auto reading = session.pixel_reading();
  if (!reading) return;
  const PaneTooltip tooltip;
  text_line(pixel_words(reading->pixel));
  if (reading->surface.empty()) {
    text_line("falls on no surface", theme::dim);
  } else {
    text_line(point_words(*reading), theme::dim);
    if (!reading->seen) text_line("another surface hides it from this eye", theme::dim);
    for (const SliceReading& slice : reading->slices) {
      text_line(slice_words(slice), slice.code > 0 ? theme::text : theme::faint);
    }
  }
}

void ProjectorPane::draw_strip(Session& session, const PaneRect& rect) {
  const auto slices = session.slices();
  const auto checked = session.checked();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(to_im(rect.min), to_im(rect.min + rect.size), theme::bar);
  if (!checked || checked->schedule.schedule.slots.empty()) return;
  const auto& slots = checked->schedule.schedule.slots;
  if (thumbnails_of_ != slices.get()) {
    thumbnails_of_ = slices.get();
    thumbnails_.resize(slices->images.count);
    for (std::size_t i = 0; i < thumbnails_.size(); ++i) {
      if (!thumbnails_[i]) thumbnails_[i] = std::make_unique<CodesTexture>();
      const Thumbnail small = thumbnail_of(slices->images, i);
      thumbnails_[i]->set(small.size_px, 3, small.rgb);
    }
  }
  const float gap = px(4), label = px(16), height = rect.size.y - 2.0f * gap - label;
  const float aspect = static_cast<float>(slices->images.width_px) / static_cast<float>(slices->images.height_px);
  const float width = std::min(height * aspect, (rect.size.x - gap) / static_cast<float>(slots.size()) - gap);
  if (width < px(8)) return;
  float x = rect.min.x + 0.5f * (rect.size.x - static_cast<float>(slots.size()) * (width + gap) + gap);
  for (std::size_t s = 0; s < slots.size(); ++s, x += width + gap) {
    const auto image = static_cast<std::size_t>(std::max(slots[s].image, 0));
    if (image >= thumbnails_.size() || image >= slices->settings.images.size()) continue;
    const glm::vec2 min(x, rect.min.y + gap), size(width, width / aspect);
    draw_picture(thumbnails_[image]->picture(), min, size);
    ImGui::SetCursorScreenPos(to_im(min));
    const std::string name = "slot " + std::to_string(s);
    if (ImGui::InvisibleButton(name.c_str(), to_im(size + glm::vec2(0.0f, label)))) {
      session.view().image = static_cast<int>(image);
      session.view().side = slots[s].eye;
      session.view().picture = ProjectorPicture::slice;
    }
    see_last_item(name);
    tip_for_last_item({slot_words(slots[s]), {}, {}});
    const bool chosen = session.view().picture == ProjectorPicture::slice &&
                        image == image_of(*slices, session.view()) && slots[s].eye == session.view().side;
    const std::uint32_t frame = chosen ? theme::accent : ImGui::IsItemHovered() ? theme::dim : theme::line;
    list.AddRect(to_im(min), to_im(min + size), frame, 0.0f, 0, px(chosen ? 2 : 1));
    const std::string words = slot_label(slots[s]);
    if (small_text_size(words).x > width) continue;  // half a number says nothing; the tooltip has it
    small_text(list, {min.x, min.y + size.y + px(2)}, words, chosen ? theme::text : theme::dim);
  }
}

void ProjectorPane::finalize() {
  plane_.finalize();
  thumbnails_.clear();
}

}  // namespace focalstage
