#include "core/retina/half_columns.h"

#include <doctest/doctest.h>

#include <vector>

#include "tests/core/retina/rig.h"
#include "tests/support/chance.h"

using namespace focalstage;

TEST_CASE("half columns light every place as the diamond lattice does") {
  for (const int channels : {1, 3}) {
    ProjectorModel projector = retina_test::projector_at({0.1, 0.2, 0.0}, 20.0, 13, 9);
    projector.layout = PixelLayout::diamond;
    projector.focal_px.y *= 2.0;
    projector.distortion = {-0.05, 0.01, 0.002, -0.001};
    std::vector<std::uint8_t> codes(static_cast<std::size_t>(13 * 9 * channels));
    for (std::size_t i = 0; i < codes.size(); ++i) codes[i] = static_cast<std::uint8_t>(1 + i % 255);
    RetinaInput input;
    input.projector = projector;
    input.channels = channels;
    input.projector_focus = {1.0, 0.5};
    input.exposures = {retina_test::shown(codes, 0.0), retina_test::shown(codes, 1.0)};
    const HalfColumns halves(input);
    const ProjectorModel& square = halves.input().projector;
    CHECK(square.layout == PixelLayout::square);
    CHECK(square.focal_px.x == square.focal_px.y);
    CHECK(halves.input().projector_focus.depth_of_field_d == 0.25);
    REQUIRE(halves.input().exposures.size() == 2);

    const auto code_at = [&](const ProjectorModel& model, std::span<const std::uint8_t> from,
                             const glm::dvec2& tangent) {
      const glm::dvec2 pixel = pixel_of_tangent(model, tangent);
      if (!(pixel.x >= 0.0 && pixel.x < model.width_px && pixel.y >= 0.0 && pixel.y < model.height_px)) return 0;
      const int first = static_cast<int>(pixel.y) * model.width_px + static_cast<int>(pixel.x);
      return static_cast<int>(from[static_cast<std::size_t>(first * channels + channels - 1)]);
    };
    support::Chance chance(7);
    int lit = 0;
    for (int i = 0; i < 4000; ++i) {
      const glm::dvec2 tangent{chance.between(-0.45, 0.45), chance.between(-0.2, 0.2)};
      const int expected = code_at(projector, codes, tangent);
      CHECK(code_at(square, halves.input().exposures[1].codes, tangent) == expected);
      lit += expected > 0 ? 1 : 0;
    }
    CHECK(lit > 1000);
    CHECK(lit < 4000);
  }
}
