#include "io/study/answers.h"

#include <fstream>

#include <doctest/doctest.h>

#include "core/study/scripted.h"
#include "io/study/report.h"
#include "io/study/report_words.h"
#include "io/study/study_file.h"
#include "tests/core/study/a_study.h"
#include "tests/support/temporary_folder.h"

using namespace focalstage;

namespace {

Response scripted_response(const Study& study, const std::string& participant, const TrialBlock& block,
                           const Trial& trial, const ScriptedParticipant& script) {
  const auto answer = script.answer(study, participant, block, trial);
  Response response = response_to(study, block, trial);
  response.participant = participant;
  response.kind = scripted_prefix + script.name();
  response.gave_up = !answer;
  response.response_m = answer.value_or(0.0);
  response.sitting = 1;
  response.show_sha256 = std::string(64, block.condition == 0 ? 'a' : 'b');
  response.interpupillary_mm = 63.0;
  response.rig = "sim";
  return response;
}

/// Answers of one participant, up to `limit` trials.
void answer(const std::filesystem::path& folder, const Study& study, int index, const std::string& script_name,
            std::size_t limit = 1000) {
  const auto script = ScriptedParticipant::named(script_name);
  REQUIRE(script);
  const std::string participant = study.participants[static_cast<std::size_t>(index)];
  auto log = AnswerLog::open(folder, study, participant);
  REQUIRE(log);
  for (const TrialBlock& block : plan_of(study, index)) {
    for (const Trial& trial : block.trials) {
      if (limit-- == 0) return;
      REQUIRE(log->add(scripted_response(study, participant, block, trial, *script)));
    }
  }
  REQUIRE(log->add(QuestionAnswer{participant, scripted_prefix + script_name, 0, index == 1}));
}

}  // namespace

TEST_CASE("answers come back from their folder, in the study's order") {
  const TemporaryFolder folder;
  const Study study = paper_study();
  answer(folder.path(), study, 1, "noisy");
  answer(folder.path(), study, 0, "noisy");
  std::ofstream(folder / "visitor.csv") << "x\n";
  const auto answers = load_answers(folder.path());
  REQUIRE(answers);
  CHECK(answers->study == study);
  CHECK(answers->responses.size() == 84);
  CHECK(answers->responses.front().participant == "P01");
  CHECK(answers->questions.size() == 2);
  REQUIRE(answers->notes.size() == 1);
  CHECK(answers->notes[0].starts_with("visitor.csv"));
}

TEST_CASE("a folder is of one study, to which participants may only be added at the end") {
  const TemporaryFolder folder;
  Study study = paper_study();
  answer(folder.path(), study, 0, "noisy");
  study.participants.push_back("late");
  CHECK(AnswerLog::open(folder.path(), study, "late"));
  CHECK(load_study(folder.path())->study == study);
  Study other = study;
  other.seed = 99;
  CHECK(AnswerLog::open(folder.path(), other, "P02").fault().code == "study.other");
  other = study;
  other.participants[0] = "P00";
  CHECK(AnswerLog::open(folder.path(), other, "P02").fault().code == "study.other");
  CHECK(AnswerLog::open(folder.path(), study, "nobody").fault().code == "study.participant");
}

TEST_CASE("people and scripts in one folder are no data") {
  const TemporaryFolder folder;
  const Study study = paper_study();
  answer(folder.path(), study, 0, "noisy", 3);
  auto log = AnswerLog::open(folder.path(), study, "P02");
  REQUIRE(log);
  const auto plan = plan_of(study, 1);
  Response person = scripted_response(study, "P02", plan[0], plan[0].trials[0], *ScriptedParticipant::named("noisy"));
  person.kind = human_kind;
  REQUIRE(log->add(person));
  CHECK(load_answers(folder.path()).fault().code == "study.mixed");
}

TEST_CASE("the report says what was left out, what was scripted and on what rig") {
  const TemporaryFolder folder;
  const Study study = paper_study();
  for (int k = 0; k < 4; ++k) answer(folder.path(), study, k, "gives-up");
  answer(folder.path(), study, 4, "gives-up", 30);
  const StudyReport report = report_of(*load_answers(folder.path()));
  CHECK(report.scripted());
  const std::string text = report_markdown(report, "plot.svg");
  CHECK(text.find("no human result") < text.find("## "));
  CHECK(text.find("Left out, not finished: P05") != std::string::npos);
  CHECK(text.find("simulated") != std::string::npos);
  CHECK(text.find("| P01 | scripted:gives-up | 34 | 6 | 0 | 1 | yes |") != std::string::npos);
  CHECK(text.find("F(1,36) = ") != std::string::npos);  // 4 participants: 40 means
  CHECK(text.find("| flicker | Did you perceive any flicker? | 1 | 3 | 1 | P02 |") != std::string::npos);
  CHECK(text.find("](plot.svg)") != std::string::npos);
  const Value value = report_value(report);
  CHECK(*value.find("human")->boolean() == false);
  CHECK(value.find("left_out")->find("unfinished")->array()->size() == 1);
}

TEST_CASE("people's report has no such warning, and one without answers has no figures") {
  Answers answers;
  answers.study = paper_study();
  const StudyReport none = report_of(answers);
  CHECK_FALSE(none.scripted());
  const std::string text = report_markdown(none, "");
  CHECK(text.find("0 of 10 participants") != std::string::npos);
  CHECK(text.find("Not possible") != std::string::npos);
  CHECK(text.find("nan") == std::string::npos);
  CHECK(report_svg(none).find("<svg") == 0);
  const auto plan = plan_of(answers.study, 0);
  answers.responses = {
      scripted_response(answers.study, "P01", plan[0], plan[0].trials[1], *ScriptedParticipant::named("exact"))};
  answers.responses[0].kind = human_kind;
  const StudyReport person = report_of(answers);
  CHECK(report_markdown(person, "").find("no human result") == std::string::npos);
  CHECK(report_svg(person).find("scripted") == std::string::npos);
}

TEST_CASE("names cannot break tables or pictures") {
  Answers answers;
  answers.study = paper_study();
  answers.study.name = "A <b>|\n& C";
  CHECK(report_markdown(report_of(answers), "").starts_with("# A &lt;b&gt;&#124; &amp; C\n"));
  CHECK(report_svg(report_of(answers)).find("<b>") == std::string::npos);
}

TEST_CASE("words of numbers") {
  CHECK(p_text(0.64) == "p = 0.64");
  CHECK(p_text(0.0123) == "p = 0.012");
  CHECK(p_text(1e-9) == "p < 0.001");
  CHECK(mm_text(-0.00193) == "-1.93");
  CHECK(mm_text(-1e-9) == "0.00");
  CHECK(test_text(FTest{0.218, 1, 96, 0.64, 0.0}) == "F(1,96) = 0.218, p = 0.64");
}
