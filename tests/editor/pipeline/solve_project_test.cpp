#include "editor/pipeline/solve_project.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>

#include "core/check/rules.h"
#include "core/optics/image_plan.h"
#include "core/schedule/slots.h"
#include "editor/pipeline/compile_show.h"
#include "editor/pipeline/measure_needs.h"
#include "editor/pipeline/source.h"
#include "tests/support/chance.h"
#include "tests/support/models.h"

using namespace focalstage;

namespace {

std::vector<std::filesystem::path> samples() {
  std::vector<std::filesystem::path> folders;
  for (const auto& entry : std::filesystem::directory_iterator(FOCALSTAGE_SOURCE_DIR "/projects")) {
    if (entry.is_directory()) folders.push_back(entry.path());
  }
  std::sort(folders.begin(), folders.end());
  return folders;
}

Result<SolveReport> solved(const Project& project, const Assets& assets = {}, const SolveWishes& wishes = {}) {
  return solve_project(project, assets, support::models(), wishes, [](double, const std::string&) {}, {});
}

/// A project of primitives alone.
Source source_of(const Project& project) {
  Source source;
  source.project = project;
  source.models = support::models();
  return source;
}

/// A small projector before a screen, and an object.
Project small_room() {
  Project project;
  project.name = "Small";
  Projector projector;
  projector.name = "main";
  projector.width_px = 128;
  projector.height_px = 96;
  projector.fx_px = projector.fy_px = 100;
  projector.cx_px = 64;
  projector.cy_px = 48;
  projector.pose.position_m = {0.0, 0.1, 0.0};
  project.projectors = {projector};
  project.slices.powers_d = {-1.0, 0.0, 1.0};
  Surface screen;
  screen.name = "screen";
  screen.mesh.shape = PlaneMesh{{1.5, 1.5}};
  screen.placement.pose.position_m = {0.0, 0.0, -0.5};
  project.surfaces = {screen};
  Object object;
  object.name = "box";
  object.mesh.shape = BoxMesh{{0.1, 0.1, 0.1}};
  object.appearance = UnlitAppearance{};
  object.placement.pose.position_m = {0.0, 0.0, -0.42};
  project.objects = {object};
  return project;
}

std::vector<Finding> planned(const Project& project) {
  return planned_findings(project, time_slots(project, image_plan(project)).troubles, support::models());
}

}  // namespace

TEST_CASE("every sample: the proposal has no finding of the rules, and compiling it finds nothing beyond") {
  int counted = 0;  // solved for a number of slices; one sample is too narrow for four
  for (const std::filesystem::path& folder : samples()) {
    INFO(folder.filename().string());
    auto source = open_project(folder);
    REQUIRE(source);
    // Three frames say what the test wants to know of the longer ones.
    source->project.frames.rate_hz /= std::max(1, source->project.frames.count / 3);
    source->project.frames.count = std::min(3, source->project.frames.count);
    for (const std::optional<int> count : {std::optional<int>{}, std::optional<int>{4}}) {
      SolveWishes wishes;
      wishes.slices = count;
      const auto report = solved(source->project, source->loaded.assets, wishes);
      REQUIRE(report);
      if (count && !report->solved()) {
        CHECK(has_error(report->findings));
        CHECK_FALSE(report->nearest.empty());
        continue;
      }
      REQUIRE(report->solved());
      counted += count ? 1 : 0;
      const Result<Project> after = apply_all(source->project, report->edits);
      REQUIRE(after);
      CHECK_FALSE(has_error(planned(*after)));
      const auto found = check_project(Source{*after, {}, source->loaded, {}, source->models}, {}, [](int, int) {}, {});
      REQUIRE(found);
      CHECK_FALSE(has_error(found->findings));
      CHECK(found->findings == report->findings);
      CHECK(report->result.medians.mean_d <= report->result.uniform.mean_d + 1e-9);
    }
  }
  CHECK(counted >= 6);
}

TEST_CASE("random rooms: what is proposed compiles without an error, what is not is explained") {
  support::Chance chance(5);
  int offered = 0;
  for (int round = 0; round < 25; ++round) {
    Project project = small_room();
    project.surfaces[0].placement.pose.position_m.z = -chance.between(0.4, 1.0);
    project.surfaces[0].illumination = chance.one_in(3) ? 0.4 : 0.0;
    project.objects[0].placement.pose.position_m = {chance.between(-0.1, 0.1), chance.between(-0.1, 0.1),
                                                    -chance.between(0.13, 1.5)};
    const double turn = chance.between(-0.4, 0.4);
    project.surfaces[0].placement.pose.rotation = {std::cos(turn), 0.0, std::sin(turn), 0.0};
    if (chance.one_in(3)) project.objects[0].depth = {DepthMode::offset, chance.between(-1.0, 1.0), 0, {}};
    const auto report = solved(project);
    REQUIRE(report);
    if (report->solved()) {
      ++offered;
      const Result<Project> after = apply_all(project, report->edits);
      REQUIRE(after);
      CHECK_FALSE(has_error(planned(*after)));
      CHECK_FALSE(has_error(report->findings));
    } else {
      CHECK(has_error(report->findings));
    }
  }
  MESSAGE(offered << " of 25 solved");
  CHECK(offered >= 12);
}

TEST_CASE("an object that comes nearer: the slices reach what every frame needs") {
  Project project = small_room();
  project.frames = {10, 10.0, {}};
  Placement& placement = project.objects[0].placement;
  placement.keys = {{0.0, {{0, 0, -0.6}, {1, 0, 0, 0}}}, {0.9, {{0, 0, -0.35}, {1, 0, 0, 0}}}};
  const auto moving = solved(project);
  REQUIRE(moving);
  REQUIRE(moving->solved());
  placement.keys.pop_back();
  const auto still = solved(project);
  REQUIRE(still);
  REQUIRE(still->solved());
  CHECK(moving->result.lowest_need_d < still->result.lowest_need_d - 0.5);
  CHECK(moving->result.rig->powers_d.front() <= moving->result.lowest_need_d + 1e-9);
  CHECK(moving->result.highest_need_d == doctest::Approx(still->result.highest_need_d));
}

TEST_CASE("no object, a viewer behind the screen, a projector that looks away: an error, with what to do") {
  Project none = small_room();
  none.objects.clear();
  auto report = solved(none);
  REQUIRE(report);
  CHECK_FALSE(report->solved());
  CHECK(report->findings.at(0).code == "solve.nothing");

  Project behind = small_room();
  behind.viewer.placement.pose.position_m = {0, 0, -3};
  report = solved(behind);
  REQUIRE(report);
  CHECK(report->findings.at(0).code == "solve.nothing");

  Project away = small_room();
  away.projectors[0].pose.rotation = {0, 0, 1, 0};
  report = solved(away);
  REQUIRE(report);
  CHECK_FALSE(report->solved());
  CHECK(report->findings.at(0).code == "solve.unserved");

  Project bare = small_room();
  bare.surfaces.clear();
  report = solved(bare);
  REQUIRE(report);
  CHECK(report->findings.at(0).code == "solve.unserved");

  Project dark = small_room();
  dark.projectors.clear();
  const auto fault = solved(dark);
  REQUIRE_FALSE(fault);
  CHECK(fault.fault().code == "project.no-projector");
}

TEST_CASE("an error that slices and sweep do not mend is named with its own remedy, and nothing is proposed") {
  Project project = small_room();
  project.frames.rate_hz = 35.0;  // of a sweep at 60 Hz
  const auto report = solved(project);
  REQUIRE(report);
  CHECK_FALSE(report->solved());
  CHECK(report->edits.empty());
  REQUIRE(report->findings.size() == 1);
  CHECK(report->findings[0].code == "frames.rate");
  CHECK_FALSE(report->findings[0].remedy.empty());
}

TEST_CASE("stopped at once") {
  std::stop_source stop;
  stop.request_stop();
  const auto report = solve_project(
      small_room(), {}, support::models(), {}, [](double, const std::string&) {}, stop.get_token());
  REQUIRE_FALSE(report);
  CHECK(report.fault().code == "solve.cancelled");
}

TEST_CASE("checking a project offers the solver's proposal where nothing near the culprit helps") {
  Project project = small_room();
  project.glasses.lens_range_d = {-1.2, 0.6};
  project.sweep.min_power_d = -0.3;
  project.sweep.max_power_d = 0.3;
  project.slices.powers_d = {-0.2, 0.2};
  project.objects[0].placement.pose.position_m.z = -0.4;
  project.objects[0].mesh.shape = BoxMesh{{0.1, 0.1, 0.2}};
  const auto checked = check_project(source_of(project), {}, [](int, int) {}, {});
  REQUIRE(checked);
  const std::vector<Finding>& findings = checked->findings;
  const auto beyond = std::find_if(findings.begin(), findings.end(),
                                   [](const Finding& finding) { return finding.code == "depth.out-of-range"; });
  REQUIRE(beyond != findings.end());
  REQUIRE_FALSE(beyond->remedy.empty());
  const Result<Project> after = apply_all(project, beyond->remedy);
  REQUIRE(after);
  const auto left = check_project(source_of(*after), {}, [](int, int) {}, {});
  REQUIRE(left);
  CHECK_FALSE(has_error(left->findings));
}
