#include "editor/tools/slice_sheets.h"

#include <glm/common.hpp>

#include "core/optics/vergence.h"

namespace focalstage {
namespace {

constexpr double widest_look = 1.0;  // 45 degrees to each side
constexpr double farthest_of_surface = 4.0;

}  // namespace

std::vector<SliceSheet> slice_sheets(const Project& project, const Stage& stage, Picker& picker) {
  const SightFrame sight = sight_frame(project, stage);
  const StagedSurface* surface = main_surface(sight, stage, picker);
  if (surface == nullptr) return {};
  const std::optional<double> surface_m = mean_axial_m(sight, *surface);
  LookBox box = looks_at(sight, surface->drawables);
  if (!surface_m || box.empty()) return {};
  box = {glm::clamp(box.low, -widest_look, widest_look), glm::clamp(box.high, -widest_look, widest_look)};

  std::vector<SliceSheet> sheets;
  for (std::size_t i = 0; i < project.slices.powers_d.size(); ++i) {
    SliceSheet sheet{
        i, project.slices.powers_d[i], image_vergence_d(*surface_m, project.slices.powers_d[i]), false, {}};
    sheet.drawn = sheet.vergence_d >= 1.0 / (farthest_of_surface * *surface_m);
    if (sheet.drawn) {
      const double axial_m = 1.0 / sheet.vergence_d;
      sheet.corners_m = {sight.point_at(box.low, axial_m), sight.point_at({box.high.x, box.low.y}, axial_m),
                         sight.point_at(box.high, axial_m), sight.point_at({box.low.x, box.high.y}, axial_m)};
    }
    sheets.push_back(sheet);
  }
  return sheets;
}

}  // namespace focalstage
