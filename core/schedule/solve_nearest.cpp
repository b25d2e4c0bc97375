#include "core/schedule/solve_nearest.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>

#include "core/schedule/slots.h"

namespace focalstage {
namespace {

using Change = NearestSetting::Change;

/// The largest share of [0, 1] for which `try_at` has an answer, to a thousandth, and that answer; nothing where even 0
/// has none. Answers below a share that has one are taken to exist.
template <class Answer>
std::optional<std::pair<double, Answer>> largest(const std::function<std::optional<Answer>(double)>& try_at) {
  if (auto all = try_at(1.0)) return std::pair{1.0, *std::move(all)};
  auto found = try_at(0.0);
  if (!found) return std::nullopt;
  double low = 0.0;
  double high = 1.0;
  while (high - low > 1e-3) {
    const double middle = (low + high) / 2.0;
    if (auto better = try_at(middle)) {
      low = middle;
      found = std::move(better);
    } else {
      high = middle;
    }
  }
  return std::pair{low, *std::move(found)};
}

/// Whole microseconds, so that the file stays readable.
double whole_us(double time_s) { return std::floor(time_s * 1e6 + 1e-6) / 1e6; }

/// Exposures as long as can be: shorter ones cost light. The projector shows them as often as it must.
std::optional<NearestSetting> shorter_exposure(const SolveTerms& terms, std::span<const ProjectorModelData> models,
                                               Budget& budget) {
  const Projector& projector = terms.project.projectors.front();
  const ProjectorModelData* model = find_model(models, projector.model);
  const auto fastest = model == nullptr ? std::nullopt : fastest_rate(*model, projector.bits, projector.color);
  if (!fastest) return std::nullopt;  // nobody knows what it can do
  const double now_s = slot_pitch_s(projector);
  const double shown_s = *least_exposure_ms(*model, projector.bits, projector.color) / 1000.0;
  const double least_s = std::ceil(1e6 * std::max(1.0 / *fastest, shown_s) - 1e-6) / 1e6;
  if (!(least_s < now_s)) return std::nullopt;

  const std::function<std::optional<SolvedRig>(double)> try_at = [&](double share) {
    SolveTerms loose = terms;
    Projector& own = loose.project.projectors.front();
    const double wanted_s = std::max(least_s, whole_us(least_s + share * (now_s - least_s)));
    if (wanted_s < exposure_s(projector)) own.exposure_ms = std::round(wanted_s * 1e6) / 1000.0;
    own.frames_per_second = std::max(projector.frames_per_second, std::floor(1.0 / wanted_s));
    return attempt(loose, budget);
  };
  const auto found = largest(try_at);
  if (!found) return std::nullopt;
  const SolvedRig& rig = found->second;
  const double then_s = slot_pitch_s(with_rig(terms.project, rig).projectors.front());
  return NearestSetting{Change::exposure, now_s, then_s, 0.0, 0.0, rig};
}

/// Slices farther apart, up to where the rules make it an error.
std::optional<NearestSetting> wider_spacing(const SolveTerms& terms, Budget& budget) {
  if (!(terms.spacing_d < most_spacing_d)) return std::nullopt;
  for (double spacing_d = std::floor(terms.spacing_d * 20.0 + 1.0) / 20.0; spacing_d <= most_spacing_d + 1e-9;
       spacing_d += 0.05) {
    SolveTerms loose = terms;
    loose.spacing_d = spacing_d;
    if (const auto rig = attempt(loose, budget)) {
      return NearestSetting{Change::spacing, terms.spacing_d, spacing_d, 0.0, 0.0, *rig};
    }
  }
  return std::nullopt;
}

/// The nearest number of slices that has an answer: the fewest where too few were asked for, else the most.
std::optional<NearestSetting> other_count(const SolveTerms& terms, Budget& budget) {
  if (!terms.count) return std::nullopt;
  const auto try_count = [&](std::optional<int> count) {
    SolveTerms loose = terms;
    loose.count = count;
    const double even_d = (terms.highest_d() - terms.lowest_d()) / std::max(1, count.value_or(most_solved_slices) - 1);
    if (even_d > good_spacing_d) loose.spacing_d = std::max(terms.spacing_d, most_spacing_d);
    return attempt(loose, budget);
  };
  auto fewest = try_count(std::nullopt);
  if (!fewest) return std::nullopt;
  const auto setting = [&](int count, const SolvedRig& rig) {
    return NearestSetting{Change::slices, static_cast<double>(*terms.count), static_cast<double>(count), 0.0, 0.0, rig};
  };
  int low = static_cast<int>(fewest->powers_d.size());
  std::optional<SolvedRig> found;
  if (low > *terms.count) {
    for (int count = *terms.count + 1; count < low && !budget.spent(); ++count) {
      if ((found = try_count(count))) return setting(count, *found);
    }
    return setting(low, *fewest);
  }
  for (int high = *terms.count; high - low > 1 && !budget.spent();) {
    const int middle = (low + high) / 2;
    if (auto more = try_count(middle)) {
      low = middle;
      found = std::move(more);
    } else {
      high = middle;
    }
  }
  if (!found && low == *terms.count) return std::nullopt;
  return setting(low, found ? *found : *fewest);
}

struct Cut {
  double low_d;
  double high_d;
  PowerHistogram needs;
  SolvedRig rig;
};

PowerHistogram needs_within(const PowerHistogram& all, double low_d, double high_d) {
  PowerHistogram within;
  for (const PowerHistogram::Cell& cell : all.cells()) {
    if (cell.power_d >= low_d - 1e-9 && cell.power_d <= high_d + 1e-9) within.add(cell.power_d, cell.weight);
  }
  return within;
}

/// The power in the middle of the picture: half of it needs less, half more.
double middle_need_d(const PowerHistogram& needs) {
  const std::uint64_t half = needs.weight() / 2;
  std::uint64_t seen = 0;
  for (const PowerHistogram::Cell& cell : needs.cells()) {
    seen += cell.weight;
    if (seen > half) return cell.power_d;
  }
  return needs.highest_d();
}

/// A narrower range about the middle of the picture, grown on each side as far as it goes.
std::optional<NearestSetting> narrower_range(const SolveTerms& terms, Budget& budget) {
  if (terms.needs.empty()) return std::nullopt;
  const auto try_range = [&](double low_d, double high_d) -> std::optional<Cut> {
    SolveTerms loose = terms;
    loose.needs = needs_within(terms.needs, low_d, high_d);
    if (loose.needs.empty()) return std::nullopt;
    auto rig = attempt(loose, budget);
    if (!rig) return std::nullopt;
    return Cut{low_d, high_d, std::move(loose.needs), *std::move(rig)};
  };
  const double low_d = terms.needs.lowest_d();
  const double high_d = terms.needs.highest_d();
  const auto grow = [&](const Cut& from, bool down) {
    const std::function<std::optional<Cut>(double)> further = [&](double share) {
      return try_range(down ? std::lerp(from.low_d, low_d, share) : from.low_d,
                       down ? from.high_d : std::lerp(from.high_d, high_d, share));
    };
    auto grown = largest(further);
    return grown ? std::move(grown->second) : from;
  };
  std::optional<Cut> best;
  const auto keep_better = [&](const std::optional<Cut>& cut) {
    if (cut && (!best || cut->needs.weight() > best->needs.weight())) best = cut;
  };
  // About the middle of the picture, or, where the rig cannot show that, about what it shows best: no power at all.
  for (const double middle_d : {middle_need_d(terms.needs), std::clamp(0.0, low_d, high_d)}) {
    // Only one side cut, then both alike: what one side gains the other may lose.
    if (const auto upper = try_range(middle_d, high_d)) keep_better(grow(*upper, true));
    if (const auto lower = try_range(low_d, middle_d)) keep_better(grow(*lower, false));
    const std::function<std::optional<Cut>(double)> both = [&](double share) {
      return try_range(std::lerp(middle_d, low_d, share), std::lerp(middle_d, high_d, share));
    };
    if (const auto alike = largest(both)) {
      keep_better(grow(grow(alike->second, true), false));
      keep_better(grow(grow(alike->second, false), true));
    }
    if (best) break;
  }
  if (!best) return std::nullopt;
  const double share = static_cast<double>(best->needs.weight()) / static_cast<double>(terms.needs.weight());
  return NearestSetting{Change::range, 1.0, share, best->needs.lowest_d(), best->needs.highest_d(), best->rig};
}

}  // namespace

std::vector<NearestSetting> nearest_settings(const SolveTerms& terms, std::span<const ProjectorModelData> models,
                                             Budget& budget) {
  std::vector<NearestSetting> settings;
  const auto add = [&](std::optional<NearestSetting> setting) {
    if (setting && !budget.spent()) settings.push_back(*std::move(setting));
  };
  add(shorter_exposure(terms, models, budget));
  add(wider_spacing(terms, budget));
  add(other_count(terms, budget));
  add(narrower_range(terms, budget));
  return settings;
}

}  // namespace focalstage
