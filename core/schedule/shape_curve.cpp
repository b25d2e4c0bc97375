#include "core/schedule/shape_curve.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/schedule/drive_load.h"
#include "core/schedule/shape_program.h"
#include "core/schedule/waveform.h"

namespace focalstage {
namespace {

constexpr double turn = 2.0 * std::numbers::pi;

constexpr int most_programs = 40;
constexpr double first_trust = 0.15;  ///< radians that a slice may move in one step
constexpr double most_trust = 2.0;
constexpr double least_trust = 2e-4;       ///< half a microsecond at 60 Hz: no step worth another
constexpr double worth = 1e-4;             ///< a step that betters less is the last of its size
constexpr double tolerated_late_s = 4e-6;  ///< less than what the programs keep spare
constexpr double tolerated_over_d = 1e-6;

/// What a curve is worth, by the exposures that it asks for itself.
struct Judged {
  std::vector<double> phase;  ///< of every slice
  double smear_d = 0.0;       ///< the worst, and a little of the mean
  double late = 0.0;          ///< radians of overlap and of hidden light
  double over_a = 0.0;        ///< beyond a limit
  double over_d = 0.0;        ///< beyond the range
  double merit = std::numeric_limits<double>::infinity();
};

class Search {
 public:
  Search(const ShapeTask& task, const std::optional<DriveTask>& drive)
      : task_(task), drive_(drive), program_(task, drive) {}

  std::optional<HarmonicCurve> run() {
    curve_ = least_sine();
    judged_ = judge(curve_);
    keep();
    double trust = first_trust;
    bool begun = false;
    for (int i = 0; i < most_programs && trust > least_trust && trust < most_trust; ++i) {
      if (judged_.phase.size() != task_.powers_d.size()) break;
      const auto better = least_cost(program_.around(curve_, judged_.phase, trust));
      // The sine that it starts from may lie outside the limits: then it takes a longer step to be within.
      trust = better ? follow(*better, trust) : trust * (begun ? 0.5 : 2.0);
      begun = begun || better;
    }
    return best_;
  }

 private:
  /// The least sine that shows the outermost slices between the shutters.
  HarmonicCurve least_sine() const {
    const double low_d = task_.powers_d.front();
    const double high_d = task_.powers_d.back();
    const double share = std::max(0.05, std::cos(std::min(program_.first(), turn / 4.0)));
    HarmonicCurve curve(program_.coefficients(), 0.0);
    curve[0] = (low_d + high_d) / 2.0;
    curve[1] = -1.02 * std::max((high_d - low_d) / 2.0 / share, 0.05);
    return curve;
  }

  Judged judge(const HarmonicCurve& curve) const {
    Judged judged;
    Sweep sweep;
    sweep.frequency_hz = 1.0 / turn;  // times are phases
    sweep.waveform.left = MeasuredWaveform{samples_of(curve, task_.samples), {}, {}};
    const Result<PowerCurve> played = PowerCurve::make(sweep, Side::left);
    if (!played) return judged;
    double sum_d = 0.0;
    for (const double power_d : task_.powers_d) {
      const std::optional<double> phase = played->passing_s(power_d, Side::left);
      if (!phase) return judged;
      judged.phase.push_back(*phase);
      const double half = program_.half_exposure();
      const double smear_d = std::abs(played->power_d(*phase + half) - played->power_d(*phase - half));
      judged.smear_d = std::max(judged.smear_d, smear_d);
      sum_d += smear_d;
    }
    judged.smear_d += mean_weight * sum_d / static_cast<double>(task_.powers_d.size());
    judged.late = lateness(judged.phase);
    judged.over_d = std::max({0.0, task_.lowest_d - played->min_d(), played->max_d() - task_.highest_d});
    if (drive_) {
      const DriveLoad load = load_of(program_.drive_a(curve));
      judged.over_a = std::max({0.0, load.peak_a - drive_->max_current_a, load.rms_a - drive_->max_rms_current_a});
    }
    judged.merit =
        judged.smear_d + late_weight_d * judged.late + over_weight_d * judged.over_a + late_weight_d * judged.over_d;
    return judged;
  }

  double lateness(const std::vector<double>& phase) const {
    double late = std::max({0.0, program_.first() - phase.front(), phase.back() - program_.last()});
    for (std::size_t k = 1; k < phase.size(); ++k) late = std::max(late, program_.pitch() - (phase[k] - phase[k - 1]));
    return late;
  }

  /// Goes along the step as far as it pays; returns the next step's trust. All curves on the way are monotonic and
  /// within the limits if both ends are: these are convex.
  double follow(const std::vector<double>& better, double trust) {
    for (double share = 1.0; share > 0.01; share /= 2.0) {
      HarmonicCurve next(program_.coefficients());
      for (std::size_t c = 0; c < next.size(); ++c) next[c] = std::lerp(curve_[c], better[c], share);
      Judged outcome = judge(next);
      if (!(outcome.merit < judged_.merit)) continue;
      const bool worthwhile = judged_.merit - outcome.merit > worth * judged_.merit;
      curve_ = std::move(next);
      judged_ = std::move(outcome);
      keep();
      if (share == 1.0) return worthwhile ? 2.0 * trust : trust / 4.0;
      return trust * (share == 0.5 ? 0.7 : 0.35);
    }
    return trust / 4.0;
  }

  /// Remembers the best curve that can be played as it is.
  void keep() {
    const double tolerated_late = turn * tolerated_late_s / task_.period_s;
    const bool playable = judged_.merit < std::numeric_limits<double>::infinity() && judged_.late <= tolerated_late &&
                          judged_.over_a == 0.0 && judged_.over_d <= tolerated_over_d;
    if (!playable || !(judged_.smear_d < best_smear_d_)) return;
    best_ = curve_;
    best_smear_d_ = judged_.smear_d;
  }

  const ShapeTask& task_;
  const std::optional<DriveTask>& drive_;
  ShapeProgram program_;
  HarmonicCurve curve_;
  Judged judged_;
  std::optional<HarmonicCurve> best_;
  double best_smear_d_ = std::numeric_limits<double>::infinity();
};

}  // namespace

std::optional<HarmonicCurve> shape_curve(const ShapeTask& task, const std::optional<DriveTask>& drive) {
  return Search(task, drive).run();
}

}  // namespace focalstage
