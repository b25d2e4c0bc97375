#pragma once

#include <memory>
#include <optional>
#include <stop_token>
#include <vector>

#include <glm/mat4x4.hpp>

#include "core/retina/retina.h"
#include "core/retina/slice_map.h"

namespace focalstage {

/// The eye of the view, its head moved.
Eye eye_of(const RetinaInput& input, const RetinaView& view);

/// The picture's pixels and `margin_px` more on each side.
LookGrid grid_of(const RetinaView& view, int margin_px);

/// Makes the maps of the slices and keeps them while what they depend on stays.
class SliceMaps {
 public:
  /// Brings the maps of `powers_d` up to date. The result has one per power, in their order; it and the maps hold until
  /// the next call. Unfinished after a stop request: then nothing is kept of what was not done.
  std::vector<const SliceMap*> of(const RetinaInput& input, const RetinaView& view, int margin_px,
                                  const std::vector<double>& powers_d, const std::stop_token& stop);

 private:
  /// What decides where surfaces are. The meshes are held, so that an address says which mesh it is.
  struct Standing {
    std::shared_ptr<const Mesh> mesh;
    glm::dmat4 world_from_mesh{1.0};
    Finish finish{};

    bool operator==(const Standing&) const = default;
  };
  /// What else decides the maps.
  struct Viewpoint {
    Rigid eye_from_world;
    double lens_to_pupil_m = 0.0;
    double widest_off_axis_m = 0.0;
    ProjectorFocus projector_focus;
    glm::dvec2 first{0.0};
    glm::dvec2 step{0.0};
    int width_px = 0;
    int height_px = 0;

    bool operator==(const Viewpoint&) const = default;
  };

  bool stand(const RetinaInput& input, const std::stop_token& stop);
  const SliceMap* kept(double power_d) const;

  std::vector<Standing> standing_;
  SurfaceMesh mesh_;
  ProjectorModel projector_;
  std::optional<ProjectorLight> light_;
  std::optional<double> falloff_reference_m_;
  std::unique_ptr<const SurfacePaint> paint_;  ///< null: plain
  std::optional<Viewpoint> viewpoint_;
  std::vector<std::unique_ptr<SliceMap>> maps_;
};

}  // namespace focalstage
