#include "core/schedule/sweep_shape.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/schedule/lens_response.h"
#include "core/schedule/schedule.h"
#include "core/schedule/shape_curve.h"
#include "core/schedule/shape_rules.h"

namespace focalstage {
namespace {

/// As a file has them: far below what a lens follows, enough that the flattest halves stay strictly monotonic.
constexpr double decimals = 1e8;

/// A drive or a range this near to its limit stands at it.
constexpr double at_limit = 0.998;

Project with_sine(Project project) {
  project.sweep.waveform = {};
  return project;
}

std::vector<double> rounded(std::vector<double> numbers) {
  for (double& number : numbers) number = std::round(number * decimals) / decimals;
  return numbers;
}

/// The curve as one eye plays it, with the drive that makes it.
MeasuredWaveform played(const HarmonicCurve& curve, const LensResponse& response, Side eye) {
  const std::vector<double> rising_d = samples_of(curve, shape_samples);
  std::vector<double> power_d = rising_d;
  if (eye == Side::right) std::reverse(power_d.begin() + 1, power_d.end());
  std::vector<double> drive_a = drive_for_power(power_d, response);
  return {rounded(std::move(power_d)), rounded(std::move(drive_a)), {}};
}

PerEye<DriveLoad> loads_of(const Project& project) {
  const Schedule schedule = make_schedule(project, {}).schedule;
  return {load_of(schedule.lens_drive_a.left), load_of(schedule.lens_drive_a.right)};
}

bool within(const DriveLoad& load, const LensLimits& limits) {
  return load.peak_a <= limits.max_current_a && load.rms_a <= limits.max_rms_current_a;
}

/// What stands at a limit of current, the worse eye of both.
void name_currents(const PerEye<DriveLoad>& loads, const LensLimits& limits, std::vector<ShapeBound>& bounds) {
  const double peak_a = std::max(loads.left.peak_a, loads.right.peak_a);
  const double rms_a = std::max(loads.left.rms_a, loads.right.rms_a);
  if (peak_a >= at_limit * limits.max_current_a) {
    bounds.push_back({ShapeLimit::current, peak_a, limits.max_current_a});
  }
  if (rms_a >= at_limit * limits.max_rms_current_a) {
    bounds.push_back({ShapeLimit::rms_current, rms_a, limits.max_rms_current_a});
  }
}

void name_range(const std::vector<double>& power_d, const ShapeTask& task, std::vector<ShapeBound>& bounds) {
  const auto [lowest, highest] = std::minmax_element(power_d.begin(), power_d.end());
  const double near_d = (1.0 - at_limit) * (task.highest_d - task.lowest_d);
  if (*lowest <= task.lowest_d + near_d) bounds.push_back({ShapeLimit::range, *lowest, task.lowest_d});
  if (*highest >= task.highest_d - near_d) bounds.push_back({ShapeLimit::range, *highest, task.highest_d});
}

/// The best curve of each eye. One serves both, mirrored, unless a lens cannot be driven so: then each has its own.
PerEye<std::optional<HarmonicCurve>> curves_for(const ShapeTask& task, const Glasses& glasses, const LensLimits& limits,
                                                std::vector<ShapeBound>& bounds) {
  const std::optional<HarmonicCurve> free = shape_curve(task, std::nullopt);
  PerEye<std::optional<HarmonicCurve>> curves{free, free};
  for (const Side eye : both_sides) {
    const LensResponse& response = glasses.lens_response[eye];
    PerEye<DriveLoad> asked;
    if (free) asked[eye] = load_of(played(*free, response, eye).drive_a);
    if (free && within(asked[eye], limits)) continue;
    const DriveTask drive{response, eye == Side::right, limits.max_current_a, limits.max_rms_current_a};
    curves[eye] = shape_curve(task, drive);
    if (!curves[eye] && free) name_currents(asked, limits, bounds);
  }
  return curves;
}

using Troubles = std::vector<SlotTrouble>;

bool named(const Troubles& troubles, const SlotTrouble& trouble) {
  return std::any_of(troubles.begin(), troubles.end(), [&](const SlotTrouble& other) {
    return other.kind == trouble.kind && other.image == trouble.image && other.eye == trouble.eye;
  });
}

bool brings_trouble(const Troubles& shaped, const Troubles& sine) {
  return std::any_of(shaped.begin(), shaped.end(), [&](const SlotTrouble& trouble) { return !named(sine, trouble); });
}

/// Less smear, or more shown.
bool is_better(const Timing& shaped, const Timing& sine) {
  if (brings_trouble(shaped.troubles, sine.troubles) || shaped.slots.size() < sine.slots.size()) return false;
  return shaped.slots.size() > sine.slots.size() || worst_smear_d(shaped) < worst_smear_d(sine);
}

}  // namespace

double worst_smear_d(const Timing& timing) {
  double worst_d = 0.0;
  for (const Slot& slot : timing.slots) worst_d = std::max(worst_d, slot.smear_d);
  return worst_d;
}

double mean_smear_d(const Timing& timing) {
  if (timing.slots.empty()) return 0.0;
  double sum_d = 0.0;
  for (const Slot& slot : timing.slots) sum_d += slot.smear_d;
  return sum_d / static_cast<double>(timing.slots.size());
}

Result<SweepShape> shape_sweep(const Project& project, const std::vector<ImageSpec>& images,
                               const ShapeOptions& options) {
  const Project sine = with_sine(project);
  const Result<ShapeRules> rules = shape_rules(sine, images, options);
  if (!rules) return rules.fault();

  SweepShape shape;
  shape.highest_harmonic = rules->task.highest_harmonic;
  shape.bounds.push_back(rules->harmonics);
  shape.sine = time_slots(sine, images);
  shape.sine_load = loads_of(sine);
  const auto curves = curves_for(rules->task, project.glasses, rules->limits, shape.bounds);
  if (!curves.left || !curves.right) return shape;

  Project shaped = sine;
  for (const Side eye : both_sides) {
    shape.waveform[eye] = played(*curves[eye], project.glasses.lens_response[eye], eye);
    shaped.sweep.waveform[eye] = shape.waveform[eye];
  }
  shape.shaped = time_slots(shaped, images);
  shape.shaped_load = loads_of(shaped);
  shape.better = is_better(shape.shaped, shape.sine);
  name_currents(shape.shaped_load, rules->limits, shape.bounds);
  name_range(shape.waveform.left.power_d, rules->task, shape.bounds);
  if (!shape.better) {
    shape.waveform = {};
    shape.shaped = {};
  }
  return shape;
}

Value waveform_value(const PerEye<MeasuredWaveform>& waveform) {
  const auto numbers = [](const std::vector<double>& list) { return Value(Value::Array(list.begin(), list.end())); };
  const auto one = [&](const MeasuredWaveform& eye) {
    return Value(Value::Object{{"power_d", numbers(eye.power_d)}, {"drive_a", numbers(eye.drive_a)}});
  };
  if (waveform.left == waveform.right) return one(waveform.left);
  return Value(Value::Object{{"left", one(waveform.left)}, {"right", one(waveform.right)}});
}

}  // namespace focalstage
