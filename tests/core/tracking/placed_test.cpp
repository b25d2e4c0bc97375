#include "core/tracking/placed.h"

#include <doctest/doctest.h>

using namespace focalstage;

namespace {

Project tracked_project() {
  Project project;
  project.viewer.placement.track = "Head";
  Surface screen;
  screen.name = "screen";
  screen.placement.pose.position_m = {0, 0, -1};
  Surface card;
  card.name = "card";
  card.placement.track = "Card";
  card.placement.keys = {{0.0, {}, {}}, {1.0, {{1, 1, 1}, {}}, {}}};
  project.surfaces = {screen, card};
  Object rabbit;
  rabbit.name = "rabbit";
  rabbit.placement.track = "Card";
  project.objects = {rabbit};
  return project;
}

const Rigid head{{0, 1.6, 0.5}, {}};
const Rigid card{{0.2, 1.0, -0.4}, glm::angleAxis(0.5, glm::dvec3(0, 1, 0))};

}  // namespace

TEST_CASE("tracked things stand where their bodies are, the others where they stood") {
  const Project project = tracked_project();
  CHECK(bodies_of(project) == std::set<std::string>{"Card", "Head"});
  const Rigid mount{{0, 0, 0.01}, glm::angleAxis(0.1, glm::dvec3(1, 0, 0))};
  const auto now = placed(project, {{"Head", head}, {"Card", card}, {"Lamp", std::nullopt}}, {{"Card", mount}});
  REQUIRE(now);
  CHECK(now->viewer.placement.pose == head);
  CHECK(now->surfaces[0] == project.surfaces[0]);
  CHECK(now->surfaces[1].placement.pose == card * mount);
  CHECK(now->surfaces[1].placement.keys.empty());
  CHECK(now->surfaces[1].placement.track == "Card");
  CHECK(now->objects[0].placement.pose == card * mount);
  // A point a centimetre before the body, by hand.
  const glm::dvec3 origin = now->objects[0].placement.pose.position_m;
  CHECK(glm::distance(origin, card.position_m + 0.01 * glm::dvec3(std::sin(0.5), 0, std::cos(0.5))) < 1e-15);
}

TEST_CASE("a body that the tracker does not know, or does not see, is named with its place") {
  const Project project = tracked_project();
  const auto unknown = placed(project, {{"Head", head}, {"Cart", card}});
  REQUIRE_FALSE(unknown);
  CHECK(unknown.fault().code == "track.unknown");
  CHECK(unknown.fault().where == "/surfaces/1/track");
  CHECK(unknown.fault().message == "the tracker knows no body named Card");
  CHECK(unknown.fault().remedy == "its bodies: Cart, Head");
  const auto unseen = placed(project, {{"Head", std::nullopt}, {"Card", card}});
  REQUIRE_FALSE(unseen);
  CHECK(unseen.fault().code == "track.unseen");
  CHECK(unseen.fault().where == "/viewer/track");
  CHECK(unseen.fault().message == "the tracker does not see Head now");
}

TEST_CASE("a hidden thing asks for no body") {
  Project project = tracked_project();
  project.surfaces[1].hidden = true;
  project.objects[0].hidden = true;
  CHECK(bodies_of(project) == std::set<std::string>{"Head"});
  CHECK(placed(project, {{"Head", head}}).ok());
  CHECK(bodies_of(Project{}).empty());
  CHECK(placed(Project{}, {}).ok());
}
