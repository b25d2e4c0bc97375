#include "core/process/borders.h"

#include <algorithm>
#include <limits>
#include <map>

#include <glm/geometric.hpp>

#include "core/mesh/measure.h"

namespace focalstage {

namespace {

/// A border edge the way a filling triangle runs along it.
struct BorderEdge {
  std::uint32_t from = 0;  ///< a vertex of the mesh
  std::uint32_t to_place = 0;
  std::uint32_t triangle = 0;
  bool taken = false;
};

/// By the place where they begin.
using BorderEdges = std::multimap<std::uint32_t, BorderEdge>;

BorderEdges border_edges(const Mesh& mesh, const Edges& edges) {
  BorderEdges found;
  edges.each([&](std::span<const EdgeUse> uses) {
    if (uses.size() != 1) return;
    const EdgeUse& use = uses.front();
    const glm::uvec3& triangle = mesh.triangles[use.triangle];
    const std::uint32_t end = triangle[(use.side + 1) % 3];
    found.emplace(edges.place_of()[end], BorderEdge{end, edges.place_of()[triangle[use.side]], use.triangle});
  });
  return found;
}

/// Follows the border from `first` until it comes back; nothing where it ends.
std::optional<Border> follow(const Mesh& mesh, BorderEdges& edges, BorderEdges::iterator first) {
  Border border;
  auto at = first;
  while (true) {
    at->second.taken = true;
    border.vertices.push_back(at->second.from);
    const std::uint32_t to = at->second.to_place;
    border.length_m += glm::distance(mesh.positions_m[at->second.from], mesh.positions_m[to]);
    if (to == first->first) return border;
    const auto [begin, end] = edges.equal_range(to);
    at = std::find_if(begin, end, [](const auto& edge) { return !edge.second.taken; });
    if (at == end) return std::nullopt;
  }
}

}  // namespace

std::vector<Border> borders_of(const Mesh& mesh, const Edges& edges, const TriangleGroups& bits,
                               const std::vector<double>& areas_m2) {
  constexpr double rim_share = 3.0;
  BorderEdges left = border_edges(mesh, edges);
  std::vector<Border> borders;
  std::map<std::uint32_t, std::size_t> longest;  // of each group
  for (auto edge = left.begin(); edge != left.end(); ++edge) {
    if (edge->second.taken) continue;
    std::optional<Border> border = follow(mesh, left, edge);
    if (!border) continue;
    border->hole = true;
    const auto [entry, is_first] = longest.try_emplace(bits.of_triangle[edge->second.triangle], borders.size());
    if (!is_first && border->length_m > borders[entry->second].length_m) entry->second = borders.size();
    borders.push_back(*std::move(border));
  }
  for (const auto& [bit, place] : longest) {
    const double length_m = borders[place].length_m;
    borders[place].hole = length_m * length_m <= rim_share * areas_m2[bit];
  }
  return borders;
}

namespace {

/// The triangulation of a closed line with the least area (Barequet and Sharir, 1995: by the best of all its parts).
class LeastArea {
 public:
  LeastArea(const Mesh& mesh, const std::vector<std::uint32_t>& line)
      : mesh_(mesh), line_(line), best_(line.size() * line.size(), {0.0, 0}) {
    for (std::size_t span = 2; span < line.size(); ++span) {
      for (std::size_t from = 0; from + span < line.size(); ++from) choose(from, from + span);
    }
  }

  void append_to(std::vector<glm::uvec3>& triangles) const { append(0, line_.size() - 1, triangles); }

 private:
  struct Best {
    double area = 0.0;
    std::uint32_t middle = 0;
  };

  Best& at(std::size_t from, std::size_t to) { return best_[from * line_.size() + to]; }
  const Best& at(std::size_t from, std::size_t to) const { return best_[from * line_.size() + to]; }

  double doubled(std::size_t a, std::size_t b, std::size_t c) const {
    return glm::length(
        doubled_area(mesh_.positions_m[line_[a]], mesh_.positions_m[line_[b]], mesh_.positions_m[line_[c]]));
  }
  void choose(std::size_t from, std::size_t to) {
    Best best{std::numeric_limits<double>::infinity(), 0};
    for (std::size_t middle = from + 1; middle < to; ++middle) {
      const double area = at(from, middle).area + at(middle, to).area + doubled(from, middle, to);
      if (area < best.area) best = {area, static_cast<std::uint32_t>(middle)};
    }
    at(from, to) = best;
  }
  void append(std::size_t from, std::size_t to, std::vector<glm::uvec3>& triangles) const {
    std::vector<std::pair<std::size_t, std::size_t>> open{{from, to}};
    while (!open.empty()) {
      const auto [a, c] = open.back();
      open.pop_back();
      if (c - a < 2) continue;
      const std::size_t b = at(a, c).middle;
      triangles.emplace_back(line_[a], line_[b], line_[c]);
      open.emplace_back(a, b);
      open.emplace_back(b, c);
    }
  }

  const Mesh& mesh_;
  const std::vector<std::uint32_t>& line_;
  std::vector<Best> best_;
};

}  // namespace

Mesh filled(const Mesh& mesh, std::optional<double> longest_m) {
  const Edges edges(mesh);
  Mesh made = mesh;
  const TriangleGroups bits = connected_triangles(mesh, edges, true);
  for (const Border& border : borders_of(mesh, edges, bits, group_areas_m2(mesh, bits))) {
    const bool asked = longest_m ? border.length_m <= *longest_m : border.hole;
    if (!asked || border.vertices.size() < 3 || border.vertices.size() > most_border_vertices) continue;
    LeastArea(mesh, border.vertices).append_to(made.triangles);
  }
  return made;
}

}  // namespace focalstage
