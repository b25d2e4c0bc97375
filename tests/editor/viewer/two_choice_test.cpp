#include "editor/viewer/two_choice.h"

#include <doctest/doctest.h>

#include <fstream>

#include "tests/editor/viewer/viewer_room.h"
#include "tests/support/temporary_folder.h"

using namespace focalstage;

namespace {

/// Eleven levels in two shows, for somebody who sees them equal at 4.3.
TwoChoiceTest two_shows() {
  TwoChoiceTest test;
  test.shows = {{"a.h5", "aaaa", 63.0, {}}, {"b.h5", "bbbb", 63.0, {}}};
  for (int k = 0; k <= 10; ++k) {
    test.levels.push_back(k);
    test.stimuli.push_back({k < 5 ? std::size_t{0} : std::size_t{1}, {"level " + std::to_string(k), k}});
  }
  return test;
}

std::map<std::size_t, double> equal_at(double level) {
  std::map<std::size_t, double> seen;
  for (std::size_t k = 0; k <= 10; ++k) seen[k] = level - static_cast<double>(k);
  return seen;
}

/// Gives up, or is killed, after so many questions.
class Leaves final : public Observer {
 public:
  Leaves(Observer& other, int after) : other_(other), after_(after) {}
  std::string kind() const override { return other_.kind(); }
  Result<Choice> choose(int question, std::size_t level, const WhileWaiting& check) override {
    if (question >= after_) return Choice::give_up;
    return other_.choose(question, level, check);
  }

 private:
  Observer& other_;
  int after_;
};

}  // namespace

TEST_CASE("levels are shown one by one, each show is made ready when it is needed, and in the end it is dark") {
  const TwoChoiceTest test = two_shows();
  const auto seen = equal_at(4.3);
  PaperRig rig;
  ScriptedObserver observer = person(seen, 0.5, 3);
  int told = 0;
  TwoChoiceRun run;
  run.progress = [&](int answered, int of) {
    CHECK(answered == told++);
    CHECK(of == 40);
  };
  const auto found = run_two_choice(rig, test, observer, run);
  REQUIRE(found);
  REQUIRE(*found);
  CHECK(std::abs((*found)->value - 4.3) < 3.0 * (*found)->uncertainty);
  CHECK((*found)->answers == 40);
  CHECK(rig.shown == 40);
  CHECK(told == 40);
  CHECK_FALSE(rig.lit);
  for (std::size_t k = 1; k < rig.prepared.size(); ++k) CHECK(rig.prepared[k] != rig.prepared[k - 1]);
}

TEST_CASE("whoever gives up, and a rig that fails, end in the dark and without a value") {
  const TwoChoiceTest test = two_shows();
  const auto seen = equal_at(4.3);
  PaperRig rig;
  ScriptedObserver observer = person(seen, 0.5, 3);
  Leaves leaves(observer, 7);
  const auto none = run_two_choice(rig, test, leaves, {});
  REQUIRE(none);
  CHECK_FALSE(*none);
  CHECK(rig.shown == 8);
  CHECK_FALSE(rig.lit);

  PaperRig broken;
  broken.breaks_after = 5;
  const auto failed = run_two_choice(broken, test, observer, {});
  REQUIRE_FALSE(failed.ok());
  CHECK(failed.fault().code == "rig.dark");
  CHECK(broken.shown == 6);
  CHECK_FALSE(broken.lit);
}

TEST_CASE("a test that was left goes on where it was and ends as if it had not been") {
  const TemporaryFolder folder;
  const auto path = folder.path() / "answers";
  const TwoChoiceTest test = two_shows();
  const auto seen = equal_at(4.3);
  ScriptedObserver observer = person(seen, 1.0, 8);
  PaperRig whole_rig;
  const auto whole = run_two_choice(whole_rig, test, observer, {});
  REQUIRE(whole);
  for (const int after : {0, 13, 14}) {
    auto log = ChoiceLog::open(path, test, "scripted");
    REQUIRE(log);
    PaperRig rig;
    Leaves leaves(observer, after);
    TwoChoiceRun run;
    run.log = &*log;
    REQUIRE(run_two_choice(rig, test, leaves, run));
  }
  std::ofstream(path, std::ios::app) << "7,ab";  // cut off by a kill
  auto log = ChoiceLog::open(path, test, "scripted");
  REQUIRE(log);
  CHECK(log->rows().size() == 14);
  PaperRig rig;
  TwoChoiceRun run;
  run.log = &*log;
  const auto found = run_two_choice(rig, test, observer, run);
  REQUIRE(found);
  CHECK(rig.shown == 26);
  CHECK((*found)->value == (*whole)->value);
  CHECK((*found)->uncertainty == (*whole)->uncertainty);
}

TEST_CASE("answers to something else, and no answers, are refused by line") {
  const TemporaryFolder folder;
  const auto path = folder.path() / "answers";
  const TwoChoiceTest test = two_shows();
  { REQUIRE(ChoiceLog::open(path, test, "scripted")); }
  CHECK(ChoiceLog::open(path, test, "human").fault().code == "viewer.answers");
  TwoChoiceTest other = test;
  other.shows[1].sha256 = "cccc";
  CHECK(ChoiceLog::open(path, other, "scripted").fault().code == "viewer.answers");
  for (const char* line : {"11,above\n", "-1,above\n", "3,perhaps\n", "above\n", "\n"}) {
    std::filesystem::remove(path);
    { REQUIRE(ChoiceLog::open(path, test, "scripted")); }
    std::ofstream(path, std::ios::app) << "5,above\n" << line;
    const auto refused = ChoiceLog::open(path, test, "scripted");
    CAPTURE(line);
    REQUIRE_FALSE(refused.ok());
    CHECK(refused.fault().code == "viewer.answers");
    CHECK(refused.fault().where.find("line 3") != std::string::npos);
  }
  // A row that answers a question which this test does not ask then.
  std::filesystem::remove(path);
  { REQUIRE(ChoiceLog::open(path, test, "scripted")); }
  std::ofstream(path, std::ios::app) << "0,above\n";
  auto log = ChoiceLog::open(path, test, "scripted");
  REQUIRE(log);
  PaperRig rig;
  const auto seen = equal_at(4.3);
  ScriptedObserver observer = person(seen, 0.5, 3);
  TwoChoiceRun run;
  run.log = &*log;
  const auto refused = run_two_choice(rig, test, observer, run);
  REQUIRE_FALSE(refused.ok());
  CHECK(refused.fault().code == "viewer.answers");
  CHECK(rig.shown == 0);
}
