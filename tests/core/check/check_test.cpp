#include "core/check/check.h"

#include <doctest/doctest.h>

#include <cmath>

#include "tests/core/check/projects.h"

using namespace focalstage;
using namespace focalstage::testing;

namespace {

void light(Project& project) { project.surfaces[0].illumination = 0.4; }

Project with_sweep(double min_d, double max_d) {
  Project project = quiet_project();
  project.sweep.min_power_d = min_d;
  project.sweep.max_power_d = max_d;
  return project;
}

MeasuredWaveform triangle(double min_d, double max_d) {
  MeasuredWaveform waveform;
  for (int i = 0; i < 20; ++i) waveform.power_d.push_back(min_d + (max_d - min_d) * (i <= 10 ? i : 20 - i) / 10.0);
  waveform.drive_a.assign(20, 0.0);
  return waveform;
}

}  // namespace

TEST_CASE("a sound project has no findings") { CHECK(codes(check_of(quiet_project())) == Codes{}); }

TEST_CASE("slices over 0.6 D apart are a warning, over 1 D an error") {
  Project project = quiet_project();
  project.slices.powers_d = {1.0, -1.0, 0.0};  // the paper's: 1 D apart, in no order
  std::vector<Finding> findings = check_of(project);
  REQUIRE(codes(findings) == Codes{"slices.spacing", "slices.spacing"});
  CHECK(findings[0].severity == Severity::warning);
  CHECK(findings[0].where == "/slices/powers_d/0");  // the upper of the two, where the designer wrote it
  CHECK(findings[1].where == "/slices/powers_d/2");
  CHECK(*findings[0].amount == Amount{1.0, 0.6, "D"});

  project.slices.powers_d = {-0.5, 0.6};
  findings = check_of(project);
  REQUIRE(codes(findings) == Codes{"slices.spacing"});
  CHECK(findings[0].severity == Severity::error);
  CHECK(findings[0].amount->value == doctest::Approx(1.1));
  CHECK(findings[0].amount->limit == 1.0);

  project.slices.powers_d = {-2.6 + 1.9, -2.6 + 2.5, -2.6 + 3.1};  // 0.6 apart but for rounding
  CHECK(codes(check_of(project)) == Codes{});
}

TEST_CASE("slices that the sweep does not reach, once for both eyes") {
  Project project = with_sweep(-0.75, 0.75);
  project.slices.powers_d = {-0.3, 0.2, 0.8};
  const std::vector<Finding> findings = check_of(project);
  REQUIRE(codes(findings) == Codes{"slices.outside-sweep"});
  CHECK(findings[0].severity == Severity::error);
  CHECK(findings[0].where == "/slices/powers_d/2");
  CHECK(*findings[0].amount == Amount{0.8, 0.75, "D"});
  // The least widening of 0.25 D steps: from -0.75 to m, 0.8 <= (m - 0.75)/2 + c (m + 0.75)/2 with
  // c = cos(2 pi 60 * 1.75 ms) = 0.790155 gives m >= 1.806/1.790 = 0.982.
  REQUIRE(findings[0].remedy.size() == 1);
  CHECK(findings[0].remedy[0] == Edit{Edit::Kind::set, "sweep", "", "max_power_d", Value(1.0)});
}

TEST_CASE("exposures while a shutter moves") {
  Project project = quiet_project();
  project.slices.powers_d = {-1.2, -0.6, 0.0, 0.6, 1.2};  // 1.185233 is the last that +-1.5 D can show
  const std::vector<Finding> findings = check_of(project);
  REQUIRE(codes(findings) == Codes{"schedule.hidden-by-shutter", "schedule.hidden-by-shutter"});
  CHECK(findings[0].where == "/slices/powers_d/0");
  CHECK(findings[1].where == "/slices/powers_d/4");
  // acos(1.2/1.5) / (2 pi 60) = 1.706927 ms instead of 1.75
  CHECK(findings[0].amount->value == doctest::Approx(0.043073).epsilon(1e-4));
  CHECK(findings[0].amount->unit == "ms");
  // A wider sweep would smear (1.75 D: 3.5 sin(0.0942478) = 0.329 D); three quarters of the exposure help both:
  // 1.5 cos(2 pi 60 * 1.6875 ms) = 1.207 D.
  const std::vector<Edit> shorter{{Edit::Kind::set, "projectors", "main", "exposure_ms", 0.375}};
  CHECK(findings[0].remedy == shorter);
  CHECK(findings[1].remedy == shorter);
}

TEST_CASE("exposures that come too close, once for both eyes") {
  Project project = quiet_project();
  project.slices.powers_d = {-0.5, 0.0, 0.15, 0.5};
  const std::vector<Finding> findings = check_of(project);
  REQUIRE(codes(findings) == Codes{"schedule.overlap"});
  CHECK(findings[0].where == "/slices/powers_d/2");
  // asin(0.1) / (2 pi 60)
  CHECK(findings[0].amount->value == doctest::Approx(0.265703).epsilon(1e-5));
  CHECK(findings[0].amount->limit == doctest::Approx(0.5));
}

TEST_CASE("a slice too near to the light is to join it") {
  Project project = quiet_project();
  light(project);
  project.slices.powers_d = {-0.5, 0.1, 0.6};
  const std::vector<Finding> findings = check_of(project);
  REQUIRE(codes(findings) == Codes{"schedule.overlap"});
  CHECK(findings[0].where == "/slices/powers_d/1");
  REQUIRE(findings[0].remedy.size() == 1);
  CHECK(findings[0].remedy[0].value == Value(Value::Array{-0.5, 0.0, 0.6}));
}

TEST_CASE("an exposure over which the power changes by more than 0.3 D") {
  Project project = with_sweep(-2.0, 2.0);
  const std::vector<Finding> findings = check_of(project);
  REQUIRE(codes(findings) == Codes{"schedule.smear", "schedule.smear", "schedule.smear"});
  CHECK(findings[1].severity == Severity::warning);
  CHECK(findings[1].where == "/slices/powers_d/1");
  CHECK(findings[1].amount->value == doctest::Approx(4.0 * std::sin(2.0 * 3.14159265358979 * 60.0 * 0.00025)));
  CHECK(findings[1].remedy[0].key == "exposure_ms");
}

TEST_CASE("smear that the projector is too slow to avoid has no remedy") {
  Project project = with_sweep(-2.0, 2.0);
  project.projectors[0].frames_per_second = 1000.0;
  project.slices.powers_d = {0.0};
  const ProjectorModelData slow{"slow", 1024, 768, ProjectorClock::triggered, PixelLayout::square, {{8, 1000.0}}, {}};
  project.projectors[0].model = "slow";
  const std::vector<ProjectorModelData> models{slow};
  for (const Finding& finding : check(project, make_schedule(project, image_plan(project)), {}, models)) {
    CHECK(finding.code == "schedule.smear");
    CHECK(finding.remedy.empty());
  }
}

TEST_CASE("light of a surface is named at the surface") {
  Project project = with_sweep(-2.0, 2.0);
  project.slices.powers_d = {-1.4, 1.4};
  project.surfaces.insert(project.surfaces.begin(), Surface{});
  light(project);
  project.surfaces[0].hidden = true;
  project.surfaces[1].illumination = 0.3;
  const std::vector<Finding> findings = check_of(project);
  REQUIRE(count(findings, "schedule.smear") == 1);
  CHECK(findings.back().where == "/surfaces/1/illumination");
}

TEST_CASE("more images a second than the projector shows at that depth") {
  Project project = quiet_project();
  project.projectors[0].frames_per_second = 3000.0;
  std::vector<Finding> findings = check_of(project);
  REQUIRE(codes(findings) == Codes{"schedule.bit-depth"});
  CHECK(findings[0].where == "/projectors/0/frames_per_second");
  CHECK(*findings[0].amount == Amount{3000.0, 2840.0, "1/s"});
  CHECK(findings[0].remedy == std::vector<Edit>{{Edit::Kind::set, "projectors", "main", "frames_per_second", 2840.0}});

  project.projectors[0].bits = 1;  // 22,000 a second
  CHECK(codes(check_of(project)) == Codes{});
  project.projectors[0].exposure_ms = 0.04;
  findings = check_of(project);
  REQUIRE(codes(findings) == Codes{"schedule.bit-depth"});
  CHECK(findings[0].where == "/projectors/0/exposure_ms");
  CHECK(findings[0].amount->value == doctest::Approx(25000.0));

  project = quiet_project();
  project.projectors[0].model = "lightcrafter4500";
  project.projectors[0].bits = 9;
  findings = check_of(project);
  CHECK(findings[0].where == "/projectors/0/bits");
  CHECK(*findings[0].amount == Amount{9.0, 8.0, "bits"});
  project.projectors[0].model = "my own";  // nothing is known of it
  CHECK(codes(check_of(project)) == Codes{"projector.unknown-model"});
}

TEST_CASE("an exposure shorter than the model's, though the rate is not") {
  Project project = quiet_project();
  project.projectors[0].model = "slow to start";
  const std::vector<ProjectorModelData> models{
      {"slow to start", 1024, 768, ProjectorClock::triggered, PixelLayout::square, {{8, 2000.0, 0.45}}, {}}};
  const auto findings = [&] { return check(project, make_schedule(project, image_plan(project)), {}, models); };
  project.projectors[0].exposure_ms = 0.45;
  CHECK(codes(findings()) == Codes{});
  project.projectors[0].exposure_ms = 0.4;
  REQUIRE(codes(findings()) == Codes{"schedule.bit-depth"});
  CHECK(findings()[0].where == "/projectors/0/exposure_ms");
  CHECK(findings()[0].remedy == std::vector<Edit>{{Edit::Kind::set, "projectors", "main", "exposure_ms", 0.45}});
}

TEST_CASE("a model that nobody described") {
  Project project = quiet_project();
  project.projectors[0].model = "my own/projector";
  std::vector<Finding> findings = check_of(project);
  REQUIRE(codes(findings) == Codes{"projector.unknown-model"});
  CHECK(findings[0].severity == Severity::warning);
  CHECK(findings[0].where == "/projectors/0/model");
  CHECK(findings[0].message.find("models/my-own-projector.json") != std::string::npos);
  CHECK(findings[0].message.find("dynaflash, lightcrafter4500") != std::string::npos);
  CHECK(findings[0].remedy.empty());
  project.projectors[0].model = "Dyna-Flash";
  findings = check_of(project);
  REQUIRE(findings.size() == 1);
  CHECK(findings[0].remedy == std::vector<Edit>{{Edit::Kind::set, "projectors", "main", "model", "dynaflash"}});
}

TEST_CASE("another lattice of pixels than the model's") {
  Project project = quiet_project();
  project.projectors[0].pixel_layout = PixelLayout::diamond;
  const std::vector<Finding> findings = check_of(project);
  REQUIRE(codes(findings) == Codes{"projector.pixel-layout"});
  CHECK(findings[0].where == "/projectors/0/pixel_layout");
  CHECK(findings[0].remedy == std::vector<Edit>{{Edit::Kind::set, "projectors", "main", "pixel_layout", "square"}});
}

TEST_CASE("optimal slices on a diamond lattice") {
  Project project = quiet_project();
  project.slices.assignment = Assignment::optimal;
  CHECK(codes(check_of(project)) == Codes{});
  project.projectors[0].pixel_layout = PixelLayout::diamond;
  const std::vector<Finding> findings = check_of(project);
  REQUIRE(count(findings, "slices.optimal-lattice") == 1);
  CHECK(findings.back().where == "/slices/assignment");
  CHECK(findings.back().remedy == std::vector<Edit>{{Edit::Kind::set, "slices", "", "assignment", "linear"}});
}

TEST_CASE("colour takes three exposures") {
  Project project = quiet_project();
  project.projectors[0].color = ColorMode::rgb;
  const std::vector<Finding> findings = check_of(project);
  REQUIRE(codes(findings) == Codes{"schedule.bit-depth"});
  CHECK(findings[0].amount->limit == doctest::Approx(946.67).epsilon(1e-5));
}

TEST_CASE("light without a zero crossing") {
  Project project = with_sweep(0.25, 2.25);
  project.slices.powers_d = {0.8, 1.3};
  CHECK(codes(check_of(project)) == Codes{});
  light(project);
  const std::vector<Finding> findings = check_of(project);
  REQUIRE(codes(findings) == Codes{"schedule.no-zero-crossing"});
  CHECK(findings[0].where == "/sweep/min_power_d");
  CHECK(*findings[0].amount == Amount{0.25, 0.0, "D"});
}

TEST_CASE("powers beyond the lens") {
  Project project = with_sweep(-1.5, 1.5);
  project.glasses.lens_range_d = {-1.4, 3.0};
  std::vector<Finding> findings = check_of(project);
  REQUIRE(codes(findings) == Codes{"optics.lens-range"});
  CHECK(findings[0].where == "/sweep/min_power_d");
  CHECK(*findings[0].amount == Amount{-1.5, -1.4, "D"});
  CHECK(findings[0].remedy == std::vector<Edit>{{Edit::Kind::set, "sweep", "", "min_power_d", -1.4}});

  project.glasses.lens_range_d = {-3.0, 0.45};
  findings = check_of(project);
  REQUIRE(codes(findings) == Codes{"optics.lens-range", "optics.lens-range"});
  CHECK(findings[0].where == "/slices/powers_d/2");
  CHECK(findings[1].where == "/sweep/max_power_d");
}

TEST_CASE("a measured sweep beyond the lens is one finding, whatever the sine it replaces") {
  Project project = with_sweep(-99.0, 99.0);
  project.sweep.waveform.left = project.sweep.waveform.right = triangle(-1.5, 1.5);
  CHECK(codes(check_of(project)) == Codes{});
  project.glasses.lens_range_d = {-1.0, 1.0};
  const std::vector<Finding> findings = check_of(project);
  REQUIRE(codes(findings) == Codes{"optics.lens-range"});
  CHECK(findings[0].where == "/sweep/waveform");
  CHECK(findings[0].remedy.empty());
}

TEST_CASE("a drive beyond what a lens bears") {
  // +-1.5 D about 0 at 40 D/A: 37.5 mA at the peak, 37.5 / sqrt 2 = 26.5 mA in the root mean square.
  Project project = quiet_project();
  LensLimits& limits = project.glasses.lens_limits.emplace();
  limits.max_current_a = 0.0375;
  limits.max_rms_current_a = 0.0266;
  CHECK(codes(check_of(project)) == Codes{});
  limits.max_current_a = 0.036;
  const std::vector<Finding> peak = check_of(project);
  REQUIRE(codes(peak) == Codes{"optics.lens-current"});
  CHECK(peak[0].severity == Severity::error);
  CHECK(peak[0].where == "/sweep/waveform");
  CHECK(peak[0].amount->value == doctest::Approx(0.0375).epsilon(1e-6));
  CHECK(peak[0].amount->limit == 0.036);
  // Narrowed to what 36 mA make, 1.44 D, on a grid of 0.05 D.
  REQUIRE(peak[0].remedy.size() == 2);
  const Project narrowed = *apply_all(project, peak[0].remedy);
  CHECK(narrowed.sweep.max_power_d == doctest::Approx(1.4));
  CHECK(codes(check_of(narrowed)) == Codes{});

  limits.max_current_a = 0.29;
  limits.max_rms_current_a = 0.02;
  const std::vector<Finding> hot = check_of(project);
  REQUIRE(codes(hot) == Codes{"optics.lens-current"});
  CHECK(hot[0].amount->value == doctest::Approx(0.0375 / std::sqrt(2.0)).epsilon(1e-6));
  CHECK(hot[0].message.find("root mean square") != std::string::npos);
}

TEST_CASE("a measured drive that a lens does not bear gives way to the sine") {
  Project project = quiet_project();
  MeasuredWaveform waveform;
  for (int i = 0; i < 64; ++i) {
    waveform.power_d.push_back(-1.5 * std::cos(2.0 * 3.14159265358979 * i / 64.0));
    waveform.drive_a.push_back(i == 5 ? 0.3 : 0.0);
  }
  project.sweep.waveform.right = waveform;
  const std::vector<Finding> findings = check_of(project);
  REQUIRE(codes(findings) == Codes{"optics.lens-current"});
  CHECK(findings[0].where == "/sweep/waveform/right");
  CHECK(findings[0].amount->value == doctest::Approx(0.3));
  CHECK(findings[0].amount->limit == 0.29);
  REQUIRE(findings[0].remedy.size() == 1);
  CHECK(codes(check_of(*apply_all(project, findings[0].remedy))) == Codes{});
}

TEST_CASE("a frame plays for a whole number of sweeps") {
  Project project = quiet_project();
  for (const double rate_hz : {60.0, 30.0, 20.0, 12.0, 7.5, 60.0 / 7.0, 0.1}) {
    project.frames.rate_hz = rate_hz;
    CHECK(codes(check_of(project)) == Codes{});
  }
  project.frames.rate_hz = 24.0;  // 2.5 sweeps
  std::vector<Finding> findings = check_of(project);
  REQUIRE(codes(findings) == Codes{"frames.rate"});
  CHECK(findings[0].where == "/frames/rate_hz");
  CHECK(findings[0].remedy == std::vector<Edit>{{Edit::Kind::set, "frames", "", "rate_hz", 20.0}});
  project.frames.rate_hz = 120.0;  // half a sweep
  findings = check_of(project);
  REQUIRE(codes(findings) == Codes{"frames.rate"});
  CHECK(*findings[0].amount == Amount{120.0, 60.0, "Hz"});
}

TEST_CASE("a sweep under 50 Hz flickers") {
  Project project = quiet_project();
  project.sweep.frequency_hz = project.frames.rate_hz = 50.0;
  CHECK(codes(check_of(project)) == Codes{});
  project.sweep.frequency_hz = project.frames.rate_hz = 48.0;
  const std::vector<Finding> findings = check_of(project);
  REQUIRE(codes(findings) == Codes{"safety.flicker"});
  CHECK(findings[0].severity == Severity::warning);
  CHECK(*findings[0].amount == Amount{48.0, 50.0, "Hz"});
}

TEST_CASE("a sweep that is no curve") {
  Project project = quiet_project();
  project.sweep.waveform.right = MeasuredWaveform{{0.0, 1.0, 1.0}, {}, {}};
  const std::vector<Finding> findings = check_of(project);
  REQUIRE(codes(findings) == Codes{"schedule.waveform"});
  CHECK(findings[0].where == "/sweep/waveform/right");
  CHECK_FALSE(findings[0].amount);
  CHECK(findings[0].message.find("after sample 1") != std::string::npos);
}

TEST_CASE("errors come first, then by code and place") {
  Project project = with_sweep(-2.0, 2.0);
  project.slices.powers_d = {2.5, 0.0, -1.0};
  project.frames.rate_hz = 24.0;
  const std::vector<Finding> findings = check_of(project);
  CHECK(codes(findings) == Codes{"frames.rate", "slices.outside-sweep", "slices.spacing", "schedule.smear",
                                 "schedule.smear", "slices.spacing"});
  CHECK(findings[2].severity == Severity::error);
  CHECK(findings[3].severity == Severity::warning);
  CHECK(findings[3].where < findings[4].where);
  CHECK(check_of(project) == findings);
}

TEST_CASE("an empty project is checked without complaint") {
  Project project;
  CHECK(codes(check_of(project)) == Codes{});
}
