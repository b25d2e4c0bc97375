#include "core/schedule/solve_attempt.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/optics/image_plan.h"
#include "core/schedule/place_powers.h"
#include "core/schedule/shown_powers.h"
#include "core/schedule/slots.h"
#include "core/schedule/smallest_sweep.h"

namespace focalstage {
namespace {

constexpr double tolerance_d = 1e-9;
constexpr double tolerance_s = 1e-9;
constexpr double trim_step_d = 0.05;
constexpr std::uint64_t steps_per_candidate = 100;  ///< what timing one takes

double on_grid(double power_d) { return std::round(power_d * need_cells_per_d) / need_cells_per_d; }

bool lit(const Surface& surface) { return !surface.hidden && surface.illumination > 0.0; }

PowerSpan span_of(const std::vector<double>& powers_d, bool light) {
  const auto [low, high] = std::minmax_element(powers_d.begin(), powers_d.end());
  const PowerSpan span{*low, *high};
  return light ? PowerSpan{std::min(span.low_d, 0.0), std::max(span.high_d, 0.0)} : span;
}

bool set_sweep(Project& project, const PowerSpan& span) {
  if (!sweep_is_free(project.sweep)) return true;
  const std::optional<PowerSpan> sweep = smallest_sweep(project, span);
  if (!sweep) return false;
  project.sweep.min_power_d = sweep->low_d;
  project.sweep.max_power_d = sweep->high_d;
  return true;
}

/// Powers that slices may have, from `low_d` to `high_d`.
std::vector<double> candidates(const SolveTerms& terms, double low_d, double high_d) {
  std::vector<double> all = terms.pinned_d;
  const auto first = static_cast<int>(std::lround(low_d * need_cells_per_d));
  const auto last = static_cast<int>(std::lround(high_d * need_cells_per_d));
  for (int i = first; i <= last; ++i) all.push_back(static_cast<double>(i) / need_cells_per_d);
  if (terms.count && !terms.needs.empty()) {
    for (const double power_d : uniform_powers(terms.needs, *terms.count)) {
      if (power_d >= low_d && power_d <= high_d) all.push_back(power_d);
    }
  }
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

/// The rules of one attempt for powers whose sweep is known.
class Attempt {
 public:
  Attempt(const SolveTerms& terms, double trim_d) : terms_(terms), trim_d_(trim_d) {
    pinned_d_ = terms.pinned_d;
    std::sort(pinned_d_.begin(), pinned_d_.end());
  }

  std::optional<SolvedRig> run(Budget& budget) {
    double low_d = terms_.lowest_d() + trim_d_;
    double high_d = terms_.highest_d() - trim_d_;
    if (low_d > high_d) low_d = high_d = on_grid((low_d + high_d) / 2.0);
    Project project = terms_.project;
    std::vector<double> powers_d = candidates(terms_, low_d, high_d);
    if (!set_sweep(project, span_of(powers_d, terms_.light()))) return std::nullopt;
    if (!budget.spend(steps_per_candidate * powers_d.size())) return std::nullopt;
    take_usable(project, std::move(powers_d));
    if (terms_.light() && !zero_) return std::nullopt;
    const auto placed = place_powers(terms_.needs, rules(), terms_.count, budget);
    if (!placed) return std::nullopt;
    return rig_of(project, *placed);
  }

 private:
  double pitch_s() const { return terms_.pitch_s.value_or(slot_pitch_s(terms_.project.projectors.front())); }

  /// Keeps the powers that can be shown at all, and finds the light's exposure among them.
  void take_usable(const Project& project, std::vector<double> powers_d) {
    light_alone_ = terms_.light() && !std::binary_search(powers_d.begin(), powers_d.end(), 0.0);
    if (light_alone_) powers_d.insert(std::upper_bound(powers_d.begin(), powers_d.end(), 0.0), 0.0);
    const ShownPowers shown(project, powers_d);
    for (std::size_t i = 0; i < powers_d.size(); ++i) {
      if (!shown.whole(i) || shown.smear_d(i) > terms_.smear_d + tolerance_d) continue;
      if (terms_.light() && powers_d[i] == 0.0) zero_ = usable_.size();
      usable_.push_back(powers_d[i]);
    }
    shown_.emplace(project, usable_);
  }

  bool apart(std::size_t i, std::size_t j) const { return shown_->apart_s(i, j) >= pitch_s() - tolerance_s; }

  /// Whether the slice is followed in time by the other eye's same slice soon enough; the light's own exposure may lie
  /// between.
  bool starts(std::size_t i) const {
    const bool light_first = zero_ && usable_[i] > 0.0;
    if (light_first && !apart(*zero_, i)) return false;
    return shown_->wrap_s(light_first ? *zero_ : i) >= pitch_s() - tolerance_s;
  }
  bool ends(std::size_t i) const {
    const bool light_last = zero_ && usable_[i] < 0.0;
    if (light_last && !apart(*zero_, i)) return false;
    return shown_->handover_s(light_last ? *zero_ : i) >= pitch_s() - tolerance_s;
  }
  bool follows(std::size_t i, std::size_t j) const {
    const bool light_between = zero_ && usable_[i] < 0.0 && usable_[j] > 0.0;
    return light_between ? apart(i, *zero_) && apart(*zero_, j) : apart(i, j);
  }

  bool pinned_between(double low_d, double high_d) const {
    const auto above = std::upper_bound(pinned_d_.begin(), pinned_d_.end(), low_d);
    return above != pinned_d_.end() && *above < high_d;
  }
  bool needed_between(double low_d, double high_d) const {
    const auto above = [](double limit_d, const PowerHistogram::Cell& cell) { return limit_d < cell.power_d; };
    const auto next = std::upper_bound(cells_.begin(), cells_.end(), low_d + tolerance_d, above);
    return next != cells_.end() && next->power_d < high_d - tolerance_d;
  }

  /// How far a need may lie beyond the outermost slice.
  double allowed_beyond_d() const {
    if (terms_.count) return most_beyond_slices_d;
    if (terms_.max_error_d) return std::min(most_beyond_slices_d, *terms_.max_error_d);
    return trim_d_;
  }

  PlacementRules rules() {
    cells_ = terms_.needs.cells();
    const double first_d = terms_.lowest_d() + allowed_beyond_d() + tolerance_d;
    const double last_d = terms_.highest_d() - allowed_beyond_d() - tolerance_d;
    const double far_d = std::numeric_limits<double>::infinity();
    PlacementRules rules;
    rules.candidates_d = usable_;
    rules.widest_gap_d = terms_.spacing_d;
    rules.first = [this, first_d, far_d](std::size_t i) {
      return usable_[i] <= first_d && slice(i) && !pinned_between(-far_d, usable_[i]) && starts(i);
    };
    rules.last = [this, last_d, far_d](std::size_t i) {
      return usable_[i] >= last_d && !pinned_between(usable_[i], far_d) && ends(i);
    };
    rules.next = [this](std::size_t i, std::size_t j) {
      if (!slice(i) || !slice(j) || !follows(i, j) || pinned_between(usable_[i], usable_[j])) return false;
      if (!terms_.max_error_d) return true;
      return !needed_between(usable_[i] + *terms_.max_error_d, usable_[j] - *terms_.max_error_d);
    };
    return rules;
  }

  /// Whether a slice may lie there; zero may be for the light alone.
  bool slice(std::size_t i) const { return !(light_alone_ && zero_ == i); }

  /// The rig of these powers, if the scheduler has no trouble with it.
  std::optional<SolvedRig> rig_of(Project project, const std::vector<double>& powers_d) const {
    project.slices.powers_d = powers_d;
    if (!set_sweep(project, span_of(powers_d, terms_.light()))) return std::nullopt;
    const Timing timing = time_slots(project, image_plan(project));
    for (const SlotTrouble& trouble : timing.troubles) {
      const bool loosened = (trouble.kind == SlotTrouble::Kind::smear && terms_.smear_d > most_smear_d) ||
                            (trouble.kind == SlotTrouble::Kind::overlap && terms_.pitch_s);
      if (!loosened) return std::nullopt;
    }
    SolvedRig rig;
    rig.powers_d = powers_d;
    rig.min_power_d = project.sweep.min_power_d;
    rig.max_power_d = project.sweep.max_power_d;
    rig.frames_per_second = project.projectors.front().frames_per_second;
    rig.exposure_ms = project.projectors.front().exposure_ms;
    for (std::size_t n = 1; n < powers_d.size(); ++n) {
      rig.widest_gap_d = std::max(rig.widest_gap_d, powers_d[n] - powers_d[n - 1]);
    }
    for (std::size_t i = 0; i < timing.slots.size(); ++i) {
      rig.worst_smear_d = std::max(rig.worst_smear_d, timing.slots[i].smear_d);
      if (i == 0 || timing.slots[i].eye != timing.slots[i - 1].eye) continue;
      const double apart_s = timing.slots[i].start_s - timing.slots[i - 1].start_s;
      rig.tightest_s = rig.tightest_s > 0.0 ? std::min(rig.tightest_s, apart_s) : apart_s;
    }
    rig.beyond_d = std::max({0.0, powers_d.front() - terms_.lowest_d(), terms_.highest_d() - powers_d.back()});
    return rig;
  }

  const SolveTerms& terms_;
  double trim_d_;
  std::vector<double> pinned_d_;
  std::vector<PowerHistogram::Cell> cells_;
  std::vector<double> usable_;       ///< powers that can be shown, rising
  std::optional<std::size_t> zero_;  ///< the light's place among them
  bool light_alone_ = false;         ///< zero lies outside the needs: for light, not for a slice
  std::optional<ShownPowers> shown_;
};

}  // namespace

bool SolveTerms::light() const { return std::any_of(project.surfaces.begin(), project.surfaces.end(), lit); }

double SolveTerms::lowest_d() const {
  double lowest_d = needs.empty() ? std::numeric_limits<double>::infinity() : needs.lowest_d();
  for (const double power_d : pinned_d) lowest_d = std::min(lowest_d, power_d);
  return lowest_d;
}

double SolveTerms::highest_d() const {
  double highest_d = needs.empty() ? -std::numeric_limits<double>::infinity() : needs.highest_d();
  for (const double power_d : pinned_d) highest_d = std::max(highest_d, power_d);
  return highest_d;
}

std::optional<SolvedRig> attempt(const SolveTerms& terms, Budget& budget) {
  for (double trim_d = 0.0; trim_d < most_beyond_slices_d + trim_step_d; trim_d += trim_step_d) {
    const auto rig = Attempt(terms, std::min(trim_d, most_beyond_slices_d)).run(budget);
    if (rig || budget.spent()) return rig;
  }
  return std::nullopt;
}

Project with_rig(const Project& project, const SolvedRig& rig) {
  Project solved = project;
  solved.slices.powers_d = rig.powers_d;
  solved.sweep.min_power_d = rig.min_power_d;
  solved.sweep.max_power_d = rig.max_power_d;
  solved.projectors.front().frames_per_second = rig.frames_per_second;
  solved.projectors.front().exposure_ms = rig.exposure_ms;
  return solved;
}

}  // namespace focalstage
