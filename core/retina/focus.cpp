#include "core/retina/focus.h"

#include "core/optics/vergence.h"
#include "core/retina/slice_maps.h"

namespace focalstage {
namespace {

double refraction_d(double wavelength_nm) { return 1.68524 - 633.46 / (wavelength_nm - 214.102); }

}  // namespace

std::array<double, 3> chromatic_offsets_d() {
  // Refraction is negative where the eye is short-sighted: there it focuses so much nearer.
  const double green_d = refraction_d(550.0);
  return {green_d - refraction_d(610.0), 0.0, green_d - refraction_d(465.0)};
}

double diffraction_radius(double pupil_m) { return pupil_m > 0.0 ? 2.0 * 0.42 * 550e-9 / pupil_m : 0.0; }

Focus::Focus(const RetinaInput& input, const RetinaView& view) : channels_(view.chromatic ? 3 : 1) {
  const double per_look = 1.0 / grid_of(view, 0).step.x;
  const double at_pupil_d = vergence_at_pupil_d(view.focus_d, input.lens_to_pupil_m);
  const std::array<double, 3> offsets_d = view.chromatic ? chromatic_offsets_d() : std::array<double, 3>{};
  for (std::size_t c = 0; c < 3; ++c) at_pupil_d_[c] = static_cast<float>(at_pupil_d + offsets_d[c]);
  px_per_d_ = static_cast<float>(0.5 * view.pupil_m * per_look);
  if (view.diffraction) least_px_ = static_cast<float>(diffraction_radius(view.pupil_m) * per_look);
}

}  // namespace focalstage
