#include "core/percept/conflict.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "core/percept/thing_look.h"
#include "tests/core/retina/rig.h"

using namespace focalstage;
using namespace focalstage::retina_test;

namespace {

/// A checkered card 0.8 m from the pupils on a screen 0.5 m from the lenses, shown at `vergence_d`.
struct Card {
  Stage stage = screen_stage();
  CompileSettings settings;
  CompiledFrame frame;
  RetinaView view;

  explicit Card(double vergence_d, std::vector<double> powers_d = {-1.0, -0.5, 0.0, 0.5, 1.0}) {
    settings.projector = projector_at({0.1, 0.2, 0.0}, 1400.0, 1024, 768);
    Project project;
    project.slices.powers_d = std::move(powers_d);
    settings.slices = project.slices;
    settings.images = image_plan(project);
    Drawable square = support::standing(support::rectangle({0.2, 0.2}), {{0.0, 0.0, -0.815}, {1, 0, 0, 0}});
    square.finish.kind = Finish::Kind::checker;
    square.finish.squares = {16, 16};
    Depth depth;
    depth.mode = DepthMode::fixed;
    depth.vergence_d = vergence_d;
    StagedObject card = support::object_of(square, depth);
    card.name = "card";
    stage.objects = {card};
    frame = *Compiler(settings).frame(stage);
    view.fov_deg = 20.0;
  }
  RetinaInput input() const { return input_of(stage, settings, frame, Side::left); }
};

}  // namespace

TEST_CASE("what is shown where it stands has no conflict; what is shown elsewhere has as much as it was moved") {
  for (const double vergence_d : {1.0, 1.25, 1.6, 2.4}) {
    const Card card(vergence_d);
    Retina retina;
    const auto focus = retina.driven_focus(card.input(), card.view);
    REQUIRE(focus);
    const ThingMap things = things_seen(card.input(), card.view, {});
    REQUIRE(things.things.size() == 2);
    CHECK(things.things[0].name == "card");
    const std::vector<ThingConflict> conflicts = thing_conflicts(things, *focus);
    INFO("shown at " << vergence_d << " D");
    CHECK(conflicts[0].mean_d == doctest::Approx(1.25 - vergence_d).epsilon(0.01));  // it stands at 1 / 0.8
    CHECK(std::abs(conflicts[0].beyond_comfort - (std::abs(1.25 - vergence_d) > comfort_d ? 1.0 : 0.0)) < 0.01);
  }
}

TEST_CASE("the driven focus is where the focal stack peaks") {
  for (const double vergence_d : {1.25, 2.0, 2.7}) {
    const Card card(vergence_d);
    Retina retina;
    const auto focus = retina.driven_focus(card.input(), card.view);
    const ThingMap things = things_seen(card.input(), card.view, {});
    const double driven_d = 1.25 - thing_conflicts(things, *focus)[0].mean_d;
    RetinaView sharp = card.view;
    sharp.pupil_m = 0.0;
    const auto pinhole = retina.view(card.input(), sharp);
    double best_d = 0.0, best = 0.0;
    for (double focus_d = 0.5; focus_d < 3.5; focus_d += 0.05) {
      RetinaView view = card.view;
      view.focus_d = focus_d;
      const auto image = retina.view(card.input(), view);
      const double own = thing_looks(things, *image, *pinhole, *focus, card.input(), view)[0].sharpness;
      if (own > best) best_d = focus_d;
      best = std::max(best, own);
    }
    INFO("shown at " << vergence_d << " D, driven " << driven_d << ", sharpest at " << best_d);
    CHECK(std::abs(best_d - driven_d) < 0.2);
    CHECK(best > 0.8);
  }
}

TEST_CASE("blur is the pupil's disc, and luminance the projector's flux by its pixels on the screen") {
  const Card card(2.0, {0.0});
  Retina retina;
  RetinaView view = card.view;
  view.focus_d = 3.0;
  const auto focus = retina.driven_focus(card.input(), view);
  const auto image = retina.view(card.input(), view);
  ProjectorFlux flux{330.0, 0.03};
  const ThingMap things = things_seen(card.input(), view, flux);
  const ThingLook look = thing_looks(things, *image, *image, *focus, card.input(), view)[0];
  // Pictures at 2 D from the lens, 2 / 1.03 from the pupil; focus at 3 / 1.045.
  const double radius = 0.002 * (3.0 / 1.045 - 2.0 / 1.03);
  CHECK(look.blur_radius_arcmin == doctest::Approx(radius * 60.0 * 180.0 / M_PI).epsilon(0.01));
  CHECK(look.sharpness == doctest::Approx(1.0));  // held against itself
  // Straight ahead the pixel's solid angle is 1 / 1400^2 at the screen's distance from the projector, turned by cos.
  const glm::dvec3 way = glm::dvec3(0.0, 0.0, -screen_m) - glm::dvec3(0.1, 0.2, 0.0);
  const double distance_m = glm::length(way), cosine = screen_m / distance_m;
  const double lux = 330.0 * 0.03 / (1024.0 * 768.0) * 1400.0 * 1400.0 * cosine / (distance_m * distance_m);
  const glm::dvec2 straight = pixel_of_look(view, {0.0315 / screen_m, 0.0});
  const std::size_t pixel = static_cast<std::size_t>(straight.y) * 400 + static_cast<std::size_t>(straight.x);
  CHECK(things.candela_per_light[pixel] == doctest::Approx(lux / M_PI).epsilon(0.01));
}

TEST_CASE("an empty stage has no things, and dark ones no conflict") {
  const Stage empty;
  RetinaInput input = input_of(empty, projector_at({0.0, 0.1, 0.0}, 900.0, 64, 48));
  RetinaView view;
  const auto focus = Retina().driven_focus(input, view);
  REQUIRE(focus);
  CHECK(thing_conflicts(things_seen(input, view, {}), *focus).empty());
  const Stage screen = screen_stage();
  input.stage = &screen;
  const auto dark = Retina().driven_focus(input, view);
  const std::vector<ThingConflict> conflicts = thing_conflicts(things_seen(input, view, {}), *dark);
  REQUIRE(conflicts.size() == 1);
  CHECK(conflicts[0].light == 0.0);
}
