#include "core/check/proposal.h"

#include <doctest/doctest.h>

#include "core/schedule/solve_attempt.h"
#include "tests/core/check/projects.h"

using namespace focalstage;
using namespace focalstage::testing;

namespace {

SolvedRig rig_of(std::vector<double> powers_d) {
  SolvedRig rig;
  rig.powers_d = std::move(powers_d);
  rig.min_power_d = -1.5;
  rig.max_power_d = 1.5;
  rig.frames_per_second = 2000.0;
  return rig;
}

Needs needs_from(double low_d, double high_d) {
  ObjectNeeds object;
  object.looks = 100;
  for (double power_d = low_d; power_d <= high_d + 1e-9; power_d += 0.01) object.powers.right.add(power_d, 1);
  return {{object}};
}

}  // namespace

TEST_CASE("a rig's edits make the project that was solved for, and no more than that") {
  const Project project = quiet_project();
  CHECK(rig_edits(project, rig_of({-0.5, 0.0, 0.5})).empty());
  SolvedRig rig = rig_of({-0.75, 0.25});
  rig.min_power_d = -1.1;
  rig.exposure_ms = 0.4;
  rig.frames_per_second = 2500.0;
  const std::vector<Edit> edits = rig_edits(project, rig);
  CHECK(edits.size() == 4);
  const Result<Project> after = apply_all(project, edits);
  REQUIRE(after);
  CHECK(*after == with_rig(project, rig));
}

TEST_CASE("objects pinned to a slice follow its power") {
  Project project = quiet_project();
  project.slices.powers_d = {0.5, -0.5, 0.0};
  project.objects[0].depth = {DepthMode::slice, 0.0, 0, {}};
  Object other = project.objects[0];
  other.name = "far";
  other.depth.index = 1;
  project.objects.push_back(other);
  const Result<Project> after = apply_all(project, rig_edits(project, rig_of({-0.5, -0.1, 0.2, 0.5})));
  REQUIRE(after);
  CHECK(after->objects[0].depth.index == 3);
  CHECK(after->objects[1].depth.index == 0);
  // A shorter list, where an index must move before the list may.
  project.objects[0].depth.index = 2;
  const Result<Project> fewer = apply_all(project, rig_edits(project, rig_of({-0.5, 0.0})));
  REQUIRE(fewer);
  CHECK(fewer->objects[0].depth.index == 1);
  CHECK(fewer->objects[1].depth.index == 0);
}

TEST_CASE("a sweep moves as a whole: its edits can be applied one after the other, up and down") {
  Project project = quiet_project();
  for (const auto& [low_d, high_d] : {std::pair{1.6, 2.4}, {-4.0, -3.0}, {1.5, 2.0}, {-1.0, 0.5}}) {
    SolvedRig rig = rig_of({low_d + 0.3, high_d - 0.3});
    rig.min_power_d = low_d;
    rig.max_power_d = high_d;
    const Result<Project> after = apply_all(project, rig_edits(project, rig));
    REQUIRE(after);
    CHECK(after->sweep.min_power_d == low_d);
    CHECK(after->sweep.max_power_d == high_d);
    project = *after;
  }
}

TEST_CASE("each limit that fails is a finding with its amount; what is possible instead is its remedy") {
  Project project = quiet_project();
  project.projectors[0].frames_per_second = 1000;
  const SolveResult result = solve(project, needs_from(-1.0, 1.0), {}, support::models());
  REQUIRE_FALSE(result.rig);
  const auto nearest = nearest_proposals(project, result, support::models());
  REQUIRE_FALSE(nearest.empty());
  const std::vector<Finding> findings = solve_findings(project, result, nearest);
  REQUIRE(findings.size() == result.troubles.size());
  for (const Finding& finding : findings) {
    CHECK(finding.severity == Severity::error);
    REQUIRE(finding.amount);
    REQUIRE_FALSE(finding.remedy.empty());
    CHECK(finding.message.find("possible: ") != std::string::npos);
    const Result<Project> after = apply_all(project, finding.remedy);
    REQUIRE(after);
    CHECK_FALSE(has_error(check_of(*after)));
    CHECK(codes(check_of(*after)) == Codes{});
  }
}

TEST_CASE("every kind of limit has words, a code and a place") {
  using Limit = SolveTrouble::Limit;
  for (int i = 0; i <= static_cast<int>(Limit::stopped); ++i) {
    SolveResult result;
    result.troubles = {{static_cast<Limit>(i), 2.0, 1.0, 0}};
    const std::vector<Finding> findings = solve_findings(quiet_project(), result, {});
    REQUIRE(findings.size() == 1);
    CHECK(findings[0].message.size() > 20);
    CHECK_FALSE(findings[0].code.empty());
    CHECK(findings[0].where.rfind("/", 0) == 0);
  }
}

TEST_CASE("errors that remain after some edits, those of the edits themselves too") {
  const Project project = quiet_project();
  CHECK(errors_after(project, {}, support::models()).empty());
  const std::vector<Edit> wide{{Edit::Kind::set, "slices", "", "powers_d", Value(Value::Array{-1.45, 0.0})}};
  CHECK_FALSE(errors_after(project, wide, support::models()).empty());
  const std::vector<Edit> wrong{{Edit::Kind::set, "objects", "nobody", "scale", 2.0}};
  REQUIRE(errors_after(project, wrong, support::models()).size() == 1);
  CHECK(errors_after(project, wrong, support::models())[0].message.find("nobody") != std::string::npos);
}

TEST_CASE("a proposal in words: slices, sweep, errors") {
  const Project project = quiet_project();
  const SolveResult result = solve(project, needs_from(-1.0, 1.0), {}, support::models());
  REQUIRE(result.rig);
  std::string all;
  for (const std::string& line : proposal_words(project, result)) all += line + "\n";
  CHECK(all.find("5 slices instead of 3: -1, ") != std::string::npos);
  CHECK(all.find("sweep -1.27 to 1.27 D instead of -1.5 to 1.5 D") != std::string::npos);
  CHECK(all.find("mean error") != std::string::npos);
  CHECK(proposal_words(project, {}).empty());
}
