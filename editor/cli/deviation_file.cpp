#include "editor/cli/deviation_file.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/common.hpp>

#include "core/base/number_words.h"

namespace focalstage {

namespace {

std::string colour_words(double share) {
  static constexpr std::array<glm::dvec3, 4> stops{
      {{0.0, 0.2, 1.0}, {0.0, 0.8, 0.2}, {1.0, 0.9, 0.0}, {1.0, 0.0, 0.0}}};
  const double place = std::clamp(share, 0.0, 1.0) * 3.0;
  const auto below = std::min<std::size_t>(static_cast<std::size_t>(place), 2);
  const glm::dvec3 colour = glm::mix(stops[below], stops[below + 1], place - static_cast<double>(below));
  std::string words;
  for (int k = 0; k < 3; ++k) words += " " + std::to_string(std::lround(255.0 * colour[k]));
  return words;
}

}  // namespace

std::string deviation_ply(const std::vector<Drawable>& drawables, const Deviation& deviation, double full_scale_m) {
  std::string vertices, faces;
  std::size_t vertex_count = 0, face_count = 0;
  for (std::size_t part = 0; part < drawables.size(); ++part) {
    const Mesh& mesh = *drawables[part].mesh;
    for (std::size_t i = 0; i < mesh.positions_m.size(); ++i) {
      const glm::dvec4 place = drawables[part].world_from_mesh * glm::dvec4(mesh.positions_m[i], 1.0);
      vertices += short_text(place.x, 9) + " " + short_text(place.y, 9) + " " + short_text(place.z, 9) +
                  colour_words(deviation.of_vertex_m[part][i] / full_scale_m) + "\n";
    }
    for (const glm::uvec3& t : mesh.triangles) {
      faces += "3";
      for (int k = 0; k < 3; ++k) faces += " " + std::to_string(vertex_count + t[k]);
      faces += "\n";
    }
    vertex_count += mesh.positions_m.size();
    face_count += mesh.triangles.size();
  }
  return "ply\nformat ascii 1.0\ncomment colours: blue nothing, red " + short_text(1e3 * full_scale_m) +
         " mm and more\nelement vertex " + std::to_string(vertex_count) +
         "\nproperty float x\nproperty float y\nproperty float z\nproperty uchar red\nproperty uchar green\n"
         "property uchar blue\nelement face " +
         std::to_string(face_count) + "\nproperty list uchar int vertex_indices\nend_header\n" + vertices + faces;
}

}  // namespace focalstage
