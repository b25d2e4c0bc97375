#include "editor/tools/nearest_on_line.h"

#include <glm/geometric.hpp>

namespace focalstage {

std::optional<double> nearest_on_line_m(const Ray& line, const Ray& ray) {
  const glm::dvec3 between = ray.origin_m - line.origin_m;
  const double cosine = glm::dot(line.direction, ray.direction);
  const double square_sine = 1.0 - cosine * cosine;
  if (square_sine < 1e-8) return std::nullopt;
  const double along_line = glm::dot(line.direction, between);
  const double along_ray = glm::dot(ray.direction, between);
  if (cosine * along_line - along_ray <= 0.0) return std::nullopt;
  return (along_line - cosine * along_ray) / square_sine;
}

}  // namespace focalstage
