#include "core/check/rig_differences.h"

#include <doctest/doctest.h>

#include "tests/core/check/projects.h"

using namespace focalstage;
using namespace focalstage::testing;

namespace {

LensResponse lagging(double gain_d_per_a, double phase_deg) {
  return {{0, 40.0, 0.0, {}}, {1, gain_d_per_a, phase_deg, {}}};
}

/// The rig that the quiet project was made for.
RigValues same_rig(const Project& project) {
  RigValues rig;
  rig.lens_response = project.glasses.lens_response;
  rig.latency_ms = project.projectors[0].latency_ms;
  return rig;
}

void check_adopted(const Project& project, const RigValues& rig) {
  Project adopted = project;
  for (const Finding& finding : rig_differences(project, rig)) {
    REQUIRE_FALSE(finding.remedy.empty());
    const Result<Project> next = apply_all(adopted, finding.remedy);
    REQUIRE(next.ok());
    adopted = *next;
  }
  CHECK(rig_differences(adopted, rig).empty());
}

}  // namespace

TEST_CASE("a project on its own rig does not differ") {
  Project project = quiet_project();
  CHECK(rig_differences(project, same_rig(project)).empty());
  project.glasses.lens_response.left = lagging(38.0, -14.0);
  CHECK(rig_differences(project, same_rig(project)).empty());
  project.projectors.clear();
  CHECK(rig_differences(project, RigValues{}).size() == 1);  // the lens alone
}

TEST_CASE("a lens differs when it would be off by more than 0.02 D on the project's drive") {
  const Project project = quiet_project();  // 1.5 D of amplitude
  RigValues rig = same_rig(project);
  rig.lens_response.left = lagging(40.0 * (1.0 - 0.019 / 1.5), 0.0);  // 0.019 D short
  CHECK(rig_differences(project, rig).empty());
  rig.lens_response.left = lagging(40.0 * (1.0 - 0.021 / 1.5), 0.0);
  std::vector<Finding> findings = rig_differences(project, rig);
  REQUIRE(codes(findings) == Codes{"rig.differs"});
  CHECK(findings[0].severity == Severity::error);
  CHECK(findings[0].where == "/glasses/lens_response");
  CHECK(findings[0].amount->value == doctest::Approx(0.021).epsilon(1e-6));
  CHECK(findings[0].amount->limit == 0.02);
  check_adopted(project, rig);

  // A lag of p degrees is off by 2 * 1.5 * sin(p/2): one degree by 0.02618 D.
  rig.lens_response.left = {};
  rig.lens_response.right = lagging(40.0, -1.0);
  findings = rig_differences(project, rig);
  REQUIRE(codes(findings) == Codes{"rig.differs"});
  CHECK(findings[0].amount->value == doctest::Approx(0.0261796).epsilon(1e-4));
  check_adopted(project, rig);
}

TEST_CASE("a harmonic that the sweep does not contain makes no difference") {
  const Project project = quiet_project();
  RigValues rig = same_rig(project);
  rig.lens_response.left = {{2, 10.0, -90.0, {}}};
  CHECK(rig_differences(project, rig).empty());
}

TEST_CASE("a drive measured on another lens has to be measured anew") {
  Project project = quiet_project();
  MeasuredWaveform waveform;
  for (int i = 0; i < 20; ++i) {
    waveform.power_d.push_back(-1.5 + 0.3 * (i <= 10 ? i : 20 - i));
    waveform.drive_a.push_back(waveform.power_d.back() / 40.0);
  }
  project.sweep.waveform = {waveform, waveform};
  RigValues rig = same_rig(project);
  CHECK(rig_differences(project, rig).empty());
  rig.lens_response.left = rig.lens_response.right = lagging(36.0, 0.0);
  const std::vector<Finding> findings = rig_differences(project, rig);
  REQUIRE(codes(findings) == Codes{"rig.differs"});
  CHECK(findings[0].remedy.empty());
}

TEST_CASE("latency, shutters and exposure differ from 20 us on, image sizes at all") {
  Project project = quiet_project();
  RigValues rig = same_rig(project);
  rig.latency_ms += 0.02;
  rig.shutter_open_ms += 0.0199;
  rig.exposure_ms = 0.48;
  CHECK(rig_differences(project, rig).empty());
  rig.latency_ms = 0.171;
  rig.shutter_open_ms = 2.9;
  rig.shutter_close_ms = 0.15;
  rig.exposure_ms = 0.4;
  rig.width_px = 912;
  rig.height_px = 1140;
  rig.pixel_layout = PixelLayout::diamond;
  const std::vector<Finding> findings = rig_differences(project, rig);
  std::vector<std::string> where;
  for (const Finding& finding : findings) where.push_back(finding.where);
  CHECK(where == Codes{"/glasses/shutter_close_ms", "/glasses/shutter_open_ms", "/projectors/0/frames_per_second",
                       "/projectors/0/height_px", "/projectors/0/latency_ms", "/projectors/0/pixel_layout",
                       "/projectors/0/width_px"});
  CHECK(findings[4].amount->value == doctest::Approx(0.021));
  CHECK(findings[4].amount->unit == "ms");
  check_adopted(project, rig);
}
