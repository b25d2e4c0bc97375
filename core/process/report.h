#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/mesh/mesh.h"
#include "core/scene/process.h"

namespace focalstage {

/// What a mesh is like, for somebody who has to light it.
struct MeshReport {
  std::size_t no_area = 0;            ///< triangles
  std::size_t repeated = 0;           ///< triangles with the places of another for corners
  std::size_t forked_edges = 0;       ///< with more than two triangles
  std::size_t edges_against = 0;      ///< with two triangles that run along them the same way
  std::size_t bodies_inside_out = 0;  ///< closed, and looking inwards
  std::size_t holes = 0;
  double longest_hole_m = 0.0;  ///< around, by the mesh's own measure
  std::size_t bits = 0;         ///< loose, smaller than 1 % of the largest one's area

  bool sound() const {
    return no_area + repeated + forked_edges + edges_against + bodies_inside_out + holes + bits == 0;
  }
};

MeshReport report_mesh(const Mesh& mesh);

/// Something wrong with a mesh, and the step that mends it.
struct MeshFlaw {
  std::string code;  ///< "mesh.*"
  std::string message;
  double count = 0.0;
  std::optional<ProcessKind> step;
};

/// What is wrong, in the order in which it is to be mended. Holes may be wanted, and what has been cut looks like one:
/// a flaw is a matter of the designer.
std::vector<MeshFlaw> flaws_of(const MeshReport& report);

/// How much of that is among the flaws.
double count_of(const std::string& code, const std::vector<MeshFlaw>& flaws);

/// The flaws of a mesh, kept as `processed_once` keeps, and each held to its promise: where its step leaves as much
/// wrong as there was (bodies that touch along an edge have no fin), there is none.
std::vector<MeshFlaw> flaws_once(const std::shared_ptr<const Mesh>& mesh);

}  // namespace focalstage
