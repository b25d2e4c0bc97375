#include "core/schedule/slots.h"

#include <algorithm>
#include <cmath>

namespace focalstage {
namespace {

using Kind = SlotTrouble::Kind;

/// What rounding may do to a time: far below what any rig resolves.
constexpr double tolerance_s = 1e-9;
constexpr double tolerance_d = 1e-9;

bool shown_to(ImageEye image_eye, Side eye) {
  return image_eye == ImageEye::both || index_of(eye) == static_cast<std::size_t>(image_eye);
}

bool carries_light(ImageKind kind) { return kind != ImageKind::content; }

/// One eye's exposures: all that decides where they lie.
struct EyeTiming {
  const PowerCurve& curve;
  Side eye;
  TimeSpan clear;  ///< own half of the sweep, less the dead windows
  const Projector& projector;
};

TimeSpan clear_half(const PowerCurve& curve, Side eye, const TimeSpan& clear) {
  if (eye == Side::left) return {std::max(0.0, clear.from_s), std::min(curve.peak_s(), clear.to_s)};
  return {std::max(curve.peak_s(), clear.from_s), std::min(curve.period_s(), clear.to_s)};
}

void name_unreached(const EyeTiming& timing, const ImageSpec& spec, int image, Timing& result) {
  const double nearer_d = spec.power_d < timing.curve.min_d() ? timing.curve.min_d() : timing.curve.max_d();
  if (spec.slice >= 0) {
    result.troubles.push_back({Kind::outside_sweep, image, -1, timing.eye, spec.power_d, nearer_d});
  }
  if (carries_light(spec.kind)) {
    result.troubles.push_back({Kind::no_zero_crossing, image, -1, timing.eye, nearer_d, 0.0});
  }
}

/// Centres the exposure of one image where the eye's half passes its power.
void time_image(const EyeTiming& timing, const ImageSpec& spec, int image, Timing& result) {
  const std::optional<double> centre_s = timing.curve.passing_s(spec.power_d, timing.eye);
  if (!centre_s) return name_unreached(timing, spec, image, result);

  const double length_s = exposure_s(timing.projector);
  const TimeSpan exposure{*centre_s - length_s / 2.0, *centre_s + length_s / 2.0};
  const TimeSpan seen{std::max(exposure.from_s, timing.clear.from_s), std::min(exposure.to_s, timing.clear.to_s)};
  const double hidden_s = length_s - seen.length_s();
  if (hidden_s > tolerance_s) {
    result.troubles.push_back({Kind::hidden_by_shutter, image, -1, timing.eye, hidden_s, 0.0});
    return;
  }
  Slot slot;
  slot.image = image;
  slot.eye = timing.eye;
  slot.start_s = exposure.from_s;
  slot.exposure_s = length_s;
  slot.trigger_s = exposure.from_s - timing.projector.latency_ms / 1000.0;
  slot.power_d = timing.curve.power_d(*centre_s);
  // Within its half the power is monotonic, so its change is the difference of the ends.
  slot.smear_d = std::abs(timing.curve.power_d(exposure.to_s) - timing.curve.power_d(exposure.from_s));
  if (slot.smear_d > most_smear_d + tolerance_d) {
    result.troubles.push_back({Kind::smear, image, -1, timing.eye, slot.smear_d, most_smear_d});
  }
  result.slots.push_back(slot);
}

/// Successive exposures that are too close, from the last one round to the first of the next period.
void name_overlaps(double pitch_s, double period_s, Timing& result) {
  const std::vector<Slot>& slots = result.slots;
  for (std::size_t i = 0; i < slots.size(); ++i) {
    const bool last = i + 1 == slots.size();
    const Slot& next = slots[last ? 0 : i + 1];
    const double apart_s = next.start_s - slots[i].start_s + (last ? period_s : 0.0);
    if (apart_s >= pitch_s - tolerance_s) continue;
    result.troubles.push_back({Kind::overlap, slots[i].image, next.image, slots[i].eye, apart_s, pitch_s});
  }
}

}  // namespace

double exposure_s(const Projector& projector) {
  return projector.exposure_ms ? *projector.exposure_ms / 1000.0 : 1.0 / projector.frames_per_second;
}

double slot_pitch_s(const Projector& projector) {
  return std::max(exposure_s(projector), 1.0 / projector.frames_per_second);
}

PerEye<Result<PowerCurve>> power_curves(const Sweep& sweep) {
  return {PowerCurve::make(sweep, Side::left), PowerCurve::make(sweep, Side::right)};
}

ShutterPlan shutters_of(const Project& project, const PerEye<Result<PowerCurve>>& curves) {
  // Where the eyes' maxima differ, the shutters change half-way between them; each eye's exposures keep to its own
  // half.
  const Result<PowerCurve>& one = curves.left ? curves.left : curves.right;
  const Result<PowerCurve>& other = curves.right ? curves.right : curves.left;
  if (!one) return {};
  return plan_shutters(project.glasses, one->period_s(), (one->peak_s() + other->peak_s()) / 2.0);
}

Timing time_slots(const Project& project, const std::vector<ImageSpec>& images, std::size_t projector) {
  Timing result;
  const PerEye<Result<PowerCurve>> curves = power_curves(project.sweep);
  const ShutterPlan shutters = shutters_of(project, curves);
  for (const Side eye : both_sides) {
    if (!curves[eye]) {
      result.troubles.push_back({Kind::bad_waveform, -1, -1, eye, 0.0, 0.0});
      continue;
    }
    if (projector >= project.projectors.size()) continue;
    const PowerCurve& curve = *curves[eye];
    const EyeTiming timing{curve, eye, clear_half(curve, eye, shutters.clear[eye]), project.projectors[projector]};
    for (std::size_t image = 0; image < images.size(); ++image) {
      if (shown_to(images[image].eye, eye)) time_image(timing, images[image], static_cast<int>(image), result);
    }
  }
  std::stable_sort(result.slots.begin(), result.slots.end(),
                   [](const Slot& a, const Slot& b) { return a.start_s < b.start_s; });
  if (!result.slots.empty()) {
    name_overlaps(slot_pitch_s(project.projectors[projector]), 1.0 / project.sweep.frequency_hz, result);
  }
  return result;
}

}  // namespace focalstage
