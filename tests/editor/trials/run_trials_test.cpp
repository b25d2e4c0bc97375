#include "editor/trials/run_trials.h"

#include <algorithm>
#include <set>

#include <doctest/doctest.h>

#include "editor/trials/faults.h"
#include "tests/core/study/a_study.h"
#include "tests/support/temporary_folder.h"

using namespace focalstage;

namespace {

/// A rig that counts what is asked of it and fails where it is told to.
class FakeRig final : public TrialRig {
 public:
  explicit FakeRig(int fails_at, std::string code = "rig.unreachable") : fails_at_(fails_at), code_(std::move(code)) {}

  Status connect(bool lift) override {
    if (dark_latched && !lift) return Fault{"rig.dark", "rig", "was blacked out", ""};
    dark_latched = false;
    lit = false;
    return step();
  }
  Status prepare(const ReadyCondition& condition, const std::stop_token&) override {
    CHECK_FALSE(lit);
    show_of = condition.sha256;
    return step();
  }
  Status show(const ShownTarget& target) override {
    if (Status done = step(); !done) return done;
    lit = true;
    shown = target;
    return {};
  }
  Status dark() override {
    const Status done = step();
    lit = false;
    return done;
  }
  Status check() override { return step(); }
  std::string kind() const override { return "fake"; }

  bool lit = false;
  bool dark_latched = false;
  ShownTarget shown;
  std::string show_of;
  int steps = 0;

 private:
  Status step() {
    if (++steps != fails_at_) return {};
    lit = false;
    dark_latched = code_ == "rig.dark";
    return Fault{code_, "rig", "failed as it was told to", ""};
  }

  int fails_at_;
  std::string code_;
};

/// Answers where it sees light, and says at which of its turns it pauses.
class FakePerson final : public TrialParticipant {
 public:
  explicit FakePerson(FakeRig& rig, int pauses_at = 0) : rig_(rig), pauses_at_(pauses_at) {}

  std::string kind() const override { return human_kind; }
  void begin_block(const std::vector<TrialBlock>&, const TrialBlock&) override {}
  void notice(const std::string&) override {}
  Result<TrialChoice> ready(const TrialInPlan&, const WhileWaiting& check) override {
    CHECK_FALSE(rig_.lit);
    if (Status good = check(); !good) return good.fault();
    return ++turns_ == pauses_at_ ? TrialChoice::pause : TrialChoice::go_on;
  }
  Result<TrialAnswer> answer(const TrialInPlan& at, const WhileWaiting& check) override {
    CHECK(rig_.lit);
    CHECK(rig_.shown.frame == at.trial.target);
    CHECK(rig_.show_of == std::to_string(at.block.condition));
    if (Status good = check(); !good) return good.fault();
    if (++turns_ == pauses_at_) return TrialAnswer{TrialAnswer::Kind::pause, 0.0};
    if (at.trial.number == 3) return TrialAnswer{TrialAnswer::Kind::gave_up, 0.0};
    return TrialAnswer{TrialAnswer::Kind::matched,
                       at.study.targets[static_cast<std::size_t>(at.trial.target)].actual_m};
  }
  Result<TrialChoice> trouble(const std::string& what) override {
    CHECK_FALSE(rig_.lit);
    troubles.push_back(what);
    return TrialChoice::go_on;
  }
  bool lifts_darkness() const override { return true; }
  Result<std::optional<bool>> question(const std::string&) override { return std::optional(true); }

  std::vector<std::string> troubles;

 private:
  FakeRig& rig_;
  int pauses_at_;
  int turns_ = 0;
};

Study short_study() {
  Study study = paper_study();
  study.repetitions = 1;
  return study;
}

Sitting sitting_of(const Study& study) {
  Sitting sitting{study, "P01", {}, false};
  for (const char* sha256 : {"0", "1"}) {
    ReadyCondition condition;
    condition.sha256 = sha256;
    for (int t = 0; t < 5; ++t) condition.targets.push_back({"cue", t});
    sitting.conditions.push_back(condition);
  }
  return sitting;
}

std::vector<Response> answered(const AnswerLog& log) {
  std::vector<Response> rows;
  std::ranges::copy_if(log.responses(), std::back_inserter(rows), [](const Response& r) { return r.spoiled.empty(); });
  return rows;
}

void check_whole(const Study& study, const AnswerLog& log) {
  const auto plan = plan_of(study, 0);
  const auto progress = progress_of(study, plan, log.responses());
  REQUIRE(progress);
  CHECK(progress->finished());
  CHECK(answered(log).size() == 12);
  for (const Response& row : answered(log)) CHECK(row.gave_up == (row.trial == 3));
}

}  // namespace

TEST_CASE("a sitting without trouble: every trial once, in order, dark in between, questions at the end") {
  const TemporaryFolder folder;
  const Study study = short_study();
  auto log = AnswerLog::open(folder.path(), study, "P01");
  REQUIRE(log);
  FakeRig rig(0);
  FakePerson person(rig);
  const auto end = run_trials(sitting_of(study), *log, rig, person, {});
  REQUIRE(end);
  CHECK(end->progress.finished());
  CHECK_FALSE(end->paused);
  CHECK(end->spoiled == 0);
  check_whole(study, *log);
  CHECK(log->responses().size() == 12);
  REQUIRE(log->questions().size() == 1);
  CHECK(log->questions()[0].yes);
  CHECK_FALSE(rig.lit);
  for (const Response& row : log->responses()) {
    CHECK(row.rig == "fake");
    CHECK(row.sitting == 1);
    CHECK(row.duration_s >= 0.0);
  }
}

TEST_CASE("whatever step the rig fails at, each trial counts once, and a trial that lost its light is marked") {
  const Study study = short_study();
  int steps = 0;
  {
    const TemporaryFolder folder;
    auto log = AnswerLog::open(folder.path(), study, "P01");
    FakeRig rig(0);
    FakePerson person(rig);
    REQUIRE(run_trials(sitting_of(study), *log, rig, person, {}));
    steps = rig.steps;
  }
  CHECK(steps > 60);
  for (const char* code : {"rig.unreachable", "rig.dark"}) {
    for (int fails_at = 1; fails_at <= steps; ++fails_at) {
      CAPTURE(code);
      CAPTURE(fails_at);
      const TemporaryFolder folder;
      auto log = AnswerLog::open(folder.path(), study, "P01");
      FakeRig rig(fails_at, code);
      FakePerson person(rig);
      const auto end = run_trials(sitting_of(study), *log, rig, person, {});
      const bool nothing_was_ready = fails_at <= 2 && std::string(code) == "rig.unreachable";
      CHECK(end.ok() == !nothing_was_ready);
      if (!end) {
        CHECK(end.fault().code == code);
        continue;
      }
      check_whole(study, *log);
      const auto spoiled = static_cast<int>(log->responses().size()) - 12;
      CHECK(spoiled == end->spoiled);
      CHECK(spoiled <= 1);
      CHECK(person.troubles.size() <= 1);
      if (spoiled == 1) CHECK(person.troubles.at(0).find("will be repeated") != std::string::npos);
      CHECK_FALSE(rig.lit);
    }
  }
}

TEST_CASE("paused at any turn and resumed: the same trials, the one that was seen marked as paused") {
  const Study study = short_study();
  for (int pauses_at = 1; pauses_at <= 24; ++pauses_at) {
    CAPTURE(pauses_at);
    const TemporaryFolder folder;
    auto log = AnswerLog::open(folder.path(), study, "P01");
    FakeRig rig(0);
    FakePerson person(rig, pauses_at);
    const auto end = run_trials(sitting_of(study), *log, rig, person, {});
    REQUIRE(end);
    CHECK(end->paused);
    CHECK(end->progress.done == (pauses_at - 1) / 2);
    CHECK(end->spoiled == (pauses_at % 2 == 0 ? 1 : 0));
    CHECK_FALSE(rig.lit);
    FakePerson again(rig);
    const auto rest = run_trials(sitting_of(study), *log, rig, again, {});
    REQUIRE(rest);
    check_whole(study, *log);
    CHECK(log->responses().back().sitting == (pauses_at == 1 ? 1 : 2));
  }
}

TEST_CASE("one block at a time; a finished participant has nothing to do") {
  const TemporaryFolder folder;
  const Study study = short_study();
  auto log = AnswerLog::open(folder.path(), study, "P01");
  FakeRig rig(0);
  FakePerson person(rig);
  Sitting sitting = sitting_of(study);
  sitting.one_block = true;
  auto end = run_trials(sitting, *log, rig, person, {});
  REQUIRE(end);
  CHECK(end->progress.done == 6);
  CHECK(log->questions().empty());
  end = run_trials(sitting, *log, rig, person, {});
  REQUIRE(end);
  CHECK(end->progress.finished());
  CHECK(log->questions().size() == 1);
  const int before = rig.steps;
  end = run_trials(sitting, *log, rig, person, {});
  REQUIRE(end);
  CHECK(rig.steps == before + 1);  // dark, to be sure
  CHECK(log->questions().size() == 1);
}

TEST_CASE("shows that changed are refused, but for eyes another distance apart") {
  const Study study = short_study();
  const Sitting sitting = sitting_of(study);
  Response row;
  row.participant = "P02";
  row.condition = 1;
  row.show_sha256 = "1";
  CHECK(check_shows(study, sitting.conditions, {row}));
  row.show_sha256 = "0";
  CHECK(check_shows(study, sitting.conditions, {row}).fault().code == "study.show-differs");
  row.interpupillary_mm = 60.0;
  CHECK(check_shows(study, sitting.conditions, {row}));
}
