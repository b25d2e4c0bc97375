#include "editor/window/views/room_hands.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <imgui.h>

#include <glm/geometric.hpp>

#include "core/base/number_words.h"
#include "editor/tools/pose_edits.h"

namespace focalstage {
namespace {

constexpr double knob_reach_px = 9.0;

bool locked(const Project& project, const StagedName& thing) {
  if (thing.list == "objects") {
    const Object* object = object_named(project, thing.name);
    return object != nullptr && object->locked;
  }
  if (thing.list == "surfaces") {
    const Surface* surface = surface_named(project, thing.name);
    return surface != nullptr && surface->locked;
  }
  return false;
}

MayPick unlocked_of(const Project& project) {
  return [&project](const StagedName& thing) { return !locked(project, thing); };
}

const StagedObject* staged_object(const Stage& stage, const std::string& name) {
  for (const StagedObject& object : stage.objects) {
    if (object.name == name) return &object;
  }
  return nullptr;
}

double distance_to_edge(const glm::dvec2& p, const glm::dvec2& a, const glm::dvec2& b) {
  const glm::dvec2 ab = b - a;
  const double squared = glm::dot(ab, ab);
  const double share = squared > 0.0 ? std::clamp(glm::dot(p - a, ab) / squared, 0.0, 1.0) : 0.0;
  return glm::length(p - (a + share * ab));
}

}  // namespace

std::optional<glm::dvec2> RoomHands::sheet_knob_px(const RoomFrame& frame, const DepthSheet& sheet) {
  const auto left = pixel_of(frame.view, sheet.corners_m[3]);
  const auto right = pixel_of(frame.view, sheet.corners_m[2]);
  if (!left || !right) return std::nullopt;
  return 0.5 * (*left + *right) - glm::dvec2(0.0, 20.0 * frame.scale);
}

std::optional<PickHit> RoomHands::pick(RoomFrame& frame, const glm::dvec2& pixel) const {
  const LookThrough through = frame.session.view().look_through;
  const Project& project = frame.session.project();
  const MayPick may = [&](const StagedName& thing) {
    const bool is_beholder = (thing.list == "viewer" && through != LookThrough::nothing) ||
                             (thing.list == "projectors" && through == LookThrough::projector);
    return !is_beholder && !locked(project, thing);
  };
  return first_with_fixtures(frame.scene.picker(), frame.stage(), frame.fixtures(), ray_through(frame.view, pixel),
                             may);
}

void RoomHands::see_things(RoomFrame& frame) {
  things.clear();
  handles.clear();
  const Project& project = frame.session.project();
  for (const Thing& thing : frame.session.selection().things) {
    if (locked(project, {thing.list, thing.name})) continue;
    if (auto handled = handle_thing(project, thing.list, thing.name, frame.time_s())) things.push_back(*handled);
  }
  if (things.empty()) return;
  const ViewState& state = frame.session.view();
  handle_frame = focalstage::handle_frame(state.space, things, frame.stage().world_from_viewer);
  handles = handle_shapes(state.tool, handle_frame, frame.view, frame.scale);
}

void RoomHands::see_depth(RoomFrame& frame) {
  const Thing* primary = frame.session.selection().primary();
  const StagedObject* object =
      primary != nullptr && primary->list == "objects" ? staged_object(frame.stage(), primary->name) : nullptr;
  if (object == nullptr || locked(frame.session.project(), {"objects", object->name})) {
    depth.reset();
    depth_stage_.reset();
    return;
  }
  if (depth && depth->object == object->name && depth_stage_ == frame.session.stage()) return;
  depth_stage_ = frame.session.stage();
  depth.reset();
  const auto reading = read_depth(frame.session.project(), frame.stage(), *object, frame.scene.picker());
  if (!reading) return;
  depth = RoomDepth{object->name, *reading, depth_sheet(frame.sight(), *object, reading->accommodation_d)};
}

void RoomHands::see_hot(RoomFrame& frame, const glm::dvec2& pixel) {
  hot_handle.reset();
  hot_thing.reset();
  hot_sheet = false;
  const DepthSheet* sheet = depth && depth->sheet && frame.has_camera() ? &*depth->sheet : nullptr;
  // The knob before the handles: it is small, and where an object is, its handles are all around.
  if (sheet != nullptr) {
    const auto knob = sheet_knob_px(frame, *sheet);
    hot_sheet = knob && glm::length(pixel - *knob) <= knob_reach_px * frame.scale;
    if (hot_sheet) return;
  }
  hot_handle = handle_at(handles, pixel, frame.scale);
  if (hot_handle) return;
  for (std::size_t i = 0; i < 4 && sheet != nullptr && !hot_sheet; ++i) {
    const auto a = pixel_of(frame.view, sheet->corners_m[i]);
    const auto b = pixel_of(frame.view, sheet->corners_m[(i + 1) % 4]);
    hot_sheet = a && b && distance_to_edge(pixel, *a, *b) <= 4.0 * frame.scale;
  }
  if (hot_sheet) return;
  if (const auto hit = pick(frame, pixel)) hot_thing = hit->thing;
}

void RoomHands::begin(RoomFrame& frame, const glm::dvec2& pixel) {
  const ImGuiIO& io = ImGui::GetIO();
  start_px_ = pixel;
  last_px_ = pixel;
  typed_.clear();
  asked_.clear();
  amount.clear();
  done_by_keys_ = false;
  made_step_ = false;
  const bool right = ImGui::IsMouseDown(ImGuiMouseButton_Right);
  if (ImGui::IsMouseDown(ImGuiMouseButton_Middle) || (right && io.KeyShift)) {
    hold_ = Hold::pan;
  } else if (right || io.KeyAlt) {
    hold_ = Hold::orbit;
  } else if (hot_handle && !things.empty()) {
    hold_handle(frame, *hot_handle, pixel);
  } else if (hot_sheet && depth && depth->sheet) {
    const StagedObject* object = staged_object(frame.stage(), depth->object);
    if (object == nullptr) return;
    hold_ = Hold::depth;
    depth_drag_ =
        start_depth_drag(*object, frame.sight(), *depth->sheet, depth->reading.accommodation_d, frame.view, pixel);
  } else {
    hold_ = Hold::press;
    pressed_on_ = hot_thing;
  }
}

void RoomHands::click(RoomFrame& frame, const glm::dvec2& pixel) {
  if (frame.session.view().tool == HandleTool::measure) {
    const auto hit = pick(frame, pixel);
    if (!hit) {
      measure_m.clear();
      measuring = false;
    } else if (measuring && measure_m.size() == 2) {
      measure_m[1] = hit->point_m;
      measuring = false;
    } else {
      measure_m = {hit->point_m};
      measuring = true;
    }
    return;
  }
  const bool add = ImGui::GetIO().KeyCtrl;
  if (!pressed_on_) {
    if (!add) frame.session.select({});
    return;
  }
  const Thing thing{pressed_on_->list, pressed_on_->name};
  if (!add) {
    frame.session.select({thing});
    return;
  }
  Selection selection = frame.session.selection();
  selection.toggle(thing);
  frame.session.select(selection.things);
}

void RoomHands::end(RoomFrame& frame, const glm::dvec2& pixel) {
  if (!done_by_keys_) {
    if (hold_ == Hold::press) click(frame, pixel);
    if (hold_ == Hold::box) {
      std::vector<Thing> found = ImGui::GetIO().KeyCtrl ? frame.session.selection().things : std::vector<Thing>{};
      for (const StagedName& name :
           inside_box(frame.stage(), frame.view, start_px_, pixel, unlocked_of(frame.session.project()))) {
        const Thing thing{name.list, name.name};
        if (std::ranges::find(found, thing) == found.end()) found.push_back(thing);
      }
      frame.session.select(std::move(found));
    }
    if (hold_ == Hold::handle || hold_ == Hold::depth) frame.session.end_drag();
  }
  hold_ = Hold::none;
  box_px.reset();
  amount.clear();
  typed_.clear();
}

/// The accommodation that sees sharply what is there: an object's wanted depth, a surface's own distance.
void RoomHands::focus_here(RoomFrame& frame, const glm::dvec2& pixel) {
  const auto hit = pick(frame, pixel);
  if (!hit) return;
  double focus_d = 0.0;
  const StagedObject* object = hit->thing.list == "objects" ? staged_object(frame.stage(), hit->thing.name) : nullptr;
  const auto reading = object != nullptr
                           ? read_depth(frame.session.project(), frame.stage(), *object, frame.scene.picker())
                           : std::nullopt;
  const double axial_m = frame.sight().axial_m(hit->point_m);
  if (reading && object->depth.mode != DepthMode::placed) {
    focus_d = reading->accommodation_d;
  } else if (axial_m > 0.0) {
    focus_d = 1.0 / axial_m;
  } else {
    return;
  }
  frame.session.view().focus_d = std::clamp(focus_d, -1.0, 10.0);
}

void RoomHands::wheel(RoomFrame& frame, const glm::dvec2& pixel) {
  const double steps = static_cast<double>(ImGui::GetIO().MouseWheel);
  if (steps == 0.0 || !frame.has_camera()) return;
  ViewState& state = frame.session.view();
  state.camera = zoomed(state.camera, frame.view.size_px, pixel, steps);
}

void RoomHands::follow(RoomFrame& frame, bool hovered, bool pressed) {
  const glm::dvec2 pixel = frame.in_view(ImGui::GetIO().MousePos);
  see_things(frame);
  see_depth(frame);
  if (frame.session.view().tool != HandleTool::measure) {
    measure_m.clear();
    measuring = false;
  }
  if (hold_ == Hold::none) {
    hot_handle.reset();
    hot_sheet = false;
    hot_thing.reset();
    if (hovered) see_hot(frame, pixel);
    if (hovered && measuring && !measure_m.empty()) {
      measure_m.resize(1);
      if (const auto hit = pick(frame, pixel)) measure_m.push_back(hit->point_m);
    }
    if (hovered) wheel(frame, pixel);
    const bool measures = frame.session.view().tool == HandleTool::measure;
    if (hovered && !measures && !hot_handle && !hot_sheet && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) {
      focus_here(frame, pixel);
    }
    if (pressed) begin(frame, pixel);
  } else if (pressed) {
    go_on(frame, pixel);
    see_things(frame);
    see_depth(frame);
  } else {
    end(frame, pixel);
    see_things(frame);
    see_depth(frame);
  }
}

}  // namespace focalstage
