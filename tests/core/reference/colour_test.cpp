#include "core/reference/colour.h"

#include <doctest/doctest.h>

#include <initializer_list>

using namespace focalstage;

namespace {

/// Rows from the top: white, black over black, black.
Texture corner_lit(Wrap wrap) {
  Texture texture{2, 2, std::vector<std::uint8_t>(16, 0), wrap, wrap};
  texture.rgba[0] = texture.rgba[1] = texture.rgba[2] = 255;
  return texture;
}

/// The triangle (0,0) (1,0) (0,1) at z = 0, UV as position.
Drawable triangle() {
  auto mesh = std::make_shared<Mesh>();
  mesh->positions_m = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh->uvs = {{0, 0}, {1, 0}, {0, 1}};
  mesh->triangles.emplace_back(0, 1, 2);
  return {mesh, glm::dmat4(1.0), {}};
}

}  // namespace

TEST_CASE("texel centres carry the texel, half-way lies the mean of the light and not of the codes") {
  const Texture texture = corner_lit(Wrap::clamp);
  CHECK(texture_colour(texture, {0.25, 0.75}).x == 1.0);  // the upper left texel: v runs up
  CHECK(texture_colour(texture, {0.25, 0.25}).x == 0.0);
  CHECK(texture_colour(texture, {0.5, 0.75}).x == doctest::Approx(0.5));
  CHECK(texture_colour(texture, {0.5, 0.5}).x == doctest::Approx(0.25));

  Texture gray{1, 1, {188, 188, 188, 255}, Wrap::repeat, Wrap::repeat};
  // sRGB 188: ((188/255 + 0.055) / 1.055)^2.4 = 0.50289
  CHECK(texture_colour(gray, {0.3, 0.9}).y == doctest::Approx(0.50289).epsilon(1e-4));
  gray.rgba = {10, 10, 10, 255};  // the straight piece: 10/255/12.92
  CHECK(texture_colour(gray, {0.3, 0.9}).z == doctest::Approx(0.0030353).epsilon(1e-4));
}

TEST_CASE("a texture that is not smoothed shows the texel that a point falls in") {
  Texture texture = corner_lit(Wrap::repeat);
  texture.magnify = Magnify::nearest;
  CHECK(texture_colour(texture, {0.499, 0.501}).x == 1.0);
  CHECK(texture_colour(texture, {0.501, 0.501}).x == 0.0);
  CHECK(texture_colour(texture, {0.499, 0.499}).x == 0.0);
  CHECK(texture_colour(texture, {1.001, -0.001}).x == 1.0);
}

TEST_CASE("a mesh's colours run over its faces and multiply the material's, where the finish says so") {
  Drawable drawable = triangle();
  auto mesh = std::make_shared<Mesh>(*drawable.mesh);
  mesh->colors = {{1, 0, 0}, {0, 1, 0}, {0, 0, 0.5}};
  drawable.mesh = mesh;
  drawable.finish.a = {0.5, 1, 1};
  CHECK(colour_at(drawable, 0, {0.5, 0.25, 0.25}, glm::dvec3(0, 0, 1), {}) == glm::dvec3(0.5, 1, 1));
  drawable.finish.vertex_colors = true;
  CHECK(colour_at(drawable, 0, {0.5, 0.25, 0.25}, glm::dvec3(0, 0, 1), {}) == glm::dvec3(0.25, 0.25, 0.125));
}

TEST_CASE("beyond its edge a texture repeats, mirrors or ends") {
  CHECK(texture_colour(corner_lit(Wrap::repeat), {1.25, -0.25}).x == 1.0);
  CHECK(texture_colour(corner_lit(Wrap::repeat), {0.0, 0.75}).x == doctest::Approx(0.5));  // with its own right end
  CHECK(texture_colour(corner_lit(Wrap::mirror), {0.0, 0.75}).x == 1.0);
  CHECK(texture_colour(corner_lit(Wrap::mirror), {1.75, 0.75}).x == 1.0);
  CHECK(texture_colour(corner_lit(Wrap::mirror), {1.25, 0.75}).x == 0.0);
  CHECK(texture_colour(corner_lit(Wrap::mirror), {-0.25, 1.25}).x == 1.0);
  CHECK(texture_colour(corner_lit(Wrap::clamp), {-7.0, 9.0}).x == 1.0);
}

TEST_CASE("the first square of a checker, at u = v = 0, has the first colour; left of it the second") {
  Drawable drawable = triangle();
  drawable.finish.kind = Finish::Kind::checker;
  drawable.finish.squares = {4, 2};
  drawable.finish.a = glm::dvec3(1.0);
  const auto at = [&](double u, double v) {
    return colour_at(drawable, 0, {1.0 - u - v, u, v}, glm::dvec3(0, 0, 1), {}).x;
  };
  CHECK(at(0.1, 0.1) == 1.0);
  CHECK(at(0.3, 0.1) == 0.0);
  CHECK(at(0.1, 0.6) == 0.0);
  CHECK(at(0.3, 0.6) == 1.0);
  CHECK(at(-0.1, 0.1) == 0.0);
  CHECK(at(-0.1, -0.1) == 1.0);
}

TEST_CASE("lamps act on the side that the viewer sees") {
  Drawable drawable = triangle();
  drawable.finish.a = {1.0, 0.5, 0.25};
  const glm::dvec3 shares{0.5, 0.25, 0.25};
  const auto seen = [&](double viewer_z, const Light& light) {
    return colour_at(drawable, 0, shares, {0.3, 0.3, viewer_z}, {light}).x;
  };
  const Light sun{"", LightKind::sun, {}, {0, -3, -4}, glm::dvec3(1.0), 2.0, {}};
  CHECK(seen(1.0, sun) == 1.0);  // unlit: lamps do not matter
  drawable.finish.lit = true;
  CHECK(seen(1.0, sun) == doctest::Approx(1.6));  // 2 cos, cos = 4/5
  CHECK(seen(-1.0, sun) == 0.0);
  const Light sky{"", LightKind::sky, {}, {}, glm::dvec3(0.5), 3.0, {}};
  CHECK(seen(-1.0, sky) == doctest::Approx(1.5));
  const Light lamp{"", LightKind::point, {0.25, 0.25, -2.0}, {}, glm::dvec3(1.0), 2.0, {}};
  CHECK(seen(-1.0, lamp) == doctest::Approx(0.5));  // 2 / 2^2, straight on
  CHECK(seen(1.0, lamp) == 0.0);
  CHECK(colour_at(drawable, 0, shares, {0, 0, 1}, {sky, sun}).y == doctest::Approx((1.5 + 1.6) * 0.5));
}

TEST_CASE("interpolated normals are turned like planes, not like points, when a mesh is scaled unevenly") {
  Drawable drawable = triangle();
  drawable.finish.lit = true;
  auto mesh = std::make_shared<Mesh>(*drawable.mesh);
  mesh->normals.assign(3, glm::dvec3(0.6, 0.0, 0.8));
  drawable.mesh = mesh;
  drawable.world_from_mesh[0][0] = 2.0;  // normal (0.3, 0, 0.8) after the inverse transpose
  const Light sun{"", LightKind::sun, {}, {0, 0, -1}, glm::dvec3(1.0), 1.0, {}};
  const double expected = 0.8 / std::sqrt(0.3 * 0.3 + 0.8 * 0.8);
  CHECK(colour_at(drawable, 0, {0.4, 0.3, 0.3}, {0, 0, 5}, {sun}).x == doctest::Approx(expected));
}

TEST_CASE("luminance is Rec. 709's") {
  CHECK(luminance({1.0, 0.0, 0.0}) == 0.2126);
  CHECK(luminance({0.0, 1.0, 0.5}) == doctest::Approx(0.7152 + 0.0361));
}
