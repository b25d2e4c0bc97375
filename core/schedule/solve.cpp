#include "core/schedule/solve.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include "core/schedule/place_powers.h"
#include "core/schedule/slots.h"
#include "core/schedule/smallest_sweep.h"
#include "core/schedule/solve_attempt.h"
#include "core/schedule/solve_nearest.h"

namespace focalstage {
namespace {

using Limit = SolveTrouble::Limit;
constexpr double unlimited = 1e9;
static_assert(most_solved_slices == most_powers);

bool sensible(const SolveWishes& wishes) {
  const auto positive = [](const std::optional<double>& wish) {
    return !wish || (std::isfinite(*wish) && *wish > 0.0);
  };
  return positive(wishes.spacing_d) && positive(wishes.max_error_d) &&
         (!wishes.slices || (*wishes.slices >= 1 && *wishes.slices <= most_solved_slices));
}

bool sensible(const Project& project) {
  const Glasses& glasses = project.glasses;
  if (project.projectors.empty()) return false;
  const double exposure = exposure_s(project.projectors.front());
  const double pitch = slot_pitch_s(project.projectors.front());
  return std::isfinite(exposure) && exposure > 0.0 && std::isfinite(pitch) && std::isfinite(glasses.shutter_open_ms) &&
         std::isfinite(glasses.shutter_close_ms) && glasses.shutter_open_ms >= 0.0 && glasses.shutter_close_ms >= 0.0 &&
         glasses.lens_range_d[0] < glasses.lens_range_d[1];
}

/// What keeps anybody from even looking for an answer.
std::optional<SolveTrouble> obstacle(const Project& project, const Needs& needs, const SolveWishes& wishes) {
  if (!sensible(wishes) || !sensible(project)) return SolveTrouble{Limit::bad_project};
  const PerEye<Result<PowerCurve>> curves = power_curves(project.sweep);
  // A sine whose ends are wrong is what the solver mends; its frequency it cannot.
  const bool mendable =
      sweep_is_free(project.sweep) && std::isfinite(project.sweep.frequency_hz) && project.sweep.frequency_hz > 0.0;
  if (!mendable && (!curves.left || !curves.right)) return SolveTrouble{Limit::bad_waveform};

  const auto count = static_cast<int>(project.slices.powers_d.size());
  std::uint64_t looks = 0;
  std::uint64_t served = 0;
  for (const ObjectNeeds& object : needs.objects) {
    looks += object.looks;
    served += object.served();
    if (object.looks == 0 || !object.pinned_slice) continue;
    if (*object.pinned_slice < 0 || *object.pinned_slice >= count) {
      return SolveTrouble{Limit::pinned_slice, static_cast<double>(*object.pinned_slice), static_cast<double>(count),
                          object.index};
    }
  }
  if (looks == 0) return SolveTrouble{Limit::nothing_needed};
  if (served == 0) return SolveTrouble{Limit::unserved, 1.0, 0.0};
  return std::nullopt;
}

std::vector<double> pinned_powers(const Project& project, const Needs& needs) {
  std::vector<double> powers_d;
  for (const ObjectNeeds& object : needs.objects) {
    if (object.looks == 0 || !object.pinned_slice) continue;
    powers_d.push_back(project.slices.powers_d[static_cast<std::size_t>(*object.pinned_slice)]);
  }
  std::sort(powers_d.begin(), powers_d.end());
  powers_d.erase(std::unique(powers_d.begin(), powers_d.end()), powers_d.end());
  return powers_d;
}

SolveTerms terms_of(const Project& project, const Needs& needs, const SolveWishes& wishes) {
  SolveTerms terms{project, needs.all()};
  terms.pinned_d = pinned_powers(project, needs);
  terms.count = wishes.slices;
  terms.max_error_d = wishes.max_error_d;
  terms.smear_d = most_smear_d;
  if (wishes.spacing_d) {
    terms.spacing_d = *wishes.spacing_d;
  } else if (wishes.max_error_d) {
    terms.spacing_d = most_spacing_d;
  } else if (wishes.slices) {
    // So that even steps are among the choices wherever the rules allow them.
    const double even_d = (terms.highest_d() - terms.lowest_d()) / std::max(1, *wishes.slices - 1);
    terms.spacing_d = even_d <= good_spacing_d ? good_spacing_d : most_spacing_d;
  }
  return terms;
}

/// One limit loosened: what for, and what it would have taken.
struct Suspect {
  Limit limit;
  std::function<void(SolveTerms&)> loosen;
};

std::vector<Suspect> suspects() {
  return {{Limit::lens_range,
           [](SolveTerms& terms) {
             terms.project.glasses.lens_range_d = {-unlimited, unlimited};
           }},
          {Limit::smear, [](SolveTerms& terms) { terms.smear_d = unlimited; }},
          {Limit::overlap, [](SolveTerms& terms) { terms.pitch_s = 0.0; }},
          {Limit::spacing, [](SolveTerms& terms) { terms.spacing_d = 2.0 * farthest_need_d; }},
          {Limit::count, [](SolveTerms& terms) { terms.count.reset(); }}};
}

/// How much of a limit the rig takes that was found without it.
SolveTrouble measured(Limit limit, const SolveTerms& terms, const SolvedRig& rig) {
  const auto& [lens_min_d, lens_max_d] = terms.project.glasses.lens_range_d;
  switch (limit) {
    case Limit::lens_range: {
      const bool low = lens_min_d - rig.min_power_d > rig.max_power_d - lens_max_d;
      return {limit, low ? rig.min_power_d : rig.max_power_d, low ? lens_min_d : lens_max_d};
    }
    case Limit::smear:
      return {limit, rig.worst_smear_d, terms.smear_d};
    case Limit::overlap:
      return {limit, rig.tightest_s, slot_pitch_s(terms.project.projectors.front())};
    case Limit::spacing:
      return {limit, rig.widest_gap_d, terms.spacing_d};
    case Limit::count:
      return {limit, static_cast<double>(terms.count.value_or(0)), static_cast<double>(rig.powers_d.size())};
    default:
      return {limit};
  }
}

/// Who is to blame: each limit that is the only one in the way; else the fewest, in order, that are so together.
std::vector<SolveTrouble> blame(const SolveTerms& terms, Budget& budget) {
  std::vector<SolveTrouble> troubles;
  for (const Suspect& suspect : suspects()) {
    SolveTerms loose = terms;
    suspect.loosen(loose);
    if (const auto rig = attempt(loose, budget)) troubles.push_back(measured(suspect.limit, terms, *rig));
  }
  if (!troubles.empty()) return troubles;
  SolveTerms loose = terms;
  std::vector<Limit> together;
  for (const Suspect& suspect : suspects()) {
    suspect.loosen(loose);
    together.push_back(suspect.limit);
    const auto rig = attempt(loose, budget);
    if (!rig) continue;
    for (const Limit limit : together) {
      const SolveTrouble trouble = measured(limit, terms, *rig);
      const double over = limit == Limit::overlap ? trouble.allowed - trouble.amount : trouble.amount - trouble.allowed;
      const bool passed =
          limit == Limit::lens_range || limit == Limit::count ? trouble.amount != trouble.allowed : over > 0.0;
      if (passed) troubles.push_back(trouble);
    }
    return troubles;
  }
  return troubles;
}

/// A range so wide that even slices as far apart as can be do not cover it.
std::optional<SolveTrouble> wide_trouble(const SolveTerms& terms) {
  const double covered_d = terms.highest_d() - terms.lowest_d() - 2.0 * most_beyond_slices_d;
  const double least = std::ceil(covered_d / terms.spacing_d - 1e-9) + 1.0;
  const int most = terms.count.value_or(most_solved_slices);
  if (!(least > most)) return std::nullopt;
  return SolveTrouble{Limit::count, static_cast<double>(most), least};
}

/// Limits that no search is needed to see.
std::optional<SolveTrouble> plain_trouble(const SolveTerms& terms) {
  const Project& project = terms.project;
  const double half_s = 0.5 / project.sweep.frequency_hz;
  const double window_s = std::max(project.glasses.shutter_open_ms, project.glasses.shutter_close_ms) / 1000.0;
  const double taken_s = window_s + exposure_s(project.projectors.front());
  if (sweep_is_free(project.sweep)) {
    if (!(usable_share(project) > 0.01)) return SolveTrouble{Limit::dead_time, taken_s, half_s};
    return wide_trouble(terms);
  }
  const std::optional<PowerSpan> reach = reach_of(project);
  if (!reach) return SolveTrouble{Limit::dead_time, taken_s, half_s};
  const double low_d = std::min(terms.lowest_d() + most_beyond_slices_d, terms.light() ? 0.0 : unlimited);
  const double high_d = std::max(terms.highest_d() - most_beyond_slices_d, terms.light() ? 0.0 : -unlimited);
  const double below_d = reach->low_d - low_d;
  const double above_d = high_d - reach->high_d;
  if (below_d > 1e-9 && below_d >= above_d) return SolveTrouble{Limit::fixed_sweep, low_d, reach->low_d};
  if (above_d > 1e-9) return SolveTrouble{Limit::fixed_sweep, high_d, reach->high_d};
  return std::nullopt;
}

void explain(const SolveTerms& terms, std::span<const ProjectorModelData> models, Budget& budget, SolveResult& result) {
  if (const auto plain = plain_trouble(terms)) {
    result.troubles.push_back(*plain);
  } else if (!budget.spent()) {
    result.troubles = blame(terms, budget);
  }
  if (!budget.spent()) result.nearest = nearest_settings(terms, models, budget);
  if (budget.spent()) result.troubles.push_back({budget.stopped() ? Limit::stopped : Limit::gave_up});
  if (result.troubles.empty()) result.troubles.push_back({Limit::unknown});
}

PlacementError error_of(const PowerHistogram& needs, const std::vector<double>& powers_d) {
  if (needs.empty() || powers_d.empty()) return {};
  return {mean_error_d(needs, powers_d), worst_error_d(needs, powers_d)};
}

}  // namespace

SolveResult solve(const Project& project, const Needs& needs, const SolveWishes& wishes,
                  std::span<const ProjectorModelData> models, const SolveBounds& bounds) {
  SolveResult result;
  if (const auto trouble = obstacle(project, needs, wishes)) {
    result.troubles = {*trouble};
    return result;
  }
  Budget budget(bounds.steps, bounds.stop);
  const SolveTerms terms = terms_of(project, needs, wishes);
  result.lowest_need_d = terms.lowest_d();
  result.highest_need_d = terms.highest_d();
  result.before = error_of(terms.needs, project.slices.powers_d);
  result.rig = attempt(terms, budget);
  if (!result.rig) {
    explain(terms, models, budget, result);
    return result;
  }
  const auto count = static_cast<int>(result.rig->powers_d.size());
  result.after = error_of(terms.needs, result.rig->powers_d);
  if (!terms.needs.empty()) {
    result.uniform = error_of(terms.needs, uniform_powers(terms.needs, count));
    result.medians = error_of(terms.needs, k_medians(terms.needs, count));
  }
  return result;
}

}  // namespace focalstage
