#include "core/schedule/shape_rules.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/base/number_words.h"
#include "core/schedule/slots.h"

namespace focalstage {
namespace {

constexpr double same_power_d = 1e-6;

/// The powers that each eye is shown, light at zero among them, rising.
Result<std::vector<double>> powers_of(const std::vector<ImageSpec>& images) {
  std::vector<double> powers_d;
  for (const ImageSpec& image : images) {
    if (image.eye != ImageEye::right) powers_d.push_back(image.power_d);
  }
  if (powers_d.empty()) return Fault{"shape.slices", "/slices/powers_d", "no slice to dwell at", "add a slice"};
  if (!std::all_of(powers_d.begin(), powers_d.end(), [](double power_d) { return std::isfinite(power_d); })) {
    return Fault{"shape.slices", "/slices/powers_d", "a slice's power is not a finite number", "write a power"};
  }
  std::sort(powers_d.begin(), powers_d.end());
  for (std::size_t k = 1; k < powers_d.size(); ++k) {
    if (powers_d[k] - powers_d[k - 1] > same_power_d) continue;
    return Fault{"shape.slices", "/slices/powers_d",
                 "two slices at " + short_text(powers_d[k], 4) + " D cannot both be shown", "remove one of them"};
  }
  return powers_d;
}

Status check_sweep(const Project& project) {
  const Result<PowerCurve> sine = PowerCurve::make(project.sweep, Side::left);
  if (!sine) return Fault{"shape.sweep", sine.fault().where, sine.fault().message, sine.fault().remedy};
  const auto& [lowest_d, highest_d] = project.glasses.lens_range_d;
  if (!(lowest_d < highest_d)) {
    return Fault{"shape.limits", "/glasses/lens_range_d", "the lens has no range", "write its lower power first"};
  }
  return {};
}

Status check_projector(const Project& project) {
  if (project.projectors.empty()) {
    return Fault{"shape.projector", "/projectors", "nothing says how long an exposure is", "add a projector"};
  }
  const double length_s = exposure_s(project.projectors.front());
  const double pitch_s = slot_pitch_s(project.projectors.front());
  if (std::isfinite(length_s) && std::isfinite(pitch_s) && length_s > 0.0) return {};
  return Fault{"shape.projector", "/projectors/0", "its exposure is not a positive time",
               "correct frames_per_second or exposure_ms"};
}

Status check_limits(const LensLimits& limits) {
  const auto positive = [](double limit) { return std::isfinite(limit) && limit > 0.0; };
  const auto fault = [](const std::string& key) {
    return Fault{"shape.limits", "/glasses/lens_limits/" + key, "is not a positive number",
                 "write what the lens bears"};
  };
  if (!positive(limits.max_current_a)) return fault("max_current_a");
  if (!positive(limits.max_rms_current_a)) return fault("max_rms_current_a");
  if (limits.max_frequency_hz && !positive(*limits.max_frequency_hz)) return fault("max_frequency_hz");
  return {};
}

Status check_response(const Glasses& glasses) {
  for (const Side eye : both_sides) {
    for (const LensHarmonic& entry : glasses.lens_response[eye]) {
      if (std::isfinite(entry.gain_d_per_a) && std::isfinite(entry.phase_deg) &&
          !(entry.harmonic <= 1 && entry.gain_d_per_a == 0.0)) {
        continue;
      }
      return Fault{"shape.limits", "/glasses/lens_response",
                   "harmonic " + std::to_string(entry.harmonic) + " of the lens cannot be driven: its gain is " +
                       short_text(entry.gain_d_per_a, 4) + " D/A",
                   "measure the lens again, or adopt-rig"};
    }
  }
  return {};
}

/// Do the exposures fit between the shutters, one after the other?
Status check_room(const ShapeTask& task) {
  const double needed_s = static_cast<double>(task.powers_d.size() - 1) * task.pitch_s + task.exposure_s;
  const double there_s = task.clear.length_s();
  if (needed_s <= there_s) return {};
  return Fault{"shape.room", "/slices/powers_d",
               std::to_string(task.powers_d.size()) + " exposures take " + short_text(needed_s * 1000.0, 4) +
                   " ms of each half; the shutters leave " + short_text(there_s * 1000.0, 4) + " ms",
               "remove slices, expose for less, or sweep more slowly"};
}

/// The lowest of what ends the harmonics; the first of them where several do.
ShapeBound harmonic_bound(const Project& project, const LensLimits& limits, const ShapeOptions& options) {
  const PerEye<LensResponse>& lenses = project.glasses.lens_response;
  // That a sine can be driven is what every sweep relies on.
  const int measured = std::max(1, std::min(measured_harmonics(lenses.left), measured_harmonics(lenses.right)));
  ShapeBound bound{ShapeLimit::harmonics, most_shaped_harmonics, most_shaped_harmonics};
  const auto lower = [&](ShapeLimit limit, double allowed) {
    if (allowed < bound.allowed) bound = {limit, most_shaped_harmonics, std::max(1.0, allowed)};
  };
  lower(ShapeLimit::response, measured);
  if (limits.max_frequency_hz) {
    lower(ShapeLimit::frequency, std::floor(*limits.max_frequency_hz / project.sweep.frequency_hz + 1e-9));
  }
  if (options.max_harmonic) lower(ShapeLimit::asked, *options.max_harmonic);
  return bound;
}

}  // namespace

int measured_harmonics(const LensResponse& response) {
  for (int n = 1;; ++n) {
    const auto found = std::find_if(response.begin(), response.end(), [&](const auto& h) { return h.harmonic == n; });
    if (found == response.end() || !(found->gain_d_per_a > 0.0)) return n - 1;
  }
}

Result<ShapeRules> shape_rules(const Project& project, const std::vector<ImageSpec>& images,
                               const ShapeOptions& options) {
  if (options.max_harmonic && *options.max_harmonic < 1) {
    return Fault{"shape.limits", "max-harmonic", "a sweep has at least its first harmonic", "allow 1 or more"};
  }
  ShapeRules rules;
  rules.limits = project.glasses.lens_limits.value_or(LensLimits{});
  Result<std::vector<double>> powers_d = powers_of(images);
  if (!powers_d) return powers_d.fault();
  for (const Status& checked :
       {check_sweep(project), check_projector(project), check_limits(rules.limits), check_response(project.glasses)}) {
    if (!checked) return checked.fault();
  }
  rules.harmonics = harmonic_bound(project, rules.limits, options);

  ShapeTask& task = rules.task;
  task.period_s = 1.0 / project.sweep.frequency_hz;
  task.samples = shape_samples;
  task.highest_harmonic = static_cast<int>(rules.harmonics.allowed);
  task.powers_d = std::move(*powers_d);
  task.exposure_s = exposure_s(project.projectors.front());
  task.pitch_s = slot_pitch_s(project.projectors.front());
  task.clear = plan_shutters(project.glasses, task.period_s, task.period_s / 2.0).clear.left;
  task.lowest_d = std::max(project.sweep.min_power_d, project.glasses.lens_range_d[0]);
  task.highest_d = std::min(project.sweep.max_power_d, project.glasses.lens_range_d[1]);
  if (Status room = check_room(task); !room) return room.fault();
  if (task.powers_d.front() > task.lowest_d && task.powers_d.back() < task.highest_d) return rules;
  return Fault{"shape.slices", "/slices/powers_d",
               "a slice lies outside the sweep from " + short_text(task.lowest_d, 4) + " to " +
                   short_text(task.highest_d, 4) + " D",
               "widen the sweep"};
}

}  // namespace focalstage
