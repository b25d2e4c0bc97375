// For each code a project, `<code>/<code>.focal`, that raises exactly it; its remedy, applied, clears it.

#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <string>

#include "core/check/check.h"
#include "core/check/rig_differences.h"
#include "core/compile/compile.h"
#include "core/compile/coverage.h"
#include "core/optics/image_plan.h"
#include "core/percept/conflict_meter.h"
#include "core/schedule/schedule.h"
#include "core/stage/stage.h"
#include "io/assets/assets.h"
#include "io/project/project_file.h"
#include "tests/support/models.h"

using namespace focalstage;

namespace {

const std::filesystem::path folder = std::filesystem::path(FOCALSTAGE_SOURCE_DIR) / "tests" / "findings";

Project load(const std::string& code) {
  const Result<LoadedProject> loaded = load_project(folder / code);
  REQUIRE_MESSAGE(loaded.ok(), (loaded.ok() ? std::string() : describe(loaded.fault())));
  return loaded->project;
}

/// All that `compile` finds: every frame staged, compiled and looked at, for every projector.
std::vector<Finding> findings_of(const Project& project) {
  std::vector<CompileSettings> settings;
  std::vector<Compiler> compilers;
  std::vector<ScheduleResult> timed;
  std::vector<Schedule> schedules;
  for (std::size_t i = 0; i < project.projectors.size(); ++i) {
    settings.push_back(compile_settings(project, i));
    compilers.emplace_back(settings[i], 1);
    timed.push_back(make_schedule(project, settings[i].images, i));
    schedules.push_back(timed[i].schedule);
  }
  CoverageMeter meter(projectors_of(settings[0]), settings[0].lens_to_pupil_m,
                      project.glasses.lens_aperture_mm / 1000.0);
  ConflictMeter conflict(project, settings, schedules);
  const Result<LoadedAssets> loaded = load_assets(project, folder / project.name);
  REQUIRE(loaded);
  Measured measured;
  measured.others.resize(settings.size() - 1);
  for (int frame = 0; frame < project.frames.count; ++frame) {
    const Result<Stage> staged = stage(project, loaded->assets, frame / project.frames.rate_hz);
    REQUIRE(staged.ok());
    if (frame == 0) measured.meshes = mesh_states(project, *staged);
    if (frame == 0) measured.lit = surfaces_in_light(project, *staged);
    std::vector<FrameImages> images;
    for (std::size_t i = 0; i < compilers.size(); ++i) {
      Result<CompiledFrame> compiled = compilers[i].frame(*staged);
      REQUIRE(compiled.ok());
      (i == 0 ? measured.frames : measured.others[i - 1]).push_back(compiled->measure);
      images.push_back(std::move(compiled->images));
    }
    std::vector<const FrameImages*> shown;
    for (const FrameImages& one : images) shown.push_back(&one);
    measured.coverage.push_back(meter.measure(*staged));
    REQUIRE(conflict.add(*staged, shown, {}));
  }
  measured.conflicts = conflict.conflicts();
  return check(project, timed, measured, support::models());
}

std::set<std::string> codes(const std::vector<Finding>& findings) {
  std::set<std::string> all;
  for (const Finding& finding : findings) all.insert(finding.code);
  return all;
}

std::size_t count(const std::vector<Finding>& findings, const std::string& code) {
  return static_cast<std::size_t>(
      std::count_if(findings.begin(), findings.end(), [&](const Finding& f) { return f.code == code; }));
}

/// Applies the finding's remedy; there is one fewer of its code then, and no error that was not there.
void check_cleared(const Project& project, const std::vector<Finding>& before, const Finding& finding) {
  REQUIRE_FALSE(finding.remedy.empty());
  const Result<Project> after = apply_all(project, finding.remedy);
  REQUIRE_MESSAGE(after.ok(), (after.ok() ? std::string() : describe(after.fault())));
  const std::vector<Finding> left = findings_of(*after);
  CHECK(count(left, finding.code) < count(before, finding.code));
  for (const Finding& other : left) {
    if (other.severity == Severity::error) CHECK(other.code == finding.code);
  }
}

void check_code(const std::string& code, Severity severity, bool remedied, bool measured = true) {
  CAPTURE(code);
  const Project project = load(code);
  const std::vector<Finding> findings = findings_of(project);
  CHECK(codes(findings) == std::set<std::string>{code});
  for (const Finding& finding : findings) {
    CAPTURE(finding.message);
    CHECK(finding.severity == severity);
    CHECK(finding.amount.has_value() == measured);
    if (remedied) {
      check_cleared(project, findings, finding);
    } else {
      CHECK(finding.remedy.empty());
    }
  }
}

}  // namespace

TEST_CASE("slices.spacing") { check_code("slices.spacing", Severity::warning, true); }
TEST_CASE("slices.outside-sweep") { check_code("slices.outside-sweep", Severity::error, true); }
TEST_CASE("schedule.hidden-by-shutter") { check_code("schedule.hidden-by-shutter", Severity::error, true); }
TEST_CASE("schedule.overlap") { check_code("schedule.overlap", Severity::error, true); }
TEST_CASE("schedule.projectors-differ") { check_code("schedule.projectors-differ", Severity::warning, true); }
TEST_CASE("schedule.projectors-differ: what one shows and another cannot is an error") {
  Project project = load("schedule.projectors-differ");
  project.projectors[1].exposure_ms = project.projectors[0].exposure_ms;
  REQUIRE(findings_of(project).empty());
  project.projectors[1].exposure_ms = 7.0;  // into the shutters' dead windows
  const std::vector<Finding> findings = findings_of(project);
  const auto differ = std::find_if(findings.begin(), findings.end(), [](const Finding& finding) {
    return finding.code == "schedule.projectors-differ" && finding.severity == Severity::error;
  });
  REQUIRE(differ != findings.end());
  CHECK(differ->where == "/projectors/1");
  CHECK(count(findings, "schedule.hidden-by-shutter") > 0);
}
TEST_CASE("schedule.smear") { check_code("schedule.smear", Severity::warning, true); }
TEST_CASE("schedule.bit-depth") { check_code("schedule.bit-depth", Severity::error, true); }
TEST_CASE("schedule.no-zero-crossing") { check_code("schedule.no-zero-crossing", Severity::error, true); }
TEST_CASE("optics.lens-range") { check_code("optics.lens-range", Severity::error, true); }
TEST_CASE("optics.lens-current") { check_code("optics.lens-current", Severity::error, true); }
TEST_CASE("depth.out-of-range") { check_code("depth.out-of-range", Severity::error, true); }
TEST_CASE("frames.rate") { check_code("frames.rate", Severity::error, true); }
TEST_CASE("safety.flicker") { check_code("safety.flicker", Severity::warning, true); }
TEST_CASE("view.outside-projector") { check_code("view.outside-projector", Severity::warning, false); }
TEST_CASE("view.off-surface") { check_code("view.off-surface", Severity::warning, false); }
TEST_CASE("view.outside-lens") { check_code("view.outside-lens", Severity::warning, false); }
TEST_CASE("view.unseen") { check_code("view.unseen", Severity::warning, false); }
TEST_CASE("view.conflict") { check_code("view.conflict", Severity::warning, true); }
TEST_CASE("light.clipped") { check_code("light.clipped", Severity::warning, false); }
TEST_CASE("light.clipped, by paint: a white that it can send back clears it") {
  const Project project = load("light.clipped-by-paint");
  const std::vector<Finding> findings = findings_of(project);
  REQUIRE(codes(findings) == std::set<std::string>{"light.clipped"});
  REQUIRE(findings.size() == 1);
  CHECK(findings[0].where == "/surfaces/0");
  CHECK(findings[0].amount->value > 0.9);  // all of the card but its rim
  check_cleared(project, findings, findings[0]);
}
TEST_CASE("light.below-black") { check_code("light.below-black", Severity::warning, false); }
TEST_CASE("light.contrast") { check_code("light.contrast", Severity::warning, false); }
TEST_CASE("light.ambient-unknown") { check_code("light.ambient-unknown", Severity::info, false, false); }
TEST_CASE("projector.defocus") { check_code("projector.defocus", Severity::warning, false); }

TEST_CASE("projector.unknown-model") { check_code("projector.unknown-model", Severity::warning, true, false); }
TEST_CASE("projector.pixel-layout") { check_code("projector.pixel-layout", Severity::warning, true, false); }
TEST_CASE("slices.optimal-lattice") { check_code("slices.optimal-lattice", Severity::warning, true, false); }
TEST_CASE("mesh.size") { check_code("mesh.size", Severity::warning, true); }
TEST_CASE("mesh.winding") { check_code("mesh.winding", Severity::warning, true); }
TEST_CASE("mesh.inside-out") { check_code("mesh.inside-out", Severity::warning, true); }
TEST_CASE("mesh.no-uv") { check_code("mesh.no-uv", Severity::warning, true, false); }
TEST_CASE("mesh.repeated") { check_code("mesh.repeated", Severity::warning, true); }
TEST_CASE("mesh.forks") { check_code("mesh.forks", Severity::warning, true); }
TEST_CASE("mesh.holes") { check_code("mesh.holes", Severity::info, true); }
TEST_CASE("mesh.bits") { check_code("mesh.bits", Severity::info, true); }
TEST_CASE("mesh.no-area") { check_code("mesh.no-area", Severity::info, true); }

TEST_CASE("rig.differs") {
  const Project project = load("rig.differs");
  CHECK(findings_of(project).empty());
  RigValues rig;  // as the project's, but for a lens that lags
  rig.latency_ms = project.projectors[0].latency_ms;
  rig.width_px = project.projectors[0].width_px;
  rig.height_px = project.projectors[0].height_px;
  CHECK(rig_differences(project, rig).empty());
  rig.lens_response.left = rig.lens_response.right = {{0, 38.0, 0.0, {}}, {1, 36.0, -14.0, {}}};
  const std::vector<Finding> findings = rig_differences(project, rig);
  REQUIRE(codes(findings) == std::set<std::string>{"rig.differs"});
  const Result<Project> adopted = apply_all(project, findings[0].remedy);
  REQUIRE(adopted.ok());
  CHECK(rig_differences(*adopted, rig).empty());
}

TEST_CASE("rig.differs: a rig that has fewer projectors, which no edit of ours mends") {
  Project project = load("rig.differs");
  RigValues rig;
  rig.latency_ms = project.projectors[0].latency_ms;
  rig.width_px = project.projectors[0].width_px;
  rig.height_px = project.projectors[0].height_px;
  project.projectors.push_back(project.projectors[0]);
  project.projectors[1].name = "beside";
  const std::vector<Finding> findings = rig_differences(project, rig);
  REQUIRE(findings.size() == 1);
  CHECK(findings[0].code == "rig.differs");
  CHECK(findings[0].where == "/projectors/1");
  CHECK(findings[0].message.find("\"beside\" would stay dark") != std::string::npos);
  CHECK(findings[0].remedy.empty());
  rig.projectors = 2;
  CHECK(rig_differences(project, rig).empty());
}

TEST_CASE("every project here belongs to a test, and every code of the design to a project") {
  const std::set<std::string> expected{"slices.spacing",
                                       "slices.outside-sweep",
                                       "schedule.hidden-by-shutter",
                                       "schedule.overlap",
                                       "schedule.projectors-differ",
                                       "schedule.smear",
                                       "schedule.bit-depth",
                                       "schedule.no-zero-crossing",
                                       "optics.lens-range",
                                       "depth.out-of-range",
                                       "frames.rate",
                                       "view.outside-projector",
                                       "view.off-surface",
                                       "view.outside-lens",
                                       "light.clipped",
                                       "light.clipped-by-paint",
                                       "light.below-black",
                                       "light.contrast",
                                       "light.ambient-unknown",
                                       "projector.defocus",
                                       "safety.flicker",
                                       "rig.differs",
                                       "optics.lens-current",
                                       "view.unseen",
                                       "view.conflict",
                                       "projector.unknown-model",
                                       "projector.pixel-layout",
                                       "slices.optimal-lattice",
                                       "mesh.size",
                                       "mesh.no-uv",
                                       "mesh.winding",
                                       "mesh.inside-out",
                                       "mesh.repeated",
                                       "mesh.forks",
                                       "mesh.holes",
                                       "mesh.bits",
                                       "mesh.no-area"};
  std::set<std::string> found;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.is_directory()) found.insert(entry.path().filename().string());
  }
  CHECK(found == expected);
}
