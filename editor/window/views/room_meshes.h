#pragma once

#include <future>
#include <map>
#include <memory>
#include <span>
#include <vector>

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include "core/mesh/mesh.h"
#include "editor/tools/slice_tint.h"

namespace focalstage {

/// The mesh as VTK has it: triangles, and normals and texture coordinates where it has them.
vtkSmartPointer<vtkPolyData> poly_data_of(const Mesh& mesh);

/// The same geometry, shared, with colours of its own per vertex.
vtkSmartPointer<vtkPolyData> coloured(vtkPolyData& shared, std::span<const Rgb> colours);

/// VTK's meshes by the address of ours, each made once however often it stands in the room. Large ones get a coarse
/// stand-in for when the picture moves, made behind the window.
class RoomMeshes {
 public:
  struct Entry {
    std::shared_ptr<const Mesh> mesh;  ///< held, so that no address comes twice
    vtkSmartPointer<vtkPolyData> full;
    vtkSmartPointer<vtkPolyData> coarse;  ///< null: small, or not made yet
    bool closed = false;                  ///< its back is never seen
    std::future<vtkSmartPointer<vtkPolyData>> making;
  };

  Entry& of(const std::shared_ptr<const Mesh>& mesh);

  /// Takes stand-ins that are ready. True if any came.
  bool take_ready();

  /// Forgets meshes that nothing has used since the last call.
  void forget_unused();

 private:
  struct Kept {
    Entry entry;
    bool used = true;
  };
  std::map<const Mesh*, Kept> meshes_;
};

}  // namespace focalstage
