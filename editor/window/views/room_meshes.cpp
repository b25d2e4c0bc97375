#include "editor/window/views/room_meshes.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyDataNormals.h>
#include <vtkQuadricClustering.h>
#include <vtkTypeInt32Array.h>
#include <vtkUnsignedCharArray.h>

#include "core/mesh/measure.h"

namespace focalstage {
namespace {

constexpr std::size_t large_mesh = 250'000;     // triangles of one mesh that are drawn as they are, at most
constexpr std::size_t large_stage = 400'000;    // of all together
constexpr std::size_t crowd_budget = 250'000;   // what a larger stage is brought down to, about
constexpr std::size_t light_mesh = 2'000;       // never worth a stand-in
constexpr std::size_t worth_culling = 100'000;  // finding out whether larger ones are closed takes longer than it saves
constexpr int finest_divisions = 96;
constexpr std::size_t triangles_per_square = 10;

template <int Size, class Vectors>
vtkSmartPointer<vtkFloatArray> float_array(const char* name, const Vectors& vectors) {
  vtkNew<vtkFloatArray> array;
  array->SetName(name);
  array->SetNumberOfComponents(Size);
  array->SetNumberOfTuples(static_cast<vtkIdType>(vectors.size()));
  float* to = array->GetPointer(0);
  for (const auto& vector : vectors) {
    for (int i = 0; i < Size; ++i) *to++ = static_cast<float>(vector[i]);
  }
  return array;
}

std::size_t triangles_of_divisions(int divisions) {
  return triangles_per_square * static_cast<std::size_t>(divisions) * static_cast<std::size_t>(divisions);
}

}  // namespace

vtkSmartPointer<vtkPolyData> poly_data_of(const Mesh& mesh) {
  vtkNew<vtkPoints> points;
  points->SetData(float_array<3>("points", mesh.positions_m));
  vtkNew<vtkTypeInt32Array> corners;
  corners->SetNumberOfValues(static_cast<vtkIdType>(3 * mesh.triangles.size()));
  if (!mesh.triangles.empty()) {
    std::memcpy(corners->GetPointer(0), mesh.triangles.data(), mesh.triangles.size() * sizeof(glm::uvec3));
  }
  vtkNew<vtkCellArray> cells;
  cells->SetData(3, corners);
  auto poly = vtkSmartPointer<vtkPolyData>::New();
  poly->SetPoints(points);
  poly->SetPolys(cells);
  if (!mesh.normals.empty()) poly->GetPointData()->SetNormals(float_array<3>("normals", mesh.normals));
  if (!mesh.uvs.empty()) poly->GetPointData()->SetTCoords(float_array<2>("uvs", mesh.uvs));
  return poly;
}

vtkSmartPointer<vtkPolyData> coloured(vtkPolyData& shared, std::span<const Rgb> colours) {
  auto own = vtkSmartPointer<vtkPolyData>::New();
  own->ShallowCopy(&shared);
  vtkNew<vtkUnsignedCharArray> array;
  array->SetName("colours");
  array->SetNumberOfComponents(3);
  array->SetNumberOfTuples(static_cast<vtkIdType>(colours.size()));
  unsigned char* to = array->GetPointer(0);
  for (const Rgb& colour : colours) {
    for (int i = 0; i < 3; ++i) *to++ = colour[i];
  }
  own->GetPointData()->SetScalars(array);
  return own;
}

std::shared_ptr<const Mesh> coarse_mesh(const Mesh& mesh, int divisions) {
  vtkNew<vtkQuadricClustering> clustering;
  clustering->SetInputData(poly_data_of(mesh));
  clustering->AutoAdjustNumberOfDivisionsOff();
  clustering->SetNumberOfDivisions(divisions, divisions, divisions);
  clustering->CopyCellDataOff();
  vtkNew<vtkPolyDataNormals> normals;
  normals->SetInputConnection(clustering->GetOutputPort());
  normals->SplittingOff();
  normals->ConsistencyOff();
  normals->Update();
  vtkPolyData& made = *normals->GetOutput();
  auto coarse = std::make_shared<Mesh>();
  for (vtkIdType i = 0; i < made.GetNumberOfPoints(); ++i) {
    double p[3];
    made.GetPoint(i, p);
    coarse->positions_m.emplace_back(p[0], p[1], p[2]);
    if (made.GetPointData()->GetNormals() == nullptr) continue;
    made.GetPointData()->GetNormals()->GetTuple(i, p);
    coarse->normals.emplace_back(p[0], p[1], p[2]);
  }
  vtkNew<vtkIdList> corners;
  made.GetPolys()->InitTraversal();
  while (made.GetPolys()->GetNextCell(corners) != 0) {
    if (corners->GetNumberOfIds() != 3) continue;
    const auto corner = [&](vtkIdType i) { return static_cast<std::uint32_t>(corners->GetId(i)); };
    coarse->triangles.emplace_back(corner(0), corner(1), corner(2));
  }
  return coarse;
}

CoarseMaker::CoarseMaker() : thread_([this](std::stop_token stop) { work(stop); }) {}

CoarseMaker::~CoarseMaker() = default;

void CoarseMaker::work(std::stop_token stop) {
  while (true) {
    Key key;
    {
      std::unique_lock lock(mutex_);
      working_ = false;
      if (!wake_.wait(lock, stop, [&] { return !waiting_.empty(); })) return;
      key = waiting_.front();
      waiting_.pop_front();
      working_ = true;
    }
    std::shared_ptr<const Mesh> coarse = coarse_mesh(*key.first, key.second);
    const std::lock_guard lock(mutex_);
    made_[key] = std::move(coarse);
    news_ = true;
  }
}

std::shared_ptr<const Mesh> CoarseMaker::of(const std::shared_ptr<const Mesh>& mesh, int divisions) {
  const std::lock_guard lock(mutex_);
  // Whoever else held a mesh let go of it: nobody asks for its stand-in any more.
  std::erase_if(made_, [&](const auto& item) {
    return item.second != nullptr && item.first.first != mesh && item.first.first.use_count() == 1;
  });
  const auto [place, is_new] = made_.try_emplace({mesh, divisions}, nullptr);
  if (is_new) {
    waiting_.emplace_back(mesh, divisions);
    wake_.notify_one();
  }
  return place->second;
}

bool CoarseMaker::has_news() const {
  const std::lock_guard lock(mutex_);
  return news_;
}

bool CoarseMaker::take_news() {
  const std::lock_guard lock(mutex_);
  return std::exchange(news_, false);
}

bool CoarseMaker::busy() const {
  const std::lock_guard lock(mutex_);
  return working_ || !waiting_.empty();
}

void RoomMeshes::budget_for(const Stage& stage) {
  std::size_t all = 0;
  std::size_t heavy = 0;
  for (const StagedObject& object : stage.objects) {
    for (const Drawable& drawable : object.drawables) {
      all += std::min(drawable.mesh->triangles.size(), triangles_of_divisions(finest_divisions));
      heavy += drawable.mesh->triangles.size() > light_mesh ? 1 : 0;
    }
  }
  crowd_divisions_ = 0;
  if (all <= large_stage || heavy == 0) return;
  crowd_divisions_ = 12;
  for (const int divisions : {20, 32, 48, 64, finest_divisions}) {
    if (triangles_of_divisions(divisions) * heavy <= crowd_budget) crowd_divisions_ = divisions;
  }
}

Drawable RoomMeshes::shown(const Drawable& drawable) {
  const std::size_t triangles = drawable.mesh->triangles.size();
  int divisions = triangles > large_mesh ? finest_divisions : 0;
  if (crowd_divisions_ > 0 && triangles > light_mesh && triangles > 2 * triangles_of_divisions(crowd_divisions_)) {
    divisions = crowd_divisions_;
  }
  if (divisions == 0) return drawable;
  Drawable coarse = drawable;
  coarse.mesh = coarse_.of(drawable.mesh, divisions);
  return coarse;
}

RoomMeshes::Entry& RoomMeshes::of(const std::shared_ptr<const Mesh>& mesh) {
  const auto [place, is_new] = meshes_.try_emplace(mesh.get());
  place->second.used = true;
  Entry& entry = place->second.entry;
  if (!is_new) return entry;
  entry.mesh = mesh;
  entry.poly = poly_data_of(*mesh);
  entry.closed = mesh->triangles.size() <= worth_culling && is_closed(*mesh) && enclosed_volume_m3(*mesh) > 0.0;
  return entry;
}

void RoomMeshes::forget_unused() {
  std::erase_if(meshes_, [](const auto& item) { return !item.second.used; });
  for (auto& [address, kept] : meshes_) kept.used = false;
}

}  // namespace focalstage
