#include "core/study/progress.h"

#include <functional>

#include <doctest/doctest.h>

#include "a_study.h"
#include "core/study/tally.h"

using namespace focalstage;

namespace {

/// A whole participant's rows, each trial answered at its first showing.
std::vector<Response> whole(const Study& study, const std::vector<TrialBlock>& plan) {
  std::vector<Response> rows;
  for (const TrialBlock& block : plan) {
    for (const Trial& trial : block.trials) {
      Response row = response_to(study, block, trial);
      row.participant = study.participants[0];
      row.response_m = row.actual_m;
      row.sitting = 1;
      rows.push_back(row);
    }
  }
  return rows;
}

}  // namespace

TEST_CASE("rows say which trial is next; spoiled ones leave it next") {
  const Study study = paper_study();
  const auto plan = plan_of(study, 0);
  const std::vector<Response> rows = whole(study, plan);
  const auto none = progress_of(study, plan, {});
  REQUIRE(none);
  CHECK(none->block == 0);
  CHECK(none->of == 42);
  CHECK(none->sittings == 0);
  const auto half = progress_of(study, plan, {rows.begin(), rows.begin() + 21});
  REQUIRE(half);
  CHECK(half->block == 1);
  CHECK(half->trial == 0);
  CHECK_FALSE(half->finished());
  CHECK(progress_of(study, plan, rows)->finished());

  std::vector<Response> repeated{rows[0], rows[1], rows[1]};
  repeated[1].spoiled = "rig.dark";
  repeated[2].sitting = 2;
  const auto after = progress_of(study, plan, repeated);
  REQUIRE(after);
  CHECK(after->trial == 2);
  CHECK(after->done == 2);
  CHECK(after->sittings == 2);
}

TEST_CASE("rows that are not the plan's are told by their number") {
  const Study study = paper_study();
  const auto plan = plan_of(study, 0);
  const std::vector<std::function<void(std::vector<Response>&)>> spoils{
      [](auto& rows) { rows.erase(rows.begin() + 4); },
      [](auto& rows) { rows[4] = rows[3]; },
      [](auto& rows) { rows[4].target = (rows[4].target + 1) % 5; },
      [](auto& rows) { rows[4].condition = 1 - rows[4].condition; },
      [](auto& rows) { rows[4].actual_m += 0.001; },
      [](auto& rows) { rows[4].pointer_start_m += 0.001; },
      [](auto& rows) { rows[4].training = true; },
      [](auto& rows) { rows[4].sitting = 0; },
  };
  for (const auto& spoil : spoils) {
    auto rows = whole(study, plan);
    spoil(rows);
    const auto progress = progress_of(study, plan, rows);
    REQUIRE_FALSE(progress);
    CHECK(progress.fault().code == "study.rows");
    CHECK(progress.fault().where == "row 5");
  }
  auto rows = whole(study, plan);
  rows.push_back(rows.back());
  CHECK(progress_of(study, plan, rows).fault().where == "row 43");
}

TEST_CASE("a tally counts what counts") {
  const Study study = paper_study();
  auto rows = whole(study, plan_of(study, 0));
  rows[3].gave_up = true;
  Response again = rows[5];
  again.spoiled = "rig.dark";
  rows.push_back(again);
  const auto tallies = tally_of(study, rows);
  REQUIRE(tallies.size() == 1);
  CHECK(tallies[0].answered == 39);
  CHECK(tallies[0].given_up == 1);
  CHECK(tallies[0].spoiled == 1);
  CHECK(tallies[0].finished());
}
