#include "core/optics/image_plan.h"

#include <algorithm>

namespace focalstage {
namespace {

bool lit(const Surface& surface) { return !surface.hidden && surface.illumination > 0.0; }

}  // namespace

std::vector<ImageSpec> image_plan(const Project& project) {
  const std::vector<double>& powers_d = project.slices.powers_d;
  const bool light = std::any_of(project.surfaces.begin(), project.surfaces.end(), lit);
  const auto zero = std::find(powers_d.begin(), powers_d.end(), 0.0);

  std::vector<ImageSpec> images;
  for (const ImageEye eye : {ImageEye::left, ImageEye::right}) {
    for (std::size_t n = 0; n < powers_d.size(); ++n) {
      const bool carries_light = light && powers_d.begin() + static_cast<std::ptrdiff_t>(n) == zero;
      const ImageKind kind = carries_light ? ImageKind::content_and_light : ImageKind::content;
      images.push_back({eye, kind, powers_d[n], static_cast<int>(n)});
    }
  }
  if (light && zero == powers_d.end()) images.push_back({ImageEye::both, ImageKind::surface_light, 0.0, -1});
  return images;
}

}  // namespace focalstage
