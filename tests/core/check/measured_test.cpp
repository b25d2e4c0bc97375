// Findings about what compiling measured, from measures made by hand.

#include <doctest/doctest.h>

#include "tests/core/check/projects.h"

using namespace focalstage;
using namespace focalstage::testing;

namespace {

ObjectMeasure beyond(std::size_t object, double below_d, double above_d) {
  ObjectMeasure measure;
  measure.index = object;
  measure.samples = 200;
  measure.beyond = 50;
  measure.worst_below_d = below_d;
  measure.worst_above_d = above_d;
  measure.worst_beyond_d = std::max(below_d, above_d);
  return measure;
}

Measured with(std::vector<ObjectMeasure> objects) {
  Measured measured;
  measured.frames.resize(1);
  measured.frames[0].objects = std::move(objects);
  return measured;
}

}  // namespace

TEST_CASE("an object that wants a power beyond the slices, in its worst frame") {
  Measured measured = with({beyond(0, 0.0, 0.31)});
  measured.frames.push_back(with({beyond(0, 0.0, 0.52)}).frames[0]);
  measured.frames.push_back(with({beyond(0, 0.0, 0.4)}).frames[0]);
  const std::vector<Finding> findings = check_of(quiet_project(), measured);
  REQUIRE(codes(findings) == Codes{"depth.out-of-range"});
  CHECK(findings[0].severity == Severity::error);
  CHECK(findings[0].where == "/objects/0/depth");
  CHECK(*findings[0].amount == Amount{0.52, 0.3, "D"});
  CHECK(findings[0].message.find("frame 1") != std::string::npos);
  CHECK(findings[0].message.find("25 %") != std::string::npos);
  // One slice more, at 0.5 + 0.52 rounded out to 0.05 D; +-1.5 D shows it.
  REQUIRE(findings[0].remedy.size() == 1);
  const Value::Array* powers_d = findings[0].remedy[0].value.array();
  REQUIRE(powers_d);
  REQUIRE(powers_d->size() == 4);
  CHECK(*(*powers_d)[3].number() == doctest::Approx(1.05));
}

TEST_CASE("beyond by 0.3 D is allowed") {
  CHECK(codes(check_of(quiet_project(), with({beyond(0, 0.3, 0.0)}))) == Codes{});
}

TEST_CASE("far beyond: slices in between, and a wider sweep") {
  const std::vector<Finding> findings = check_of(quiet_project(), with({beyond(0, 1.5, 0.0)}));
  REQUIRE(codes(findings) == Codes{"depth.out-of-range"});
  const Result<Project> after = apply_all(quiet_project(), findings[0].remedy);
  REQUIRE(after.ok());
  CHECK(after->slices.powers_d.front() == doctest::Approx(-2.0));
  CHECK(after->slices.powers_d.size() == 6);
  CHECK(after->sweep.min_power_d < -2.0);
  CHECK_FALSE(has_error(check_of(*after)));
}

TEST_CASE("beyond the lens: the object is pulled in instead") {
  Project project = quiet_project();
  project.glasses.lens_range_d = {-1.5, 1.5};
  std::vector<Finding> findings = check_of(project, with({beyond(0, 1.52, 0.0)}));
  REQUIRE(codes(findings) == Codes{"depth.out-of-range"});
  REQUIRE(findings[0].remedy.size() == 1);
  Result<Project> after = apply_all(project, findings[0].remedy);
  REQUIRE(after.ok());
  // A nearer picture wants a lower power: 1.52 D too low is 1.55 D too near.
  CHECK(after->objects[0].depth.mode == DepthMode::offset);
  CHECK(after->objects[0].depth.vergence_d == doctest::Approx(-1.55));

  project.objects[0].depth.mode = DepthMode::fixed;
  project.objects[0].depth.vergence_d = 1.0;
  findings = check_of(project, with({beyond(0, 0.0, 1.5)}));
  after = apply_all(project, findings.at(0).remedy);
  REQUIRE(after.ok());
  CHECK(after->objects[0].depth.mode == DepthMode::fixed);
  CHECK(after->objects[0].depth.vergence_d == doctest::Approx(2.5));

  findings = check_of(project, with({beyond(0, 1.5, 1.5)}));  // too deep for any shift
  REQUIRE(codes(findings) == Codes{"depth.out-of-range"});
  CHECK(findings[0].remedy.empty());
}

TEST_CASE("an object told to focus in a slice that is not there") {
  Project project = quiet_project();
  project.objects[0].depth.mode = DepthMode::slice;
  project.objects[0].depth.index = 2;
  CHECK(codes(check_of(project)) == Codes{});
  project.objects[0].depth.index = 3;
  const std::vector<Finding> findings = check_of(project);
  REQUIRE(codes(findings) == Codes{"depth.out-of-range"});
  CHECK(findings[0].where == "/objects/0/depth/index");
  const Result<Project> after = apply_all(project, findings[0].remedy);
  REQUIRE(after.ok());
  CHECK(after->objects[0].depth.index == 2);
}

TEST_CASE("looks that cannot be served, by object, the worst frame of each") {
  ObjectCoverage some;
  some.index = 0;
  some.looks = 1000;
  some.off_surface = 10;
  some.outside_lens = 5;
  ObjectCoverage more = some;
  more.off_surface = 250;
  more.outside_lens = 0;
  more.outside_projector = 1;
  Measured measured;
  measured.coverage = {{some}, {more}};
  const std::vector<Finding> findings = check_of(quiet_project(), measured);
  REQUIRE(codes(findings) == Codes{"view.off-surface", "view.outside-lens", "view.outside-projector"});
  for (const Finding& finding : findings) {
    CHECK(finding.severity == Severity::warning);
    CHECK(finding.where == "/objects/0");
    CHECK(finding.remedy.empty());
  }
  CHECK(*findings[0].amount == Amount{0.25, 0.0, "share"});
  CHECK(*findings[1].amount == Amount{0.005, 0.0, "share"});
  CHECK(*findings[2].amount == Amount{0.001, 0.0, "share"});
  CHECK(findings[0].message.find("25 % of object \"near\"") == 0);
}

TEST_CASE("light and focus of the projector, with the share of pixels") {
  Measured measured;
  measured.frames.resize(2);
  measured.frames[0].lit_pixels = 400;
  measured.frames[0].clipped_pixels = 4;
  measured.frames[1].lit_pixels = 0;  // a black frame has no share
  measured.frames[1].surface_pixels = 800;
  measured.frames[1].defocused_pixels = 200;
  measured.frames[1].worst_defocus_d = 0.7;
  Project project = quiet_project();
  project.projectors[0].focus_m = 0.6;
  project.projectors[0].depth_of_field_d = 0.4;
  const std::vector<Finding> findings = check_of(project, measured);
  REQUIRE(codes(findings) == Codes{"light.clipped", "projector.defocus"});
  CHECK(*findings[0].amount == Amount{0.01, 0.0, "share"});
  CHECK(findings[1].where == "/projectors/0/focus_m");
  CHECK(*findings[1].amount == Amount{0.25, 0.0, "share"});
  CHECK(findings[1].message.find("0.7 D") != std::string::npos);
  CHECK(findings[0].severity == Severity::warning);
}

namespace {

/// What one object needs that wants every power from `low_d` to `high_d`.
Needs needs_from(double low_d, double high_d) {
  ObjectNeeds object;
  object.looks = 100;
  for (double power_d = low_d; power_d <= high_d + 1e-9; power_d += 0.01) object.powers.left.add(power_d, 1);
  return {{object}};
}

}  // namespace

TEST_CASE("slices too dense for the sweep that the outer ones want: the solver's proposal for all frames") {
  // Three slices 0.3 D apart follow each other in 0.53 ms of a sweep of +-1.5 D. Outer ones want +-1.75 D, in which
  // they follow in 0.45 ms, and no shift of the object serves both sides.
  Project project = quiet_project();
  project.slices.powers_d = {-0.3, 0.0, 0.3};
  REQUIRE(codes(check_of(project)) == Codes{});
  Measured measured = with({beyond(0, 1.0, 1.0)});
  CHECK(check_of(project, measured).at(0).remedy.empty());
  measured.needs = needs_from(-1.3, 1.3);
  const std::vector<Finding> findings = check_of(project, measured);
  REQUIRE(codes(findings) == Codes{"depth.out-of-range"});
  REQUIRE_FALSE(findings[0].remedy.empty());
  const Result<Project> after = apply_all(project, findings[0].remedy);
  REQUIRE(after);
  CHECK_FALSE(has_error(check_of(*after)));
  CHECK(after->slices.powers_d.front() <= -1.3 + 0.3);
  CHECK(after->slices.powers_d.back() >= 1.3 - 0.3);

  measured.needs = needs_from(-5.0, 5.0);  // what the rig cannot do is not offered
  CHECK(check_of(project, measured).at(0).remedy.empty());
}

TEST_CASE("needs help only where slices and sweep do not reach") {
  CHECK(needs_would_help(check_of(quiet_project(), with({beyond(0, 0.0, 0.5)}))));
  CHECK_FALSE(needs_would_help({}));
  Project project = quiet_project();
  project.sweep.frequency_hz = 45;
  project.frames.rate_hz = 45;
  CHECK(codes(check_of(project)) == Codes{"safety.flicker"});
  CHECK_FALSE(needs_would_help(check_of(project)));
}
