#include "core/sensitivity/sensitivity.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <doctest/doctest.h>

namespace focalstage {
namespace {

constexpr double arcmin = 3.14159265358979323846 / 180.0 / 60.0;

/// A screen half a metre before the eyes, a small card 50 mm before it, the projector 0.3 m above the viewer.
Project one_card() {
  Project project;
  project.name = "card";
  project.projectors.emplace_back();
  project.projectors[0].name = "main";
  project.projectors[0].pose.position_m = {0.0, 0.3, 0.0};
  project.projectors[0].pose.rotation = glm::dquat(std::cos(-0.25), std::sin(-0.25), 0.0, 0.0);
  project.slices.powers_d = {-1.0, -0.5, 0.0, 0.5};
  Surface screen;
  screen.name = "screen";
  screen.mesh.shape = PlaneMesh{{1.0, 1.0}};
  screen.placement.pose.position_m = {0.0, 0.0, -0.5};
  project.surfaces.push_back(screen);
  Object card;
  card.name = "card";
  card.mesh.shape = PlaneMesh{{0.02, 0.02}};
  card.placement.pose.position_m = {0.0, 0.0, -0.45};
  project.objects.push_back(card);
  return project;
}

ErrorEffect effect_of(const Project& project, const std::string& what) {
  const auto effects = sensitivity(project, {});
  REQUIRE(effects);
  const auto found = std::ranges::find(*effects, what, [](const ErrorEffect& effect) { return effect.error.what; });
  REQUIRE_MESSAGE(found != effects->end(), what);
  return *found;
}

TEST_CASE("a screen that stands aside takes the picture along where the projector is alone with it") {
  // The light stays where it falls in the room as long as the screen moves within its own plane.
  const Project project = one_card();
  CHECK(effect_of(project, "screen along x").shift_arcmin < 0.02);
  CHECK(effect_of(project, "screen along y").shift_arcmin < 0.02);
  // Back and forth: light that comes from 0.3 m above is met lower or higher by 0.3 / 0.5 mm, seen at half a metre.
  const ErrorEffect depth = effect_of(project, "screen along z");
  CHECK(depth.shift_arcmin * arcmin == doctest::Approx(1e-3 * 0.3 / 0.5 / 0.5).epsilon(0.12));
  // And a millimetre of 485 is 1 / 0.485^2 of a thousandth of a dioptre.
  CHECK(depth.focus_d == doctest::Approx(1e-3 / (0.485 * 0.485)).epsilon(0.03));
  CHECK(depth.object == "card");
}

TEST_CASE("a viewer who stands aside sees the picture move against the object by parallax alone") {
  // Light and card stand in the room: what is seen through the card's place is the difference of 1/0.45 and 1/0.5.
  const ErrorEffect aside = effect_of(one_card(), "viewer along x");
  CHECK(aside.shift_arcmin * arcmin == doctest::Approx(1e-3 * (1.0 / 0.45 - 1.0 / 0.5)).epsilon(0.15));
  CHECK(aside.vergence_d < 0.01);
}

TEST_CASE("a wider pair of eyes sees the card nearer or further by what its two pictures part") {
  // Each eye moves half a millimetre: both pictures part by 1 mm (1/0.45 - 1/0.5), over 64 mm.
  const ErrorEffect wider = effect_of(one_card(), "interpupillary distance");
  CHECK(wider.vergence_d == doctest::Approx(1e-3 * (1.0 / 0.45 - 1.0 / 0.5) / 0.064).epsilon(0.15));
}

TEST_CASE("a lens that has a tenth of a dioptre more puts every picture a tenth further off") {
  const ErrorEffect power = effect_of(one_card(), "lens power");
  CHECK(power.focus_d == doctest::Approx(0.1));
  // Looks stretch by about 1 + v d_e: of 0.035 aside, a thousandth and a half.
  CHECK(power.shift_arcmin * arcmin < 0.1 * 0.015 * 0.1);
  CHECK(power.shift_arcmin * arcmin > 0.1 * 0.015 * 0.03);
}

TEST_CASE("a projector turned by a degree moves all by a degree of its own") {
  const double away_m = std::hypot(0.5, 0.3);
  const ErrorEffect turned = effect_of(one_card(), "main turned about y");
  CHECK(turned.shift_arcmin * arcmin == doctest::Approx(away_m * 0.01745 / 0.5).epsilon(0.1));
}

TEST_CASE("late light counts where something moves, by the way it goes meanwhile") {
  Project project = one_card();
  const auto all = sensitivity(project, {});
  REQUIRE(all);
  CHECK(std::ranges::none_of(*all, [](const ErrorEffect& effect) { return effect.error.what == "light late"; }));
  project.frames = {60, 60.0, {}};
  for (const double time_s : {0.0, 1.0}) {
    Keyframe key;
    key.time_s = time_s;
    key.pose.position_m = {0.1 * time_s, 0.0, -0.45};
    project.objects[0].placement.keys.push_back(key);
  }
  // 0.1 m/s for a millisecond at 0.45 m.
  CHECK(effect_of(project, "light late").shift_arcmin * arcmin == doctest::Approx(1e-4 / 0.45).epsilon(0.06));
}

TEST_CASE("a rig in which several things are off has each where it really is; what is not there is as it is said") {
  Project project;
  project.viewer.interpupillary_mm = 63.0;
  project.projectors.emplace_back();
  project.projectors[0].name = "main";
  project.projectors[0].pose = {{1.0, 2.0, 3.0}, glm::angleAxis(std::numbers::pi / 2.0, glm::dvec3(0.0, 1.0, 0.0))};
  const RealRig real = real_rig(project, {{"main along z", -4.0},
                                          {"viewer turned about y", 30.0},
                                          {"interpupillary distance", 2.5},
                                          {"lens power", 0.25},
                                          {"a screen along x", 9.0}});
  const glm::dvec3 at_m = real.project.projectors[0].pose.position_m;  // its own z points along the room's x
  CHECK(at_m.x == doctest::Approx(1.0 - 0.004));
  CHECK(at_m.z == doctest::Approx(3.0));
  CHECK(glm::degrees(glm::angle(real.project.viewer.placement.pose.rotation)) == doctest::Approx(30.0));
  CHECK(real.project.viewer.interpupillary_mm == 65.5);
  CHECK(real.power_d == doctest::Approx(0.25));
  CHECK(real.late_s == 0.0);
  CHECK(real_rig(project, {}).project == project);
}

TEST_CASE("what cannot be looked at is said; what is hidden, or off the picture, is not looked at") {
  Project project = one_card();
  project.surfaces[0].hidden = true;
  const auto nothing = sensitivity(project, {});
  REQUIRE(nothing);
  for (const ErrorEffect& effect : *nothing) {
    CHECK(effect.object.empty());
    CHECK(effect.error.what.find("screen") == std::string::npos);
  }
  project.projectors.clear();
  REQUIRE(!sensitivity(project, {}));
  CHECK(sensitivity(project, {}).fault().code == "project.no-projector");
}

}  // namespace
}  // namespace focalstage
