// A remedy, applied, clears its finding and brings no error.

#include <doctest/doctest.h>

#include <functional>
#include <random>

#include "core/scene/edit.h"
#include "tests/core/check/projects.h"

using namespace focalstage;
using namespace focalstage::testing;

namespace {

std::size_t errors(const std::vector<Finding>& findings) {
  return static_cast<std::size_t>(std::count_if(
      findings.begin(), findings.end(), [](const Finding& finding) { return finding.severity == Severity::error; }));
}

void check_remedy(const Project& project, const Finding& finding) {
  CAPTURE(finding.code);
  CAPTURE(finding.where);
  CAPTURE(finding.message);
  const std::vector<Finding> before = check_of(project);
  const Result<Project> after = apply_all(project, finding.remedy);
  REQUIRE_MESSAGE(after.ok(), (after.ok() ? std::string() : describe(after.fault())));
  const std::vector<Finding> left = check_of(*after);
  CHECK(count(left, finding.code) < count(before, finding.code));
  CHECK(errors(left) <= errors(before));
}

/// Exactly `code`, and a remedy for it that leaves neither it nor an error.
void check_code(const std::string& code, const std::function<void(Project&)>& spoil) {
  Project project = quiet_project();
  spoil(project);
  const std::vector<Finding> findings = check_of(project);
  REQUIRE_FALSE(findings.empty());
  for (const Finding& finding : findings) {
    CHECK(finding.code == code);
    CHECK_FALSE(finding.remedy.empty());
    check_remedy(project, finding);
  }
  const Result<Project> after = apply_all(project, findings[0].remedy);
  REQUIRE(after.ok());
  if (findings.size() == 1) CHECK(count(check_of(*after), code) == 0);
  CHECK_FALSE((findings.size() == 1 && has_error(check_of(*after))));
}

}  // namespace

TEST_CASE("every planned finding has a remedy that clears it") {
  check_code("slices.spacing", [](Project& p) { p.slices.powers_d = {-1.0, 0.0, 1.0}; });
  check_code("slices.spacing", [](Project& p) { p.slices.powers_d = {1.0, -0.9}; });
  check_code("slices.outside-sweep", [](Project& p) { p.slices.powers_d = {-0.5, 0.0, 0.5, 1.0, 1.55}; });
  check_code("schedule.hidden-by-shutter", [](Project& p) { p.slices.powers_d = {0.1, 0.7, 1.2}; });
  check_code("schedule.hidden-by-shutter", [](Project& p) { p.glasses.shutter_open_ms = 6.2; });
  check_code("schedule.overlap", [](Project& p) { p.slices.powers_d = {-0.5, 0.0, 0.22, 0.5}; });
  check_code("schedule.overlap", [](Project& p) { p.slices.powers_d = {-0.5, 0.0, 0.0, 0.5}; });
  check_code("schedule.overlap", [](Project& p) {
    p.projectors[0].exposure_ms = 0.51, p.slices.powers_d = {0.0, 0.285};
  });
  check_code("schedule.smear", [](Project& p) { p.sweep.max_power_d = 2.0; });
  check_code("schedule.bit-depth", [](Project& p) { p.projectors[0].frames_per_second = 2841.0; });
  check_code("schedule.bit-depth", [](Project& p) { p.projectors[0].exposure_ms = 0.3; });
  check_code("schedule.bit-depth", [](Project& p) { p.projectors[0].color = ColorMode::rgb; });
  check_code("schedule.no-zero-crossing", [](Project& p) {
    p.sweep.min_power_d = -2.25, p.sweep.max_power_d = -0.1;
    p.slices.powers_d = {-1.5, -1.0};
    p.surfaces[0].illumination = 1.0;
  });
  check_code("schedule.waveform", [](Project& p) {
    p.sweep.waveform.left = MeasuredWaveform{{0.0, 1.0, 1.0}, {0.0, 0.0, 0.0}, {}};
  });
  check_code("optics.lens-range", [](Project& p) { p.glasses.lens_range_d = {-1.4, 1.3}; });
  check_code("frames.rate", [](Project& p) { p.frames.rate_hz = 45.0; });
  check_code("safety.flicker", [](Project& p) { p.sweep.frequency_hz = p.frames.rate_hz = 40.0; });
  check_code("safety.flicker", [](Project& p) { p.sweep.frequency_hz = 48.0, p.frames.rate_hz = 24.0; });
}

TEST_CASE("dropping or adding a slice leaves objects in the slice they were told") {
  Project project = quiet_project();
  project.slices.powers_d = {-0.5, 0.0, 0.0, 0.5};
  project.objects[0].depth.mode = DepthMode::slice;
  project.objects[0].depth.index = 3;
  Result<Project> after = apply_all(project, check_of(project).at(0).remedy);
  REQUIRE(after.ok());
  CHECK(after->slices.powers_d[static_cast<std::size_t>(after->objects[0].depth.index)] == 0.5);

  project.slices.powers_d = {-0.5, 0.4};
  project.objects[0].depth.index = 1;
  after = apply_all(project, check_of(project).at(0).remedy);
  REQUIRE(after.ok());
  CHECK(after->slices.powers_d.size() == 3);
  CHECK(after->slices.powers_d[static_cast<std::size_t>(after->objects[0].depth.index)] == 0.4);
}

TEST_CASE("an error out of the lens's reach can only go") {
  Project project = quiet_project();
  project.glasses.lens_range_d = {-1.5, 1.5};
  project.slices.powers_d = {-0.5, 0.0, 0.5, 1.1, 1.4};
  const std::vector<Finding> findings = check_of(project);
  REQUIRE(codes(findings) == Codes{"schedule.hidden-by-shutter"});
  CHECK(findings[0].remedy ==
        std::vector<Edit>{{Edit::Kind::set, "slices", "", "powers_d", Value(Value::Array{-0.5, 0.0, 0.5, 1.1})}});
  project.objects[0].depth.mode = DepthMode::slice;
  project.objects[0].depth.index = 4;  // and not even that where an object needs it
  CHECK(check_of(project).at(0).remedy.empty());
}

TEST_CASE("whatever is wrong, an offered remedy helps") {
  std::mt19937 random(20240607);
  const auto uniform = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
  std::size_t offered = 0;
  for (int round = 0; round < 300; ++round) {
    Project project = quiet_project();
    const double middle_d = uniform(-3.0, 3.0);
    const double amplitude_d = uniform(0.2, 4.0);
    project.sweep.min_power_d = middle_d - amplitude_d;
    project.sweep.max_power_d = middle_d + amplitude_d;
    project.sweep.frequency_hz = uniform(40.0, 80.0);
    project.frames.rate_hz = project.sweep.frequency_hz / std::round(uniform(0.6, 4.4));
    if (round % 7 == 0) project.frames.rate_hz *= 1.3;
    project.glasses.shutter_open_ms = uniform(0.0, 4.0);
    project.glasses.lens_range_d = {-uniform(1.0, 10.0), uniform(1.0, 10.0)};
    project.slices.powers_d.clear();
    for (int i = 0; i < 1 + round % 6; ++i) {
      project.slices.powers_d.push_back(std::round(uniform(-1.2, 1.2) * amplitude_d * 20.0 + middle_d * 20.0) / 20.0);
    }
    project.surfaces[0].illumination = round % 3 == 0 ? 0.5 : 0.0;
    project.projectors[0].frames_per_second = uniform(500.0, 3500.0);
    if (round % 5 == 0) project.projectors[0].exposure_ms = uniform(0.2, 2.0);
    CAPTURE(round);
    for (const Finding& finding : check_of(project)) {
      if (finding.remedy.empty()) continue;
      ++offered;
      check_remedy(project, finding);
    }
  }
  CHECK(offered > 500);
}
