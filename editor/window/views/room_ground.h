#pragma once

#include <vector>

#include <vtkActor.h>
#include <vtkPolyData.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include "core/mesh/measure.h"
#include "editor/tools/room_view.h"
#include "editor/tools/slice_sheets.h"

namespace focalstage {

/// The floor below everything: lines every 0.1 m, brighter every metre, fading out.
struct Floor {
  double height_m = -0.3;
  glm::dvec2 low_m{-1.0, -2.0};  ///< x and z, whole metres
  glm::dvec2 high_m{1.0, 1.0};

  bool operator==(const Floor&) const = default;
};

/// Below the lowest of what stands in the room, and some way beyond all of it.
Floor floor_below(const Bounds& bounds);

class RoomFloor {
 public:
  explicit RoomFloor(vtkRenderer& renderer);
  void show(const Floor& floor);
  void set_line_width(double width_px);

 private:
  Floor shown_;
  bool any_ = false;
  vtkSmartPointer<vtkPolyData> lines_;
  vtkSmartPointer<vtkActor> actor_;
};

/// The slices' image planes as faint sheets, far ones first.
class RoomSheets {
 public:
  explicit RoomSheets(vtkRenderer& renderer);
  void show(const std::vector<SliceSheet>& sheets, const std::vector<double>& powers_d, const RoomView& view);
  void hide();
  void set_line_width(double width_px);

 private:
  vtkSmartPointer<vtkPolyData> faces_;
  vtkSmartPointer<vtkPolyData> edges_;
  vtkSmartPointer<vtkActor> face_actor_;
  vtkSmartPointer<vtkActor> edge_actor_;
};

}  // namespace focalstage
