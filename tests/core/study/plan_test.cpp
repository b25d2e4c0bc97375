#include "core/study/plan.h"

#include <algorithm>
#include <map>
#include <set>

#include <doctest/doctest.h>

#include "a_study.h"
#include "core/study/williams.h"

using namespace focalstage;

namespace {

/// The targets of one pass in order; training is pass 0.
std::vector<int> targets_of_pass(const TrialBlock& block, int repetition) {
  std::vector<int> targets;
  for (const Trial& trial : block.trials) {
    if (trial.repetition == repetition) targets.push_back(trial.target);
  }
  return targets;
}

Study study_of(int conditions, int targets, int participants) {
  Study study = paper_study();
  study.conditions.resize(1);
  study.targets.clear();
  study.participants.clear();
  for (int k = 1; k < conditions; ++k) {
    study.conditions.push_back({"c" + std::to_string(k), "p", "", ConditionVariant::conventional});
  }
  for (int k = 0; k < targets; ++k) {
    study.targets.push_back({"t" + std::to_string(k), "t" + std::to_string(k), -1, 0.3 + 0.01 * k});
  }
  for (int k = 0; k < participants; ++k) study.participants.push_back("P" + std::to_string(k));
  return study;
}

const TrialBlock& block_of(const std::vector<TrialBlock>& plan, int condition) {
  return *std::ranges::find(plan, condition, &TrialBlock::condition);
}

/// How often each target stands at each place, and each follows each other one, in pass `repetition` under `condition`.
struct Counts {
  std::map<std::pair<int, int>, int> place;
  std::map<std::pair<int, int>, int> follows;
};

Counts counts_of(const Study& study, int condition, int repetition, int first_participant, int step) {
  Counts counts;
  for (int p = first_participant; p < static_cast<int>(study.participants.size()); p += step) {
    const std::vector<int> targets = targets_of_pass(block_of(plan_of(study, p), condition), repetition);
    for (int i = 0; i < static_cast<int>(targets.size()); ++i) {
      ++counts.place[{i, targets[static_cast<std::size_t>(i)]}];
      if (i > 0) ++counts.follows[{targets[static_cast<std::size_t>(i - 1)], targets[static_cast<std::size_t>(i)]}];
    }
  }
  return counts;
}

template <class Map>
bool all_are(const Map& map, std::size_t entries, int count) {
  return map.size() == entries && std::ranges::all_of(map, [&](const auto& entry) { return entry.second == count; });
}

}  // namespace

TEST_CASE("the paper's study: two blocks of 21 trials, training first, each target four times") {
  const Study study = paper_study();
  for (int p = 0; p < 10; ++p) {
    const std::vector<TrialBlock> plan = plan_of(study, p);
    REQUIRE(plan.size() == 2);
    // AB, BA, AB, ...
    CHECK(plan[0].condition == p % 2);
    CHECK(plan[1].condition == 1 - p % 2);
    for (const TrialBlock& block : plan) {
      REQUIRE(block.trials.size() == 21);
      CHECK(block.trials[0].training);
      for (std::size_t k = 0; k < 21; ++k) {
        CHECK(block.trials[k].number == static_cast<int>(k) + 1);
        CHECK(block.trials[k].training == (k == 0));
      }
      for (int pass = 1; pass <= 4; ++pass) {
        const std::vector<int> targets = targets_of_pass(block, pass);
        CHECK(std::set<int>(targets.begin(), targets.end()).size() == 5);
        CHECK(targets.size() == 5);
      }
    }
  }
}

TEST_CASE("over a full set each target stands and follows equally often, and never comes twice in a row") {
  for (const auto& [conditions, targets] : {std::pair{2, 5}, {2, 4}, {2, 2}, {2, 3}, {3, 5}, {4, 6}}) {
    CAPTURE(conditions);
    CAPTURE(targets);
    Study study = study_of(conditions, targets, 1);
    study = study_of(conditions, targets, full_set(study));
    const int people = full_set(study);
    for (const std::uint64_t seed : {1, 2, 3}) {
      study.seed = seed;
      const auto t = static_cast<std::size_t>(targets);
      for (int condition = 0; condition < conditions; ++condition) {
        for (int pass = 1; pass <= study.repetitions; ++pass) {
          const Counts counts = counts_of(study, condition, pass, 0, 1);
          CHECK(all_are(counts.place, t * t, people / targets));
          CHECK(all_are(counts.follows, t * (t - 1), people / targets));
        }
      }
      for (int p = 0; p < people; ++p) {
        for (const TrialBlock& block : plan_of(study, p)) {
          for (std::size_t k = 2; k < block.trials.size(); ++k) {
            CHECK(block.trials[k].target != block.trials[k - 1].target);
          }
        }
      }
    }
  }
}

TEST_CASE("with the paper's ten, each target stands at each place once in either order of the conditions") {
  const Study study = paper_study();
  CHECK(full_set(study) == 10);
  for (int order = 0; order < 2; ++order) {
    for (int condition = 0; condition < 2; ++condition) {
      for (int pass = 1; pass <= 4; ++pass) CHECK(all_are(counts_of(study, condition, pass, order, 2).place, 25, 1));
    }
  }
}

TEST_CASE("three conditions: every order stands at every place, and each follows each other equally often") {
  const Study study = study_of(3, 4, 24);
  std::map<std::pair<int, int>, int> place;
  std::map<std::pair<int, int>, int> follows;
  for (int p = 0; p < 24; ++p) {
    const auto plan = plan_of(study, p);
    for (int k = 0; k < 3; ++k) ++place[{k, plan[static_cast<std::size_t>(k)].condition}];
    for (std::size_t k = 1; k < 3; ++k) ++follows[{plan[k - 1].condition, plan[k].condition}];
  }
  CHECK(all_are(place, 9, 8));
  CHECK(all_are(follows, 6, 8));
}

TEST_CASE(
    "a plan is the same each time, another for another seed or participant, and untouched by those who join later") {
  Study study = paper_study();
  const std::vector<TrialBlock> plan = plan_of(study, 3);
  CHECK(plan == plan_of(study, 3));
  CHECK_FALSE(plan == plan_of(study, 5));
  study.participants.push_back("late");
  CHECK(plan == plan_of(study, 3));
  study.seed = 8;
  CHECK_FALSE(plan == plan_of(study, 3));
  // Fixed for good: answers of a study that is under way are held against it.
  study = paper_study();
  std::vector<int> first;
  const std::vector<TrialBlock> kept = plan_of(study, 0);
  for (const Trial& trial : kept[0].trials) first.push_back(trial.target);
  CHECK(first == std::vector<int>{2, 1, 2, 0, 3, 4, 1, 0, 2, 4, 3, 2, 3, 1, 4, 0, 3, 2, 4, 1, 0});
}

TEST_CASE("the pointer starts on its steps, within its range, at many places") {
  const Study study = paper_study();
  std::set<double> starts;
  for (int p = 0; p < 10; ++p) {
    for (const TrialBlock& block : plan_of(study, p)) {
      for (const Trial& trial : block.trials) {
        CHECK(trial.pointer_start_m >= 0.2);
        CHECK(trial.pointer_start_m <= 0.8);
        const double steps = (trial.pointer_start_m - 0.2) / 0.001;
        CHECK(steps == doctest::Approx(static_cast<int>(steps + 0.5)).epsilon(1e-6));
        starts.insert(trial.pointer_start_m);
      }
    }
  }
  CHECK(starts.size() > 200);
}

TEST_CASE("a Williams design of 5: two squares, one the mirror of the other") {
  const WilliamsDesign five(5);
  CHECK(five.rows() == 10);
  CHECK(five.row(0, 0) == std::vector{0, 1, 4, 2, 3});
  CHECK(five.row(0, 2) == std::vector{2, 3, 1, 4, 0});
  CHECK(five.row(1, 0) == std::vector{3, 2, 4, 1, 0});
  CHECK(WilliamsDesign(4).rows() == 4);
  CHECK(WilliamsDesign(4).row(0, 0) == std::vector{0, 1, 3, 2});
}
