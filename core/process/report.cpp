#include "core/process/report.h"

#include <algorithm>

#include "core/process/bits.h"
#include "core/process/borders.h"
#include "core/process/clean.h"
#include "core/process/winding.h"

namespace focalstage {

namespace {

constexpr double bit_share = 0.01;

void count_unclean(const Mesh& mesh, MeshReport& report) {
  const Unclean unclean = unclean_triangles(mesh);
  report.no_area = static_cast<std::size_t>(std::ranges::count(unclean.no_area, true));
  report.repeated = static_cast<std::size_t>(std::ranges::count(unclean.repeated, true));
}

/// What triangles say once those are gone that say nothing, or say it twice.
void count_flaws(const Mesh& mesh, MeshReport& report) {
  const Edges edges(mesh);
  edges.each([&](std::span<const EdgeUse> uses) { report.forked_edges += uses.size() > 2; });
  report.edges_against = edges_against(edges);
  const TriangleGroups sheets = connected_triangles(mesh, edges, false);
  const std::vector<bool> closed = closed_groups(edges, sheets);
  const std::vector<double> volumes_m3 = group_volumes_m3(mesh, sheets);
  if (report.edges_against == 0) {
    for (std::size_t i = 0; i < sheets.count; ++i) report.bodies_inside_out += closed[i] && volumes_m3[i] < 0.0;
  }
  const TriangleGroups bits = connected_triangles(mesh, edges, true);
  const std::vector<double> areas_m2 = group_areas_m2(mesh, bits);
  report.bits = static_cast<std::size_t>(std::ranges::count(small_bits(areas_m2, bit_share), true));
  for (const Border& border : borders_of(mesh, edges, bits, areas_m2)) {
    if (!border.hole) continue;
    ++report.holes;
    report.longest_hole_m = std::max(report.longest_hole_m, border.length_m);
  }
}

std::string several(std::size_t count, const std::string& one, const std::string& many) {
  return std::to_string(count) + " " + (count == 1 ? one : many);
}

}  // namespace

MeshReport report_mesh(const Mesh& mesh) {
  MeshReport report;
  count_unclean(mesh, report);
  if (report.no_area + report.repeated == 0) {
    count_flaws(mesh, report);
  } else {
    count_flaws(cleaned(mesh), report);
  }
  return report;
}

std::vector<MeshFlaw> flaws_of(const MeshReport& report) {
  std::vector<MeshFlaw> flaws;
  const auto add = [&](const char* code, std::size_t count, std::string message, ProcessKind step) {
    if (count > 0) flaws.push_back({code, std::move(message), static_cast<double>(count), std::move(step)});
  };
  add("mesh.no-area", report.no_area, several(report.no_area, "triangle has", "triangles have") + " no area",
      CleanStep{});
  add("mesh.repeated", report.repeated,
      several(report.repeated, "triangle stands", "triangles stand") + " where another does", CleanStep{});
  add("mesh.forks", report.forked_edges,
      several(report.forked_edges, "edge has", "edges have") + " more than two triangles", DropFinsStep{});
  add("mesh.winding", report.edges_against,
      several(report.edges_against, "edge has", "edges have") + " one triangle facing front and one facing back",
      FixWindingStep{});
  add("mesh.inside-out", report.bodies_inside_out,
      several(report.bodies_inside_out, "closed body faces", "closed bodies face") + " inwards", FixWindingStep{});
  add("mesh.bits", report.bits,
      several(report.bits, "loose bit is", "loose bits are") + " smaller than 1 % of the largest",
      DropBitsStep{bit_share});
  add("mesh.holes", report.holes, several(report.holes, "hole", "holes"), FillHolesStep{});
  return flaws;
}

double count_of(const std::string& code, const std::vector<MeshFlaw>& flaws) {
  const auto found = std::ranges::find(flaws, code, &MeshFlaw::code);
  return found == flaws.end() ? 0.0 : found->count;
}

}  // namespace focalstage
