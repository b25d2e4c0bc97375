// The marks of single things: names, depth, handles, measures.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "core/base/number_words.h"
#include "editor/tools/known_bounds.h"
#include "editor/tools/measure.h"
#include "editor/window/base/fonts.h"
#include "editor/window/base/theme.h"
#include "editor/window/views/room_marks.h"

namespace focalstage {
namespace {

constexpr double most_names = 24;

/// Above the highest point of a thing in the picture, by the corners of its meshes' boxes.
std::optional<glm::dvec2> above(const RoomFrame& frame, const std::vector<Drawable>& drawables) {
  glm::dvec2 low(std::numeric_limits<double>::infinity());
  glm::dvec2 high = -low;
  for (const Drawable& drawable : drawables) {
    const Bounds& own = known_bounds(drawable.mesh);
    for (unsigned i = 0; i < 8 && !own.empty(); ++i) {
      const glm::dvec3 corner{(i & 1u) != 0 ? own.max_m.x : own.min_m.x, (i & 2u) != 0 ? own.max_m.y : own.min_m.y,
                              (i & 4u) != 0 ? own.max_m.z : own.min_m.z};
      const auto pixel = pixel_of(frame.view, glm::dvec3(drawable.world_from_mesh * glm::dvec4(corner, 1.0)));
      if (!pixel) return std::nullopt;
      low = glm::min(low, *pixel);
      high = glm::max(high, *pixel);
    }
  }
  if (!(low.x <= high.x) || high.x < 0.0 || high.y < 0.0 || low.x > frame.view.size_px.x ||
      low.y > frame.view.size_px.y) {
    return std::nullopt;
  }
  const double top_px = std::max(low.y - 4.0 * frame.scale, 60.0 * frame.scale);
  return glm::dvec2(std::clamp(0.5 * (low.x + high.x), 0.0, frame.view.size_px.x), top_px);
}

std::uint32_t colour_of(Handle handle) {
  constexpr std::array<std::uint32_t, 3> axes{theme::axis_x, theme::axis_y, theme::axis_z};
  const auto axis = axis_of(handle);
  return axis ? axes[*axis] : theme::text;
}

/// Half way to white: what is under the pointer.
std::uint32_t lit(std::uint32_t colour) {
  const auto channel = [&](int shift) { return (((colour >> shift) & 0xFFu) + 255u) / 2u << shift; };
  return 0xFF000000u | channel(16) | channel(8) | channel(0);
}

}  // namespace

void draw_names(const RoomFrame& frame, const RoomHands& hands, RoomDrawing& drawing) {
  const Selection& selection = frame.session.selection();
  const auto name_it = [&](const StagedName& thing, std::uint32_t colour) {
    if (const auto pixel = above(frame, drawables_of(frame.stage(), frame.fixtures(), thing))) {
      drawing.label(*pixel, title_of({thing.list, thing.name}), colour);
    }
  };
  if (hands.busy()) return;  // names would only be in the way of the hand
  int named = 0;
  for (auto thing = selection.things.rbegin(); thing != selection.things.rend() && named < most_names; ++thing) {
    if (hands.depth && thing->list == "objects" && thing->name == hands.depth->object) continue;  // told there
    name_it({thing->list, thing->name}, theme::text);
    ++named;
  }
  if (hands.hot_thing && !selection.has({hands.hot_thing->list, hands.hot_thing->name})) {
    name_it(*hands.hot_thing, theme::text);
  }
  for (const StagedSurface& surface : frame.stage().surfaces) {
    if (selection.has({"surfaces", surface.name})) continue;
    if (hands.hot_thing == StagedName{"surfaces", surface.name}) continue;
    if (named++ < most_names) name_it({"surfaces", surface.name}, theme::dim);
  }
}

void draw_depth(const RoomFrame& frame, const RoomHands& hands, RoomDrawing& drawing) {
  if (!hands.depth || !frame.has_camera()) return;
  const RoomDepth& depth = *hands.depth;
  const std::uint32_t colour = depth.reading.tires() ? theme::red : theme::accent;
  std::optional<glm::dvec2> words_px;
  if (depth.sheet) {
    const DepthSheet& sheet = *depth.sheet;
    std::array<ImVec2, 4> corners;
    bool whole = true;
    for (std::size_t i = 0; i < 4 && whole; ++i) {
      const auto pixel = pixel_of(frame.view, sheet.corners_m[i]);
      whole = pixel.has_value();
      if (whole) corners[i] = frame.on_window(*pixel);
    }
    drawing.dashes(frame.stage().world_from_viewer.position_m, sheet.centre_m, theme::with_alpha(colour, 0.45));
    if (whole) {
      drawing.list().AddConvexPolyFilled(corners.data(), 4, theme::with_alpha(colour, hands.hot_sheet ? 0.16 : 0.08));
      drawing.list().AddPolyline(corners.data(), 4, theme::with_alpha(colour, hands.hot_sheet ? 1.0 : 0.75),
                                 ImDrawFlags_Closed, static_cast<float>(1.5 * frame.scale));
      if (const auto knob = RoomHands::sheet_knob_px(frame, sheet)) {
        const ImVec2 at = frame.on_window(*knob);
        const float r = static_cast<float>((hands.hot_sheet ? 7.0 : 6.0) * frame.scale);
        drawing.list().AddQuadFilled({at.x, at.y - r}, {at.x + r, at.y}, {at.x, at.y + r}, {at.x - r, at.y},
                                     hands.hot_sheet ? lit(colour) : colour);
        words_px = *knob - glm::dvec2(0.0, 10.0 * frame.scale);
      }
    }
  }
  const DepthReading& reading = depth.reading;
  const std::string focus = reading.accommodation_d > 1e-3
                                ? "focus " + fixed_text(reading.accommodation_d, 2) + " D, " +
                                      fixed_text(1.0 / reading.accommodation_d, 2) + " m"
                                : "focus beyond infinity";
  std::string words = hands.busy() ? focus : depth.object + "   " + focus;
  words += "   vergence " + fixed_text(reading.vergence_d, 2) + " D";
  if (std::abs(reading.conflict_d) >= 0.005) words += "   conflict " + signed_text(reading.conflict_d, 2) + " D";
  if (!words_px) {
    const auto pixel = pixel_of(frame.view, hands.handle_frame.origin_m);
    if (!pixel) return;
    words_px = *pixel - glm::dvec2(0.0, 96.0 * frame.scale);
  }
  words_px->y = std::max(words_px->y, 84.0 * frame.scale);
  drawing.label(*words_px, words, depth.reading.tires() ? theme::red : theme::text, true);
}

void draw_handles(const RoomFrame& frame, const RoomHands& hands, RoomDrawing& drawing) {
  std::vector<ImVec2> points;
  for (const HandleShape& shape : hands.handles) {
    const bool hot = hands.hot_handle == shape.handle;
    const std::uint32_t base = colour_of(shape.handle);
    const std::uint32_t colour = theme::with_alpha(hot ? lit(base) : base, hot ? 1.0 : shape.opacity);
    points.clear();
    for (const glm::dvec2& point : shape.points_px) points.push_back(frame.on_window(point));
    const int count = static_cast<int>(points.size());
    if (shape.filled) {
      // ImGui smooths the edges of faces that wind clockwise on the screen only.
      double turn = 0.0;
      for (std::size_t i = 0; i < shape.points_px.size(); ++i) {
        const glm::dvec2& a = shape.points_px[i];
        const glm::dvec2& b = shape.points_px[(i + 1) % shape.points_px.size()];
        turn += a.x * b.y - a.y * b.x;
      }
      if (turn < 0.0) std::reverse(points.begin(), points.end());
      drawing.list().AddConvexPolyFilled(points.data(), count, colour);
    } else {
      drawing.list().AddPolyline(points.data(), count, colour, shape.closed ? ImDrawFlags_Closed : 0,
                                 static_cast<float>((hot ? 3.0 : 2.25) * frame.scale));
    }
  }
  if (!hands.amount.empty() && hands.busy()) {
    const auto pixel = pixel_of(frame.view, hands.handle_frame.origin_m);
    if (pixel) drawing.label(*pixel + glm::dvec2(0.0, 34.0 * frame.scale), hands.amount, theme::text, true);
  }
}

void draw_measure(const RoomFrame& frame, const RoomHands& hands, RoomDrawing& drawing) {
  if (hands.measure_m.empty()) return;
  for (const glm::dvec3& point_m : hands.measure_m) {
    if (const auto pixel = pixel_of(frame.view, point_m)) {
      const ImVec2 at = frame.on_window(*pixel);
      drawing.list().AddCircleFilled(at, static_cast<float>(5.0 * frame.scale), theme::panel);
      drawing.list().AddCircleFilled(at, static_cast<float>(3.5 * frame.scale), theme::accent);
    }
  }
  if (hands.measure_m.size() < 2) return;
  const glm::dvec3& a_m = hands.measure_m[0];
  const glm::dvec3& b_m = hands.measure_m[1];
  drawing.line(a_m, b_m, theme::panel, 4.0);
  drawing.line(a_m, b_m, theme::accent, 2.0);
  const MeasuredGap between = measured(frame.sight(), a_m, b_m);
  std::string words = fixed_text(between.distance_m, 3) + " m";
  if (between.difference_d) words += "   " + fixed_text(std::abs(*between.difference_d), 2) + " D";
  words += "   " + fixed_text(between.angle_deg, 1) + "\u00b0";
  if (const auto pixel = pixel_of(frame.view, 0.5 * (a_m + b_m))) {
    drawing.label(*pixel - glm::dvec2(0.0, 8.0 * frame.scale), words, theme::text, true);
  }
}

}  // namespace focalstage
