#include "editor/window/views/room_meshes.h"

#include <chrono>
#include <cstring>
#include <utility>

#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkQuadricClustering.h>
#include <vtkTypeInt32Array.h>
#include <vtkUnsignedCharArray.h>

#include "core/mesh/measure.h"

namespace focalstage {
namespace {

constexpr std::size_t large_mesh = 200'000;     // triangles: a stand-in is worth its making
constexpr std::size_t worth_culling = 100'000;  // finding out whether larger ones are closed takes longer than it saves
constexpr int clusters = 48;

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

vtkSmartPointer<vtkPolyData> coarse_of(const Mesh& mesh) {
  vtkNew<vtkQuadricClustering> clustering;
  clustering->SetInputData(poly_data_of(mesh));
  clustering->AutoAdjustNumberOfDivisionsOff();
  clustering->SetNumberOfDivisions(clusters, clusters, clusters);
  clustering->CopyCellDataOff();
  clustering->Update();
  return clustering->GetOutput();
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

RoomMeshes::Entry& RoomMeshes::of(const std::shared_ptr<const Mesh>& mesh) {
  const auto [place, is_new] = meshes_.try_emplace(mesh.get());
  place->second.used = true;
  Entry& entry = place->second.entry;
  if (!is_new) return entry;
  entry.mesh = mesh;
  entry.full = poly_data_of(*mesh);
  const std::size_t triangles = mesh->triangles.size();
  entry.closed = triangles <= worth_culling && is_closed(*mesh) && enclosed_volume_m3(*mesh) > 0.0;
  if (triangles > large_mesh) {
    entry.making = std::async(std::launch::async, [mesh] { return coarse_of(*mesh); });
  }
  return entry;
}

bool RoomMeshes::take_ready() {
  bool any = false;
  for (auto& [address, kept] : meshes_) {
    std::future<vtkSmartPointer<vtkPolyData>>& making = kept.entry.making;
    if (!making.valid() || making.wait_for(std::chrono::seconds(0)) != std::future_status::ready) continue;
    kept.entry.coarse = making.get();
    any = true;
  }
  return any;
}

void RoomMeshes::forget_unused() {
  std::erase_if(meshes_, [](const auto& item) {
    return !item.second.used && !item.second.entry.making.valid();  // never waits for one that is being made
  });
  for (auto& [address, kept] : meshes_) kept.used = false;
}

}  // namespace focalstage
