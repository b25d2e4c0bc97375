#include "editor/window/app/layout.h"

#include <algorithm>
#include <cmath>

namespace focalstage {
namespace {

// Design pixels.
constexpr double bar_height = 37.0;
constexpr double gap = 3.0;
constexpr double timeline_height = 42.0;
constexpr double least_view_width = 150.0;
constexpr double least_view_height = 110.0;
constexpr double least_centre_width = 240.0;
constexpr double least_centre_height = 160.0;
constexpr double least_outline = 120.0;
constexpr double most_outline = 480.0;
constexpr double least_properties = 200.0;
constexpr double most_properties = 560.0;
constexpr double least_bottom = 70.0;
constexpr float most_bottom_share = 0.4f;

struct Measure {
  double scale;
  float operator()(double design) const { return static_cast<float>(std::round(design * scale)); }
};

struct Box {
  float left, top, right, bottom;
  PaneRect rect() const { return {{left, top}, {std::max(right - left, 1.0f), std::max(bottom - top, 1.0f)}}; }
};

void cut_bottom(Layout& layout, Box& box, const Splits& splits, bool with_timeline, const Measure& px) {
  const float room = box.bottom - box.top - px(least_centre_height);
  const float most = most_bottom_share * (box.bottom - box.top);
  const float wanted = std::max(std::min(px(splits.bottom), most), px(least_bottom));
  if (room >= px(least_bottom) + px(gap)) {
    const float top = std::round(box.bottom - std::min(wanted, room - px(gap)));
    layout.bottom = Box{box.left, top, box.right, box.bottom}.rect();
    layout.splitters.push_back({Splitter::Kind::bottom, Box{box.left, top - px(gap), box.right, top}.rect(), false});
    box.bottom = top - px(gap);
  }
  if (with_timeline && box.bottom - box.top - px(least_centre_height) >= px(timeline_height + gap)) {
    const float top = box.bottom - px(timeline_height);
    layout.timeline = Box{box.left, top, box.right, box.bottom}.rect();
    box.bottom = top - px(gap);
  }
}

void cut_sides(Layout& layout, Box& box, const Splits& splits, const Measure& px) {
  const float outline = px(std::clamp(splits.outline, least_outline, most_outline));
  const float properties = px(std::clamp(splits.properties, least_properties, most_properties));
  const float width = box.right - box.left;
  const float centre = px(least_centre_width) + px(gap);
  if (width - outline >= centre) {
    const float right = box.left + outline;
    layout.outline = Box{box.left, box.top, right, box.bottom}.rect();
    layout.splitters.push_back(
        {Splitter::Kind::outline, Box{right, box.top, right + px(gap), box.bottom}.rect(), true});
    box.left = right + px(gap);
  }
  if (box.right - box.left - properties >= centre) {
    const float left = box.right - properties;
    layout.properties = Box{left, box.top, box.right, box.bottom}.rect();
    layout.splitters.push_back(
        {Splitter::Kind::properties, Box{left - px(gap), box.top, left, box.bottom}.rect(), true});
    box.right = left - px(gap);
  }
}

/// Where a length is cut in two, each at least `least`; none where it can't be.
std::optional<float> cut_at(float low, float high, double share, float least, float gap_px) {
  if (high - low < 2.0f * least + gap_px) return std::nullopt;
  const float at = std::round(low + (high - low) * static_cast<float>(share));
  return std::clamp(at, low + least, high - least - gap_px);
}

void cut_views(Layout& layout, const Box& box, const Splits& splits, const Measure& px) {
  const float g = px(gap);
  const auto x = cut_at(box.left, box.right, splits.across, px(least_view_width), g);
  const auto y = cut_at(box.top, box.bottom, splits.down, px(least_view_height), g);
  const float right = x ? *x : box.right;
  const float bottom = y ? *y : box.bottom;
  layout.views[0] = Box{box.left, box.top, right, bottom}.rect();
  if (x) layout.views[1] = Box{*x + g, box.top, box.right, bottom}.rect();
  if (y) layout.views[2] = Box{box.left, *y + g, right, box.bottom}.rect();
  if (x && y) layout.views[3] = Box{*x + g, *y + g, box.right, box.bottom}.rect();
  if (x) layout.splitters.push_back({Splitter::Kind::across, Box{*x, box.top, *x + g, box.bottom}.rect(), true});
  if (y) layout.splitters.push_back({Splitter::Kind::down, Box{box.left, *y, box.right, *y + g}.rect(), false});
}

}  // namespace

Layout lay_out(glm::ivec2 size_px, double scale, const Splits& splits, std::optional<int> filled, bool with_timeline) {
  const Measure px{scale};
  Layout layout;
  const auto width = static_cast<float>(size_px.x);
  const auto height = static_cast<float>(size_px.y);
  layout.bar = Box{0.0f, 0.0f, width, px(bar_height)}.rect();
  Box box{0.0f, px(bar_height) + px(gap), width, height};
  cut_bottom(layout, box, splits, with_timeline, px);
  cut_sides(layout, box, splits, px);
  layout.centre = box.rect();
  if (filled && *filled >= 0 && *filled < 4) {
    layout.views[static_cast<std::size_t>(*filled)] = box.rect();
  } else {
    cut_views(layout, box, splits, px);
  }
  return layout;
}

Splits dragged(const Layout& layout, Splits splits, Splitter::Kind kind, glm::vec2 pointer_px, double scale) {
  const PaneRect& centre = layout.centre;
  const auto x = static_cast<double>(pointer_px.x);
  const auto y = static_cast<double>(pointer_px.y);
  switch (kind) {
    case Splitter::Kind::outline: {
      const double most = static_cast<double>(centre.min.x + centre.size.x) / scale - least_centre_width - gap;
      splits.outline = std::clamp(x / scale, least_outline, std::max(std::min(most, most_outline), least_outline));
      break;
    }
    case Splitter::Kind::properties: {
      const double edge = static_cast<double>(layout.properties->min.x + layout.properties->size.x);
      const double most = (edge - static_cast<double>(centre.min.x)) / scale - least_centre_width - gap;
      splits.properties =
          std::clamp((edge - x) / scale, least_properties, std::max(std::min(most, most_properties), least_properties));
      break;
    }
    case Splitter::Kind::bottom: {
      const double edge = static_cast<double>(layout.bottom->min.y + layout.bottom->size.y);
      const double most = (edge - static_cast<double>(centre.min.y)) / scale - least_centre_height - timeline_height;
      splits.bottom = std::clamp((edge - y) / scale, least_bottom, std::max(most, least_bottom));
      break;
    }
    case Splitter::Kind::across:
      splits.across =
          std::clamp((x - static_cast<double>(centre.min.x)) / static_cast<double>(centre.size.x), 0.1, 0.9);
      break;
    case Splitter::Kind::down:
      splits.down = std::clamp((y - static_cast<double>(centre.min.y)) / static_cast<double>(centre.size.y), 0.1, 0.9);
      break;
  }
  return splits;
}

}  // namespace focalstage
