#include "core/study/plan.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/study/seeded.h"
#include "core/study/williams.h"

namespace focalstage {
namespace {

/// Where in the targets' design a pass begins; the participants step on from there.
struct PassStart {
  int square = 0;
  int line = 0;
};

/// The place of a participant in both designs: its order of conditions, and how many with that order came before.
struct Place {
  int order = 0;
  int line = 0;
  int square = 0;
};

Place place_of(const Study& study, int participant) {
  const int orders = WilliamsDesign(static_cast<int>(study.conditions.size())).rows();
  const int targets = static_cast<int>(study.targets.size());
  const int before = participant / orders;
  // With two squares, neighbouring orders of conditions begin with different ones and change over after each round.
  return {participant % orders, before % targets, participant % orders + before / targets};
}

bool joins(const WilliamsDesign& design, PassStart first, PassStart then) {
  for (int square = 0; square < design.squares(); ++square) {
    for (int line = 0; line < design.treatments(); ++line) {
      const auto ends = design.row(square + first.square, line + first.line).back();
      if (ends == design.row(square + then.square, line + then.line).front()) return false;
    }
  }
  return true;
}

/// Starts of all passes of a block: those not used yet first, and none after which a target would be repeated at once
/// for anybody. There always is one: the start before (a row never ends as it begins).
std::vector<PassStart> pass_starts(const WilliamsDesign& design, int passes, Seeded& chance) {
  std::vector<PassStart> starts;
  std::vector<int> candidates;
  while (static_cast<int>(starts.size()) < passes) {
    if (candidates.empty()) candidates = shuffled_indices(design.rows(), chance);
    const auto start_of = [&](int row) { return PassStart{row / design.treatments(), row % design.treatments()}; };
    const auto fits = [&](int row) { return starts.empty() || joins(design, starts.back(), start_of(row)); };
    const auto chosen = std::ranges::find_if(candidates, fits);
    if (chosen == candidates.end()) {
      candidates.clear();
      continue;
    }
    starts.push_back(start_of(*chosen));
    candidates.erase(chosen);
  }
  return starts;
}

/// To the nanometre, so that tables show the step's decimals and no more.
double pointer_start(const StudyPointer& pointer, Seeded& chance) {
  const auto steps = static_cast<std::uint64_t>(std::floor((pointer.to_m - pointer.from_m) / pointer.step_m + 1e-9));
  const double start_m = pointer.from_m + static_cast<double>(chance.below(steps + 1)) * pointer.step_m;
  return std::clamp(std::round(start_m * 1e9) / 1e9, pointer.from_m, pointer.to_m);
}

}  // namespace

int full_set(const Study& study) {
  const int orders = WilliamsDesign(static_cast<int>(study.conditions.size())).rows();
  const WilliamsDesign targets(static_cast<int>(study.targets.size()));
  const int rounds = orders % targets.squares() == 0 ? 1 : targets.squares();
  return orders * targets.treatments() * rounds;
}

std::vector<TrialBlock> plan_of(const Study& study, int participant) {
  const WilliamsDesign design(static_cast<int>(study.targets.size()));
  const Place place = place_of(study, participant);
  const WilliamsDesign orders(static_cast<int>(study.conditions.size()));
  const std::vector<int> order = orders.row(place.order / orders.treatments(), place.order % orders.treatments());

  Seeded naming(study.seed, "targets");
  const std::vector<int> target_of = shuffled_indices(design.treatments(), naming);

  std::vector<TrialBlock> blocks;
  for (const int condition : order) {
    const std::string& name = study.conditions[static_cast<std::size_t>(condition)].name;
    Seeded passes(study.seed, "passes " + name);
    const std::string who = study.participants[static_cast<std::size_t>(participant)];
    Seeded own(study.seed, "participant " + who + " " + name);
    TrialBlock block{static_cast<int>(blocks.size()) + 1, condition, {}};
    const auto add = [&](bool training, int target, int repetition) {
      block.trials.push_back(
          {static_cast<int>(block.trials.size()) + 1, training, target, repetition, pointer_start(study.pointer, own)});
    };
    for (int k = 0; k < study.training_trials; ++k) {
      add(true, static_cast<int>(own.below(static_cast<std::uint64_t>(design.treatments()))), 0);
    }
    int repetition = 0;
    for (const PassStart& start : pass_starts(design, study.repetitions, passes)) {
      ++repetition;
      for (const int letter : design.row(place.square + start.square, place.line + start.line)) {
        add(false, target_of[static_cast<std::size_t>(letter)], repetition);
      }
    }
    blocks.push_back(std::move(block));
  }
  return blocks;
}

}  // namespace focalstage
