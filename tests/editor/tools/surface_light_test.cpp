#include "editor/tools/surface_light.h"

#include <doctest/doctest.h>

#include <algorithm>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "core/mesh/measure.h"
#include "core/stage/primitive_cache.h"

using namespace focalstage;

namespace {

/// Three images of 4 x 3 pixels, each of one code.
FrameImages three_images(std::uint8_t a, std::uint8_t b, std::uint8_t c) {
  FrameImages images{3, 4, 3, 1, {}};
  for (const std::uint8_t code : {a, b, c}) images.codes.insert(images.codes.end(), 12, code);
  return images;
}

const std::vector<ImageSpec> left_right_both{{ImageEye::left}, {ImageEye::right}, {ImageEye::both}};

}  // namespace

TEST_CASE("the picture is the mean of both eyes' sums in linear light, its edge the bare tone") {
  // (1 + 0.5) / 2 + 0 with a gamma of 1: linear 0.75, sRGB code 225 (0.8808).
  const LightPicture picture = light_picture(three_images(255, 128, 0), left_right_both, 8, 1.0, 0.0);
  const auto at = [&](int x, int y) { return int(picture.rgb[static_cast<std::size_t>(3 * (y * 4 + x))]); };
  CHECK(at(1, 1) == doctest::Approx(225).epsilon(0.01));
  CHECK(at(0, 0) == 0);
  CHECK(at(3, 1) == 0);
  // An image for both eyes counts whole, and codes of two bits reach from 0 to 3; linear 1/3 is sRGB 156.
  const LightPicture few = light_picture(three_images(0, 0, 1), left_right_both, 2, 1.0, 0.0);
  CHECK(int(few.rgb[3 * 5]) == doctest::Approx(156).epsilon(0.01));
  // The tone is there everywhere; linear 0.2 is sRGB 124.
  CHECK(int(light_picture(three_images(0, 0, 0), left_right_both, 8, 1.0, 0.2).rgb[0]) ==
        doctest::Approx(124).epsilon(0.01));
}

TEST_CASE("rows are turned over: the first is the lowest") {
  FrameImages images{1, 3, 4, 1, std::vector<std::uint8_t>(12, 0)};
  images.codes[3 * 1 + 1] = 255;  // second row from the top
  const LightPicture picture = light_picture(images, {{ImageEye::both}}, 8, 1.0, 0.0);
  CHECK(int(picture.rgb[3 * (2 * 3 + 1)]) == 255);
}

TEST_CASE("cutting finely keeps area and facing, and leaves no long edge") {
  const auto plane = *primitive_mesh(PlaneMesh{{1.2, 0.8}});
  const auto fine = finely_cut(plane);
  CHECK(mesh_area_m2(*fine) == doctest::Approx(0.96));
  const double longest_m = glm::length(glm::dvec2(1.2, 0.8)) / 40.0;
  for (const glm::uvec3& t : fine->triangles) {
    const auto& p = fine->positions_m;
    CHECK(glm::length(p[t.x] - p[t.y]) < longest_m * 1.001);
    CHECK(doubled_area(p[t.x], p[t.y], p[t.z]).z > 0.0);
  }
  const auto rabbit = *primitive_mesh(RabbitMesh{});
  if (rabbit->triangles.size() > 20'000) CHECK(finely_cut(rabbit) == rabbit);
}

TEST_CASE("a projector's picture falls where its rays go, and not behind what stands in their way") {
  ProjectorModel projector;
  projector.width_px = 100;
  projector.height_px = 50;
  projector.focal_px = {100.0, 100.0};
  projector.centre_px = {50.0, 25.0};
  const auto plane = *primitive_mesh(PlaneMesh{{1.0, 0.5}});
  const glm::dmat4 wall = glm::translate(glm::dmat4(1.0), {0, 0, -1.0});  // fills the picture exactly
  Stage stage;
  StagedSurface surface;
  surface.drawables = {{plane, wall, {}}};
  stage.surfaces = {surface};
  Picker picker;
  const Mesh fine = *finely_cut(plane);
  const PinnedPicture open = pinned_picture(stage, projector, fine, wall, picker);
  for (std::size_t i = 0; i < open.uv.size(); ++i) {
    const glm::dvec2 expected(fine.positions_m[i].x + 0.5, fine.positions_m[i].y * 2.0 + 0.5);
    CHECK(glm::length(glm::dvec2(open.uv[i]) - expected) < 1e-6);
    CHECK(open.reached[i] == 1);
  }
  // A board before the left half: 0.2 m wide at half the distance shades 0.4 m.
  StagedSurface board;
  board.name = "board";
  board.drawables = {{*primitive_mesh(PlaneMesh{{0.2, 1.0}}), glm::translate(glm::dmat4(1.0), {-0.1, 0, -0.5}), {}}};
  stage.surfaces.push_back(board);
  const PinnedPicture shaded = pinned_picture(stage, projector, fine, wall, picker);
  for (std::size_t i = 0; i < shaded.uv.size(); ++i) {
    const double x = fine.positions_m[i].x;
    if (x > -0.38 && x < -0.02) CHECK(shaded.reached[i] == 0);
    if (x > 0.02 || x < -0.42) CHECK(shaded.reached[i] == 1);
  }
}
