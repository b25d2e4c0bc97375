#include "core/process/bits.h"

#include <algorithm>
#include <numeric>
#include <set>
#include <utility>

#include "core/mesh/circle.h"
#include "core/mesh/edges.h"
#include "core/mesh/smooth_parts.h"
#include "core/process/vertices.h"

namespace focalstage {

namespace {

/// Group numbers by area; equal ones as they stand.
std::vector<std::uint32_t> by_area(const std::vector<double>& areas_m2) {
  std::vector<std::uint32_t> order(areas_m2.size());
  std::iota(order.begin(), order.end(), 0U);
  std::ranges::stable_sort(order, [&](std::uint32_t a, std::uint32_t b) { return areas_m2[a] < areas_m2[b]; });
  return order;
}

/// An edge that more than two triangles share, by the sheets it belongs to; a sheet may be there twice.
using Fork = std::vector<std::uint32_t>;

std::vector<Fork> forks_of(const Edges& edges, const TriangleGroups& sheets) {
  std::vector<Fork> forks;
  edges.each([&](std::span<const EdgeUse> uses) {
    if (uses.size() < 3) return;
    Fork fork;
    for (const EdgeUse& use : uses) fork.push_back(sheets.of_triangle[use.triangle]);
    forks.push_back(std::move(fork));
  });
  return forks;
}

/// Without the sheet every edge keeps two triangles, and one that now has three comes to two.
bool is_fin(const std::vector<Fork*>& forks, std::uint32_t sheet) {
  bool mends = false;
  for (const Fork* fork : forks) {
    const auto own = static_cast<std::size_t>(std::ranges::count(*fork, sheet));
    if (fork->size() - own < 2) return false;
    mends = mends || fork->size() - own == 2;
  }
  return mends && std::ranges::any_of(forks, [](const Fork* fork) { return fork->size() % 2 == 1; });
}

}  // namespace

std::vector<bool> small_bits(const std::vector<double>& areas_m2, double least_share) {
  const double largest_m2 = areas_m2.empty() ? 0.0 : *std::ranges::max_element(areas_m2);
  std::vector<bool> small;
  for (const double area_m2 : areas_m2) small.push_back(area_m2 < least_share * largest_m2);
  return small;
}

Mesh without_bits(const Mesh& mesh, double least_share) {
  const TriangleGroups bits = connected_triangles(mesh, Edges(mesh), true);
  const std::vector<bool> small = small_bits(group_areas_m2(mesh, bits), least_share);
  std::vector<bool> kept;
  for (const std::uint32_t bit : bits.of_triangle) kept.push_back(!small[bit]);
  return mesh_of_triangles(mesh, kept);
}

Mesh without_fins(const Mesh& mesh) {
  const Edges edges(mesh);
  const TriangleGroups sheets = connected_triangles(mesh, edges, false);
  std::vector<Fork> forks = forks_of(edges, sheets);
  std::vector<std::vector<Fork*>> of_sheet(sheets.count);
  for (Fork& fork : forks) {
    for (const std::uint32_t sheet : std::set(fork.begin(), fork.end())) of_sheet[sheet].push_back(&fork);
  }
  std::vector<bool> gone(sheets.count);
  for (const std::uint32_t sheet : by_area(group_areas_m2(mesh, sheets))) {
    if (!is_fin(of_sheet[sheet], sheet)) continue;
    gone[sheet] = true;
    for (Fork* fork : of_sheet[sheet]) std::erase(*fork, sheet);
  }
  std::vector<bool> kept;
  for (const std::uint32_t sheet : sheets.of_triangle) kept.push_back(!gone[sheet]);
  return mesh_of_triangles(mesh, kept);
}

Mesh part_of(const Mesh& mesh, double fold_deg, int part) {
  const SmoothParts parts = smooth_parts(mesh, sin_cos_deg(fold_deg).cos);
  std::vector<std::uint32_t> order(parts.area_m2.size());
  std::iota(order.begin(), order.end(), 0U);
  std::ranges::stable_sort(order, std::greater(), [&](std::uint32_t i) { return parts.area_m2[i]; });
  std::vector<bool> kept(mesh.triangles.size());
  if (part >= 0 && static_cast<std::size_t>(part) < order.size()) {
    for (std::size_t i = 0; i < kept.size(); ++i) {
      kept[i] = parts.part_of_triangle[i] == order[static_cast<std::size_t>(part)];
    }
  }
  return mesh_of_triangles(mesh, kept);
}

}  // namespace focalstage
