#include "core/study/scripted.h"

#include <cmath>

#include <doctest/doctest.h>

#include "a_study.h"
#include "core/study/analysis.h"
#include "core/study/seeded.h"

using namespace focalstage;

namespace {

std::vector<Response> answers_of(const Study& study, const std::string& name) {
  const auto scripted = ScriptedParticipant::named(name);
  REQUIRE(scripted);
  std::vector<Response> responses;
  for (int p = 0; p < static_cast<int>(study.participants.size()); ++p) {
    const std::string& who = study.participants[static_cast<std::size_t>(p)];
    for (const TrialBlock& block : plan_of(study, p)) {
      for (const Trial& trial : block.trials) {
        const auto answer = scripted->answer(study, who, block, trial);
        CHECK(answer == scripted->answer(study, who, block, trial));
        Response response;
        response.participant = who;
        response.condition = block.condition;
        response.training = trial.training;
        response.target = trial.target;
        response.repetition = trial.repetition;
        response.gave_up = !answer;
        response.response_m = answer.value_or(0.0);
        responses.push_back(response);
      }
    }
  }
  return responses;
}

}  // namespace

TEST_CASE("biased: the conventional condition is 25 mm farther, and the tests find it") {
  const Study study = paper_study();
  const StudyAnalysis analysis = analyse(study, answers_of(study, "biased"));
  REQUIRE(analysis.regression);
  // Means of four answers with 10 mm noise, 50 of them: a standard error of 0.7 mm.
  CHECK(std::abs(analysis.by_condition[0].error.mean_m) < 0.003);
  CHECK(std::abs(analysis.by_condition[1].error.mean_m - 0.025) < 0.003);
  CHECK(analysis.regression->intercepts->p < 1e-6);
  CHECK(analysis.regression->slopes->p > 0.01);
  CHECK(analysis.anova->condition->p < 1e-6);
}

TEST_CASE("exact answers exactly; gives-up gives up every seventh") {
  const Study study = paper_study();
  for (const Response& response : answers_of(study, "exact")) {
    CHECK(response.response_m == study.targets[static_cast<std::size_t>(response.target)].actual_m);
  }
  int given_up = 0;
  for (const Response& response : answers_of(study, "gives-up")) given_up += response.gave_up;
  CHECK(given_up == 10 * 2 * 3);
  CHECK(ScriptedParticipant::named("lazy").fault().code == "study.scripted");
}

TEST_CASE("chance: fixed numbers, even shares, a normal spread") {
  // The 10000th number of mt19937_64 from its default seed is fixed by the C++ standard; ours is the same engine.
  Seeded plain(5489);
  std::uint64_t last = 0;
  for (int k = 0; k < 10000; ++k) last = plain.below(std::uint64_t{1} << 63);
  CHECK(last == (9981545732273789042ull & ((std::uint64_t{1} << 63) - 1)));
  Seeded chance(3, "test");
  std::vector<int> counts(5);
  double sum = 0.0;
  double squares = 0.0;
  for (int k = 0; k < 10000; ++k) {
    ++counts[chance.below(5)];
    const double g = chance.gaussian();
    sum += g;
    squares += g * g;
  }
  for (const int count : counts) CHECK(std::abs(count - 2000) < 200);
  CHECK(std::abs(sum / 10000) < 0.04);
  CHECK(squares / 10000 == doctest::Approx(1.0).epsilon(0.05));
  CHECK(Seeded(3, "a").below(1u << 30) != Seeded(3, "b").below(1u << 30));
}
