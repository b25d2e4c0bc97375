#include "editor/window/views/room_marks.h"

#include <array>
#include <cmath>
#include <string>

#include <glm/geometric.hpp>

#include "core/base/number_words.h"
#include "core/optics/eye.h"
#include "core/optics/projector_model.h"
#include "editor/tools/slice_tint.h"
#include "editor/window/base/fonts.h"
#include "editor/window/base/theme.h"

namespace focalstage {
namespace {

constexpr std::uint32_t ray_colour = theme::colour(0xD8C08A);  ///< light on its way; not the amber of findings
constexpr double gaze_without_surface_m = 0.6;
constexpr double ray_without_surface_m = 1.0;

std::uint32_t packed(const glm::dvec3& rgb, double alpha = 1.0) {
  const auto byte = [](double c) { return static_cast<std::uint32_t>(255.0 * std::min(std::max(c, 0.0), 1.0) + 0.5); };
  return (byte(alpha) << 24) | (byte(rgb.b) << 16) | (byte(rgb.g) << 8) | byte(rgb.r);
}

/// "0.33 m"; far ones without decimals that nobody reads.
std::string metres(double distance_m) { return fixed_text(distance_m, distance_m < 10.0 ? 2 : 0) + " m"; }

}  // namespace

void draw_floor_marks(const RoomFrame& frame, RoomDrawing& drawing) {
  const Floor& floor = frame.scene.floor();
  const Rigid& viewer = frame.stage().world_from_viewer;
  glm::dvec3 ahead = viewer.direction({0.0, 0.0, -1.0});
  ahead.y = 0.0;
  if (glm::length(ahead) < 0.1) return;  // looks at floor or ceiling
  ahead = glm::normalize(ahead);
  for (int metre = 1; metre <= 9; ++metre) {
    glm::dvec3 at_m = viewer.position_m + static_cast<double>(metre) * ahead;
    at_m.y = floor.height_m;
    if (at_m.x < floor.low_m.x || at_m.x > floor.high_m.x || at_m.z < floor.low_m.y || at_m.z > floor.high_m.y) break;
    const glm::dvec3 way = at_m - frame.view.world_from_camera.position_m;
    const Ray sight{frame.view.world_from_camera.position_m, glm::normalize(way)};
    const auto before = frame.scene.picker().first(frame.stage(), sight);
    if (before && before->distance_m < glm::length(way)) continue;  // hidden
    const glm::dvec3 side = 0.03 * glm::cross(ahead, glm::dvec3(0.0, 1.0, 0.0));
    drawing.line(at_m - side, at_m + side, theme::with_alpha(theme::dim, 0.8), 1.5);
    if (const auto pixel = pixel_of(frame.view, at_m + 2.4 * side)) {
      drawing.words(*pixel, std::to_string(metre) + " m", theme::with_alpha(theme::dim, 0.9));
    }
  }
}

void draw_gaze(const RoomFrame& frame, RoomDrawing& drawing) {
  if (!frame.has_camera()) return;
  const PerEye<Eye> eyes = eyes_of(frame.stage().world_from_viewer, frame.stage().interpupillary_m,
                                   frame.session.project().glasses.lens_to_pupil_mm * 1e-3);
  for (const Side side : both_sides) {
    const Rigid world_from_eye = eyes[side].eye_from_world.inverse();
    const Ray gaze{world_from_eye.position_m, world_from_eye.direction({0.0, 0.0, -1.0})};
    const auto hit = frame.scene.picker().first_surface(frame.stage(), gaze);
    const double to_m = hit ? hit->distance_m : gaze_without_surface_m;
    drawing.dashes(gaze.at(0.03), gaze.at(to_m), theme::with_alpha(theme::text, 0.38));
    const auto end = hit ? pixel_of(frame.view, hit->point_m) : std::nullopt;
    if (end) {
      drawing.list().AddCircleFilled(frame.on_window(*end), static_cast<float>(2.5 * frame.scale),
                                     theme::with_alpha(theme::text, 0.6));
    }
  }
}

void draw_frusta(const RoomFrame& frame, RoomDrawing& drawing) {
  if (!frame.session.view().show_frusta || !frame.has_camera()) return;
  for (const Projector& projector : frame.session.project().projectors) {
    const ProjectorModel model = projector_model(projector);
    const double width = model.width_px;
    const double height = model.height_px;
    const std::array<glm::dvec2, 4> corners{glm::dvec2(0.0, 0.0), glm::dvec2(width, 0.0), glm::dvec2(width, height),
                                            glm::dvec2(0.0, height)};
    std::array<glm::dvec3, 4> ends_m;
    for (std::size_t i = 0; i < 4; ++i) {
      const glm::dvec2 tangent = tangent_of_pixel(model, corners[i]);
      const Ray ray{model.world_from_projector.position_m,
                    model.world_from_projector.direction(glm::normalize(glm::dvec3(tangent, -1.0)))};
      const auto hit = frame.scene.picker().first_surface(frame.stage(), ray);
      // Beside the surfaces: as far as those that the middle meets.
      const auto middle = frame.scene.picker().first_surface(
          frame.stage(), {ray.origin_m, model.world_from_projector.direction({0, 0, -1})});
      const double to_m =
          hit ? hit->distance_m
              : (middle ? middle->distance_m : ray_without_surface_m) * std::sqrt(1.0 + glm::dot(tangent, tangent));
      ends_m[i] = ray.at(to_m);
      drawing.line(ray.at(0.02), ends_m[i], theme::with_alpha(ray_colour, 0.5));
    }
    for (std::size_t i = 0; i < 4; ++i) {
      drawing.line(ends_m[i], ends_m[(i + 1) % 4], theme::with_alpha(ray_colour, 0.28));
    }
  }
}

void draw_picture_edge(const RoomFrame& frame, RoomDrawing& drawing) {
  const std::vector<Projector>& projectors = frame.session.project().projectors;
  if (frame.session.view().look_through != LookThrough::projector || projectors.empty()) return;
  const Projector& projector = projectors.front();
  const glm::dvec2 size(projector.width_px, projector.height_px);
  const double zoom = std::min(frame.view.size_px.x / size.x, frame.view.size_px.y / size.y);
  const glm::dvec2 low = 0.5 * (frame.view.size_px - zoom * size);
  drawing.list().AddRect(frame.on_window(low), frame.on_window(low + zoom * size), theme::with_alpha(ray_colour, 0.8),
                         0.0f, 0, static_cast<float>(1.5 * frame.scale));
}

void draw_sheet_labels(const RoomFrame& frame, RoomDrawing& drawing) {
  if (!frame.session.view().show_sheets || !frame.has_camera()) return;
  const std::vector<double>& powers_d = frame.session.project().slices.powers_d;
  for (const SliceSheet& sheet : frame.scene.sheets()) {
    if (!sheet.drawn) continue;
    const auto corner = pixel_of(frame.view, sheet.corners_m[3]);
    if (!corner) continue;
    drawing.label(*corner - glm::dvec2(0.0, 2.0 * frame.scale),
                  signed_text(sheet.power_d, 2) + " D  " + metres(1.0 / sheet.vergence_d),
                  packed(glm::mix(slice_colour(powers_d, sheet.slice), glm::dvec3(0.85), 0.35)));
  }
}

void draw_slice_legend(const RoomFrame& frame, RoomDrawing& drawing) {
  const ViewState& state = frame.session.view();
  const std::vector<SliceSheet>& sheets = frame.scene.sheets();
  if ((!state.show_sheets && !state.tint_by_slice) || sheets.empty()) return;
  const std::vector<double>& powers_d = frame.session.project().slices.powers_d;
  ImGui::PushFont(small_font());
  const float line_px = ImGui::GetTextLineHeight() + px(2);
  const float column_px = ImGui::CalcTextSize("+0.00 D  ").x;
  const float width_px = px(22) + column_px + ImGui::CalcTextSize("beyond infinity").x + px(8);
  const float height_px = static_cast<float>(sheets.size()) * line_px + px(10);
  const PaneRect& rect = frame.rect;
  if (height_px < 0.5f * rect.size.y && width_px < 0.6f * rect.size.x) {
    const ImVec2 min{rect.min.x + px(8), rect.min.y + rect.size.y - px(8) - height_px};
    drawing.list().AddRectFilled(min, {min.x + width_px, min.y + height_px}, theme::chip, px(4));
    float y = min.y + px(5);
    for (const SliceSheet& sheet : sheets) {
      const ImVec2 square{min.x + px(8), y + px(3)};
      drawing.list().AddRectFilled(square, {square.x + px(9), square.y + px(9)},
                                   packed(slice_colour(powers_d, sheet.slice)), px(2));
      const std::string power = signed_text(sheet.power_d, 2) + " D";
      const std::string place = sheet.vergence_d > 1e-3 ? metres(1.0 / sheet.vergence_d) : "beyond infinity";
      drawing.list().AddText({min.x + px(22), y}, theme::text, power.c_str());
      drawing.list().AddText({min.x + px(22) + column_px, y}, theme::dim, place.c_str());
      y += line_px;
    }
  }
  ImGui::PopFont();
}

void draw_first_steps(const RoomFrame& frame, RoomDrawing& drawing) {
  const Project& project = frame.session.project();
  const char* what = nullptr;
  if (project.projectors.empty()) {
    what = "Add a projector: it is what lights the room.";
  } else if (project.surfaces.empty()) {
    what = "Add a surface to project on.";
  } else if (project.objects.empty()) {
    what = "Add an object, or drop a mesh here.";
  }
  if (what == nullptr) return;
  const glm::dvec2 place(0.5 * frame.view.size_px.x, frame.view.size_px.y - 24.0 * frame.scale);
  drawing.label(place, what, theme::text, true);
}

}  // namespace focalstage
