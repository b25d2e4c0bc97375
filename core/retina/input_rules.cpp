#include "core/retina/retina.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace focalstage {
namespace {

constexpr int most_side_px = 8192;
constexpr std::int64_t most_pixels = std::int64_t{1} << 24;
constexpr double most_pupil_m = 0.02;
constexpr double most_head_offset_m = 1.0;

Fault unfit(std::string message) { return {"retina.input", "", std::move(message), ""}; }

bool size_fits(int width_px, int height_px) {
  return width_px >= 1 && height_px >= 1 && width_px <= most_side_px && height_px <= most_side_px &&
         std::int64_t{width_px} * height_px <= most_pixels;
}

/// NaN lies in no range.
bool within(double value, double low, double high) { return value >= low && value <= high; }

Status check_powers(const std::vector<PowerShare>& powers, const std::string& who) {
  for (const PowerShare& part : powers) {
    if (!std::isfinite(part.power_d)) return unfit("a power of " + who + " is no number");
    if (!within(part.share, 0.0, 1.0)) return unfit("a share of " + who + " lies outside 0 to 1");
  }
  return {};
}

Status check_exposures(const RetinaInput& input) {
  const std::size_t bytes = static_cast<std::size_t>(input.projector.width_px) *
                            static_cast<std::size_t>(input.projector.height_px) *
                            static_cast<std::size_t>(input.channels);
  for (std::size_t i = 0; i < input.exposures.size(); ++i) {
    const RetinaExposure& exposure = input.exposures[i];
    const std::string who = "exposure " + std::to_string(i);
    if (Status fits = check_powers(exposure.powers, who); !fits) return fits;
    if (exposure.codes.size() != bytes) {
      return unfit(who + " has " + std::to_string(exposure.codes.size()) + " codes, not " + std::to_string(bytes));
    }
  }
  return {};
}

Status check_light(const RetinaInput& input) {
  if (!within(input.black_level, 0.0, 0.5)) return unfit("the black level lies outside 0 to 0.5");
  if (!within(input.level, 0.0, 1e6)) return unfit("the level of the light lies outside 0 to a million");
  const auto is_share = [](double share) { return within(share, 0.0, 1.0); };
  if (input.transfer.size() == 1 || !std::all_of(input.transfer.begin(), input.transfer.end(), is_share))
    return unfit("the transfer function is no list of shares");
  if (input.falloff_reference_m && !within(*input.falloff_reference_m, 1e-3, 1e6))
    return unfit("the reference of the light lies outside 1 mm to 1000 km");
  for (const PowerShare& part : input.ambient) {
    if (!std::isfinite(part.power_d) || !within(part.share, 0.0, 1e6)) return unfit("the room's light is no number");
  }
  return {};
}

}  // namespace

Status check_retina(const RetinaInput& input, const RetinaView& view) {
  if (!input.stage) return unfit("there is no stage");
  if (!size_fits(input.projector.width_px, input.projector.height_px)) return unfit("the projector has no usable size");
  if (input.channels != 1 && input.channels != 3) return unfit("images have one or three channels");
  if (!within(input.bits, 1, 8)) return unfit("codes have one to eight bits");
  if (!within(input.gamma, 0.1, 10.0)) return unfit("the projector's gamma lies outside 0.1 to 10");
  if (Status fits = check_light(input); !fits) return fits;
  if (!within(input.lens_to_pupil_m, 0.0, 1.0)) return unfit("the lens lies outside 0 to 1 m before the pupil");
  if (!within(input.lens_aperture_m, 0.0, 1.0)) return unfit("the lens aperture lies outside 0 to 1 m");
  if (!within(std::abs(input.projector_focus.focus_d), 0.0, 1e3) ||
      !within(input.projector_focus.depth_of_field_d, 0.0, 1e3)) {
    return unfit("the projector's focus lies outside -1000 to 1000 D, or its depth of field outside 0 to 1000 D");
  }
  if (!size_fits(view.width_px, view.height_px))
    return unfit("the picture's size lies outside 1 to 8192 px a side, 2^24 in all");
  if (!within(view.fov_deg, 0.01, 170.0)) return unfit("the field of view lies outside 0.01 to 170 degrees");
  if (!within(view.pupil_m, 0.0, most_pupil_m)) return unfit("the pupil lies outside 0 to 20 mm");
  if (!within(std::abs(view.focus_d), 0.0, 1e3)) return unfit("the focus lies outside -1000 to 1000 D");
  if (!within(std::abs(view.gaze.x), 0.0, 10.0) || !within(std::abs(view.gaze.y), 0.0, 10.0)) {
    return unfit("the gaze turns away from the lens");
  }
  const glm::dvec3& moved_m = view.head_offset_m;
  if (!within(moved_m.x * moved_m.x + moved_m.y * moved_m.y + moved_m.z * moved_m.z, 0.0,
              most_head_offset_m * most_head_offset_m)) {
    return unfit("the head moved by more than a metre");
  }
  return check_exposures(input);
}

}  // namespace focalstage
