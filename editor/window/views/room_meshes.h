#pragma once

#include <condition_variable>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <thread>
#include <utility>
#include <vector>

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include "core/mesh/mesh.h"
#include "core/stage/stage.h"
#include "editor/tools/slice_tint.h"

namespace focalstage {

/// The mesh as VTK has it: triangles, and normals and texture coordinates where it has them.
vtkSmartPointer<vtkPolyData> poly_data_of(const Mesh& mesh);

/// The same geometry, shared, with colours of its own per vertex.
vtkSmartPointer<vtkPolyData> coloured(vtkPolyData& shared, std::span<const Rgb> colours);

/// About ten triangles for each square of `divisions`; the shape as seen from a distance. Without texture coordinates.
std::shared_ptr<const Mesh> coarse_mesh(const Mesh& mesh, int divisions);

/// Makes stand-ins for large meshes behind the window, one after the other.
class CoarseMaker {
 public:
  CoarseMaker();
  ~CoarseMaker();

  /// The stand-in, or null: it is being made.
  std::shared_ptr<const Mesh> of(const std::shared_ptr<const Mesh>& mesh, int divisions);

  /// Whether one was finished since the last `take_news`.
  bool has_news() const;
  bool take_news();
  bool busy() const;

 private:
  using Key = std::pair<std::shared_ptr<const Mesh>, int>;

  void work(std::stop_token stop);

  mutable std::mutex mutex_;
  std::condition_variable_any wake_;
  std::deque<Key> waiting_;
  std::map<Key, std::shared_ptr<const Mesh>> made_;  ///< null: asked for
  bool working_ = false;
  bool news_ = false;
  std::jthread thread_;  ///< last: it ends first
};

/// What is drawn of a stage so that no frame takes long: the meshes themselves, or stand-ins where they are too large
/// or too many. Triangles are what a frame costs.
class RoomMeshes {
 public:
  /// Decides for a whole stage; before `shown`.
  void budget_for(const Stage& stage);

  /// The drawable with the mesh that is drawn for it; its mesh is null while a stand-in is being made.
  Drawable shown(const Drawable& drawable);

  struct Entry {
    std::shared_ptr<const Mesh> mesh;  ///< held, so that no address comes twice
    vtkSmartPointer<vtkPolyData> poly;
    bool closed = false;  ///< its back is never seen
  };
  Entry& of(const std::shared_ptr<const Mesh>& mesh);

  bool has_news() const { return coarse_.has_news(); }
  bool take_news() { return coarse_.take_news(); }
  bool busy() const { return coarse_.busy(); }

  /// Forgets meshes that nothing has used since the last call.
  void forget_unused();

 private:
  struct Kept {
    Entry entry;
    bool used = true;
  };
  std::map<const Mesh*, Kept> meshes_;
  CoarseMaker coarse_;
  int crowd_divisions_ = 0;  ///< 0: no crowd
};

}  // namespace focalstage
