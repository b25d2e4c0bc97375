#include "core/study/study.h"

#include <functional>
#include <limits>

#include <doctest/doctest.h>

#include "a_study.h"

using namespace focalstage;

TEST_CASE("the paper's study is a study; what cannot be one names its place") {
  CHECK(check(paper_study()));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<std::pair<const char*, std::function<void(Study&)>>> wrongs{
      {"/participants", [](Study& s) { s.participants.clear(); }},
      {"/participants/1", [](Study& s) { s.participants[1] = "P01"; }},
      {"/participants/0", [](Study& s) { s.participants[0] = "../P01"; }},
      {"/participants/0", [](Study& s) { s.participants[0] = ""; }},
      {"/conditions", [](Study& s) { s.conditions.pop_back(); }},
      {"/conditions/1", [](Study& s) { s.conditions[1].name = "multifocal"; }},
      {"/conditions/0", [](Study& s) { s.conditions[0].show = "x.h5"; }},
      {"/conditions/0", [](Study& s) { s.conditions[0].project = ""; }},
      {"/conditions/0", [](Study& s) { s.conditions[0].name = "a,b"; }},
      {"/targets", [](Study& s) { s.targets.resize(1); }},
      {"/targets/2/actual_m", [](Study& s) { s.targets[2].actual_m = 300.0; }},
      {"/targets/2/actual_m", [nan](Study& s) { s.targets[2].actual_m = nan; }},
      {"/targets/2/actual_m", [](Study& s) { s.targets[2].actual_m = s.targets[0].actual_m; }},
      {"/targets/3", [](Study& s) { s.targets[3].frame = 3; }},
      {"/targets/3", [](Study& s) { s.targets[3].cue = ""; }},
      {"/targets/3", [](Study& s) { s.targets[3].name = "333 mm"; }},
      {"/repetitions", [](Study& s) { s.repetitions = 0; }},
      {"/training_trials", [](Study& s) { s.training_trials = -1; }},
      {"/pointer", [](Study& s) { s.pointer.to_m = 0.1; }},
      {"/pointer", [nan](Study& s) { s.pointer.from_m = nan; }},
      {"/pointer/step_m", [](Study& s) { s.pointer.step_m = 0.0; }},
      {"/pointer/step_m", [](Study& s) { s.pointer.step_m = 5.0; }},
      {"/questions/1", [](Study& s) { s.questions.push_back(s.questions[0]); }},
  };
  for (const auto& [where, spoil] : wrongs) {
    Study study = paper_study();
    spoil(study);
    const Status checked = check(study);
    CAPTURE(where);
    REQUIRE_FALSE(checked);
    CHECK(checked.fault().where == where);
    CHECK_FALSE(checked.fault().remedy.empty());
  }
}

TEST_CASE("participants are found by name") {
  CHECK(*participant_index(paper_study(), "P10") == 9);
  const auto nobody = participant_index(paper_study(), "P11");
  REQUIRE_FALSE(nobody);
  CHECK(nobody.fault().code == "study.participant");
}
