#include "core/compile/compile.h"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdlib>
#include <glm/gtc/matrix_transform.hpp>

#include "core/reference/reference.h"

using namespace focalstage;

namespace {

std::shared_ptr<const Mesh> plane(double width_m, double height_m) {
  Mesh mesh;
  const double x = width_m / 2.0;
  const double y = height_m / 2.0;
  mesh.positions_m = {{-x, -y, 0}, {x, -y, 0}, {x, y, 0}, {-x, y, 0}};
  mesh.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return std::make_shared<const Mesh>(mesh);
}

/// A closed bumpy ball.
std::shared_ptr<const Mesh> ball(int rings, double radius_m) {
  Mesh mesh;
  const int around = 2 * rings;
  for (int i = 0; i <= rings; ++i) {
    for (int j = 0; j < around; ++j) {
      const double a = M_PI * i / rings;
      const double b = 2.0 * M_PI * j / around;
      const double r = i == 0 || i == rings ? radius_m : radius_m * (1.0 + 0.05 * std::sin(7 * a) * std::cos(5 * b));
      mesh.positions_m.push_back(r * glm::dvec3(std::sin(a) * std::cos(b), std::cos(a), std::sin(a) * std::sin(b)));
      if (i == 0 || i == rings) mesh.positions_m.back() = {0.0, i == 0 ? r : -r, 0.0};
      mesh.uvs.push_back({static_cast<double>(j) / around, static_cast<double>(i) / rings});
    }
  }
  const auto at = [&](int i, int j) { return static_cast<unsigned>(i * around + j % around); };
  for (int i = 0; i < rings; ++i) {
    for (int j = 0; j < around; ++j) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i + 1, j)});
      mesh.triangles.push_back({at(i, j), at(i, j + 1), at(i + 1, j + 1)});
    }
  }
  return std::make_shared<const Mesh>(mesh);
}

glm::dmat4 at(double x, double y, double z) {
  glm::dmat4 m(1.0);
  m[3] = {x, y, z, 1.0};
  return m;
}

CompileSettings settings() {
  Project project;
  project.projectors.resize(1);
  project.projectors[0].pose.position_m = {0.0, 0.3, 0.1};
  project.slices.powers_d = {-1.0, -0.5, 0.0, 0.5, 1.0, 1.5};
  return compile_settings(project);
}

Stage room() {
  Stage stage;
  StagedSurface screen;
  screen.drawables.push_back({plane(1.2, 1.2), glm::rotate(at(0, 0, -0.515), 0.3, glm::dvec3(0.3, 1.0, 0.0)), {}});
  stage.surfaces.push_back(screen);
  StagedObject object;
  object.drawables.push_back({ball(100, 0.05), at(-0.05, 0.02, -0.4), {}});
  object.drawables.push_back({ball(100, 0.06), at(0.08, 0.05, -0.6), {}});
  object.drawables.back().finish.kind = Finish::Kind::checker;
  object.drawables.back().finish.squares = {20, 20};
  stage.objects.push_back(object);
  StagedObject far;
  far.index = 1;
  far.drawables.push_back({plane(0.6, 0.6), glm::rotate(at(0, 0, -0.9), 0.5, glm::dvec3(0.0, 1.0, 0.0)), {}});
  far.drawables.back().finish.kind = Finish::Kind::checker;
  far.drawables.back().finish.squares = {16, 12};
  stage.objects.push_back(far);
  return stage;
}

std::size_t off_by_more_than_one(const FrameImages& a, const FrameImages& b) {
  REQUIRE(a.codes.size() == b.codes.size());
  std::size_t off = 0;
  for (std::size_t i = 0; i < a.codes.size(); ++i) off += std::abs(int{a.codes[i]} - int{b.codes[i]}) > 1 ? 1 : 0;
  return off;
}

std::size_t lit(const FrameImages& a) {
  std::size_t n = 0;
  for (const auto c : a.codes) n += c > 0 ? 1 : 0;
  return n;
}

}  // namespace

TEST_CASE("the engine gives the reference's bytes") {
  const CompileSettings with = settings();
  const Stage stage = room();
  const auto reference = compile_reference(stage, with);
  REQUIRE(reference);
  const auto fast = Compiler(with).frame(stage);
  REQUIRE(fast);
  CHECK(lit(fast->images) > 50000);
  MESSAGE("lit " << lit(fast->images) << " of " << fast->images.codes.size());
  CHECK(off_by_more_than_one(fast->images, reference->images) <= 9);
  MESSAGE("off " << off_by_more_than_one(fast->images, reference->images));
}

TEST_CASE("colours of vertices and textures without smoothing: the reference's bytes") {
  CompileSettings with = settings();
  with.channels = 3;
  Stage stage = room();
  auto coloured = std::make_shared<Mesh>(*plane(0.6, 0.6));
  coloured->colors = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 0.5}};
  Drawable& far = stage.objects[1].drawables[0];
  far.mesh = coloured;
  far.finish.kind = Finish::Kind::textured;
  far.finish.a = {1.0, 0.5, 0.75};
  far.finish.vertex_colors = true;
  Texture texture{3, 2, {}, Wrap::repeat, Wrap::repeat, Magnify::nearest};
  for (int i = 0; i < 24; ++i) texture.rgba.push_back(static_cast<std::uint8_t>(40 * i % 256));
  far.finish.texture = std::make_shared<const Texture>(texture);
  const auto reference = compile_reference(stage, with);
  REQUIRE(reference);
  const auto fast = Compiler(with).frame(stage);
  REQUIRE(fast);
  CHECK(off_by_more_than_one(fast->images, reference->images) <= 27);
  far.finish.vertex_colors = false;
  CHECK(Compiler(with).frame(stage)->images.codes != fast->images.codes);
}

TEST_CASE("a surface whose mesh is another at the same place is looked at anew") {
  const CompileSettings with = settings();
  Stage stage = room();
  Compiler kept(with);
  REQUIRE(kept.frame(stage));
  auto bent = std::make_shared<Mesh>(*stage.surfaces[0].drawables[0].mesh);
  bent->positions_m[2].z += 0.2;
  stage.surfaces[0].drawables[0].mesh = bent;
  CHECK(kept.frame(stage)->images.codes == Compiler(with).frame(stage)->images.codes);
}

TEST_CASE("neither threads nor the vector path change a byte") {
  const CompileSettings with = settings();
  const Stage stage = room();
  const auto one = Compiler(with, 1).frame(stage);
  const auto two = Compiler(with, 2).frame(stage);
  const auto portable = Compiler(with, 2, VectorPath::portable).frame(stage);
  REQUIRE(one);
  CHECK(one->images.codes == two->images.codes);
  CHECK(one->images.codes == portable->images.codes);
}

TEST_CASE("a stop request ends a frame with a fault") {
  std::stop_source stop;
  stop.request_stop();
  const auto frame = Compiler(settings()).frame(room(), stop.get_token());
  REQUIRE_FALSE(frame);
  CHECK(frame.fault().code == "compile.cancelled");
}
