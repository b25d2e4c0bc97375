#include "editor/window/views/room_ground.h"

#include <algorithm>
#include <cmath>

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkUnsignedCharArray.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "editor/tools/slice_tint.h"
#include "editor/window/base/theme.h"

namespace focalstage {
namespace {

constexpr double step_m = 0.1;
constexpr double most_m = 12.0;  ///< to each side: a room, not a landscape
constexpr int pieces_per_m = 4;  ///< of a line, so that it can fade

vtkSmartPointer<vtkActor> unlit_actor(vtkPolyData& poly) {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(&poly);
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->LightingOff();
  actor->PickableOff();
  return actor;
}

vtkSmartPointer<vtkUnsignedCharArray> colours(int channels) {
  auto array = vtkSmartPointer<vtkUnsignedCharArray>::New();
  array->SetName("colours");
  array->SetNumberOfComponents(channels);
  return array;
}

void add_colour(vtkUnsignedCharArray& array, const glm::dvec3& rgb, double alpha = 1.0) {
  unsigned char bytes[4];
  for (int i = 0; i < 3; ++i) bytes[i] = static_cast<unsigned char>(255.0 * std::clamp(rgb[i], 0.0, 1.0) + 0.5);
  bytes[3] = static_cast<unsigned char>(255.0 * alpha + 0.5);
  array.InsertNextTypedTuple(bytes);
}

/// Lines along one axis; colours fade with the distance from the floor's middle.
struct GridLines {
  const Floor& floor;
  vtkPoints& points;
  vtkCellArray& cells;
  vtkUnsignedCharArray& colour;

  void add(glm::dvec2 from, glm::dvec2 to, const glm::dvec3& rgb) {
    const glm::dvec3 ground = theme::rgb(theme::view);
    const glm::dvec2 middle = 0.5 * (floor.low_m + floor.high_m);
    const double reach_m = 0.62 * glm::length(floor.high_m - floor.low_m);
    const int pieces = std::max(1, static_cast<int>(std::ceil(glm::length(to - from) * pieces_per_m)));
    cells.InsertNextCell(pieces + 1);
    for (int i = 0; i <= pieces; ++i) {
      const glm::dvec2 at = glm::mix(from, to, static_cast<double>(i) / pieces);
      const double fade = std::clamp(1.5 - 1.5 * glm::length(at - middle) / reach_m, 0.0, 1.0);
      cells.InsertCellPoint(points.InsertNextPoint(at.x, floor.height_m, at.y));
      add_colour(colour, glm::mix(ground, rgb, fade));
    }
  }
};

}  // namespace

Floor floor_below(const Bounds& bounds) {
  Floor floor;
  if (bounds.empty()) return floor;
  // In steps, so that it does not creep along with a thing that is dragged.
  floor.height_m = std::floor((bounds.min_m.y - 0.02) * 10.0) / 10.0;
  const glm::dvec2 low(bounds.min_m.x, bounds.min_m.z);
  const glm::dvec2 high(bounds.max_m.x, bounds.max_m.z);
  floor.low_m = glm::clamp(glm::floor(low - 0.3), -most_m, most_m - 1.0);
  floor.high_m = glm::clamp(glm::ceil(high + 0.3), floor.low_m + 1.0, glm::dvec2(most_m));
  return floor;
}

RoomFloor::RoomFloor(vtkRenderer& renderer) : lines_(vtkSmartPointer<vtkPolyData>::New()) {
  actor_ = unlit_actor(*lines_);
  renderer.AddActor(actor_);
}

void RoomFloor::set_line_width(double width_px) { actor_->GetProperty()->SetLineWidth(static_cast<float>(width_px)); }

void RoomFloor::show(const Floor& floor) {
  if (any_ && shown_ == floor) return;
  any_ = true;
  shown_ = floor;
  const glm::dvec3 fine(0.155, 0.163, 0.178);
  const glm::dvec3 metre(0.30, 0.315, 0.345);
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> cells;
  const auto colour = colours(4);
  GridLines grid{floor, *points, *cells, *colour};
  // A large room has lines every metre only: hundreds of them would be a gray field.
  const double every_m = glm::length(floor.high_m - floor.low_m) > 9.0 ? 1.0 : step_m;
  const glm::ivec2 count = glm::ivec2(glm::round((floor.high_m - floor.low_m) / every_m));
  for (int pass = 0; pass < 2; ++pass) {  // metres over the rest
    for (int i = 0; i <= count.x; ++i) {
      const double x_m = floor.low_m.x + i * every_m;
      const bool whole = std::abs(x_m - std::round(x_m)) < 1e-6;
      if (whole == (pass == 1)) grid.add({x_m, floor.low_m.y}, {x_m, floor.high_m.y}, whole ? metre : fine);
    }
    for (int i = 0; i <= count.y; ++i) {
      const double z_m = floor.low_m.y + i * every_m;
      const bool whole = std::abs(z_m - std::round(z_m)) < 1e-6;
      if (whole == (pass == 1)) grid.add({floor.low_m.x, z_m}, {floor.high_m.x, z_m}, whole ? metre : fine);
    }
  }
  lines_->SetPoints(points);
  lines_->SetLines(cells);
  lines_->GetPointData()->SetScalars(colour);
  lines_->Modified();
}

RoomSheets::RoomSheets(vtkRenderer& renderer)
    : faces_(vtkSmartPointer<vtkPolyData>::New()), edges_(vtkSmartPointer<vtkPolyData>::New()) {
  face_actor_ = unlit_actor(*faces_);
  edge_actor_ = unlit_actor(*edges_);
  face_actor_->ForceTranslucentOn();
  edge_actor_->ForceTranslucentOn();
  renderer.AddActor(face_actor_);
  renderer.AddActor(edge_actor_);
  hide();
}

void RoomSheets::set_line_width(double width_px) {
  edge_actor_->GetProperty()->SetLineWidth(static_cast<float>(width_px));
}

void RoomSheets::hide() {
  face_actor_->VisibilityOff();
  edge_actor_->VisibilityOff();
}

void RoomSheets::show(const std::vector<SliceSheet>& sheets, const std::vector<double>& powers_d,
                      const RoomView& view) {
  std::vector<const SliceSheet*> order;
  for (const SliceSheet& sheet : sheets) {
    if (sheet.drawn) order.push_back(&sheet);
  }
  // Translucent faces are drawn in this order: the farthest from the camera first.
  const auto camera_m = view.world_from_camera.position_m;
  const auto distance_m = [&](const SliceSheet* sheet) {
    return glm::length(0.5 * (sheet->corners_m[0] + sheet->corners_m[2]) - camera_m);
  };
  std::stable_sort(order.begin(), order.end(),
                   [&](const SliceSheet* a, const SliceSheet* b) { return distance_m(a) > distance_m(b); });
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> faces;
  vtkNew<vtkCellArray> edges;
  const auto face_colours = colours(4);
  const auto edge_colours = colours(4);
  for (const SliceSheet* sheet : order) {
    vtkIdType ids[5];
    for (std::size_t i = 0; i < 4; ++i) {
      const glm::dvec3& corner = sheet->corners_m[i];
      ids[i] = points->InsertNextPoint(corner.x, corner.y, corner.z);
    }
    ids[4] = ids[0];
    faces->InsertNextCell(4, ids);
    edges->InsertNextCell(5, ids);
    const glm::dvec3 colour = slice_colour(powers_d, sheet->slice);
    add_colour(*face_colours, colour, 0.055);
    add_colour(*edge_colours, colour, 0.5);
  }
  faces_->SetPoints(points);
  faces_->SetPolys(faces);
  faces_->GetCellData()->SetScalars(face_colours);
  edges_->SetPoints(points);
  edges_->SetLines(edges);
  edges_->GetCellData()->SetScalars(edge_colours);
  faces_->Modified();
  edges_->Modified();
  face_actor_->SetVisibility(!order.empty());
  edge_actor_->SetVisibility(!order.empty());
}

}  // namespace focalstage
