#include "editor/tools/fixtures.h"

#include <cmath>
#include <memory>
#include <numbers>

#include <glm/gtc/matrix_transform.hpp>

#include "core/stage/primitive_cache.h"

namespace focalstage {
namespace {

const glm::dvec3 skin{0.36, 0.37, 0.40};  // linear: a neutral gray, nobody's
const glm::dvec3 dark{0.035, 0.037, 0.042};
const glm::dvec3 glass{0.10, 0.28, 0.62};

/// A ball of radius 1, much coarser than the primitive: there are many, and they are small in the picture.
std::shared_ptr<const Mesh> ball() {
  constexpr int around = 28;
  constexpr int up = 14;
  auto mesh = std::make_shared<Mesh>();
  for (int k = 0; k <= up; ++k) {
    const double height = std::numbers::pi * k / up;
    for (int i = 0; i < around; ++i) {
      const double a = 2.0 * std::numbers::pi * i / around;
      mesh->positions_m.emplace_back(std::sin(height) * std::cos(a), -std::cos(height),
                                     -std::sin(height) * std::sin(a));
    }
  }
  mesh->normals = mesh->positions_m;
  for (int k = 0; k < up; ++k) {
    for (int i = 0; i < around; ++i) {
      const auto corner = [&](int n, int m) { return static_cast<std::uint32_t>(m * around + n % around); };
      if (k > 0) mesh->triangles.push_back({corner(i, k), corner(i + 1, k), corner(i + 1, k + 1)});
      if (k + 1 < up) mesh->triangles.push_back({corner(i, k), corner(i + 1, k + 1), corner(i, k + 1)});
    }
  }
  return mesh;
}

Drawable ball_part(const glm::dmat4& world_from_mesh, const glm::dvec3& colour) {
  static const std::shared_ptr<const Mesh> mesh = ball();
  Finish finish;
  finish.a = colour;
  finish.lit = true;
  return {mesh, world_from_mesh, finish};
}

Drawable part(const MeshShape& shape, const glm::dmat4& world_from_mesh, const glm::dvec3& colour) {
  Finish finish;
  finish.a = colour;
  finish.lit = true;
  Drawable drawable{nullptr, world_from_mesh, finish};
  // Sizes here are constants above zero, for which a primitive is always made.
  if (auto mesh = primitive_mesh(shape)) drawable.mesh = *mesh;
  return drawable;
}

/// A ring about -Z, as the rim of a lens.
std::shared_ptr<const Mesh> rim() {
  constexpr int around = 32;
  constexpr int across = 8;
  constexpr double radius_m = 0.023;
  constexpr double thickness_m = 0.0032;
  auto mesh = std::make_shared<Mesh>();
  for (int i = 0; i < around; ++i) {
    const double a = 2.0 * std::numbers::pi * i / around;
    for (int k = 0; k < across; ++k) {
      const double b = 2.0 * std::numbers::pi * k / across;
      const glm::dvec3 out{std::cos(a), std::sin(a), 0.0};
      const glm::dvec3 normal = std::cos(b) * out + glm::dvec3(0.0, 0.0, std::sin(b));
      mesh->positions_m.push_back(radius_m * out + thickness_m * normal);
      mesh->normals.push_back(normal);
      const auto at = [&](int n, int m) { return static_cast<std::uint32_t>((n % around) * across + m % across); };
      mesh->triangles.push_back({at(i, k), at(i + 1, k), at(i + 1, k + 1)});
      mesh->triangles.push_back({at(i, k), at(i + 1, k + 1), at(i, k + 1)});
    }
  }
  return mesh;
}

glm::dmat4 at(const Rigid& pose, const glm::dvec3& centre_m) { return glm::translate(pose.matrix(), centre_m); }

Fixture viewer_fixture(const Project& project, const Stage& stage) {
  static const std::shared_ptr<const Mesh> rim_mesh = rim();
  const Rigid& pose = stage.world_from_viewer;
  const double lens_m = -project.glasses.lens_to_pupil_mm * 1e-3;
  const double half_m = 0.5 * stage.interpupillary_m;
  Fixture fixture{{"viewer", ""}, pose, {}};
  fixture.drawables.push_back(
      ball_part(glm::scale(at(pose, {0.0, 0.005, 0.088}), glm::dvec3(0.076, 0.112, 0.092)), skin));
  // Nose, neck and ears: without them a head is an egg.
  const auto round = [&](const glm::dvec3& centre_m, const glm::dvec3& radii_m) {
    fixture.drawables.push_back(ball_part(glm::scale(at(pose, centre_m), radii_m), skin));
  };
  round({0.0, -0.038, -0.004}, {0.013, 0.024, 0.018});
  round({0.0, -0.108, 0.098}, {0.046, 0.062, 0.048});
  round({-0.077, -0.010, 0.088}, {0.009, 0.030, 0.020});
  round({0.077, -0.010, 0.088}, {0.009, 0.030, 0.020});
  for (const double x_m : {-half_m, half_m}) {
    Drawable ring = part(BoxMesh{}, at(pose, {x_m, 0.0, lens_m}), dark);
    ring.mesh = rim_mesh;
    fixture.drawables.push_back(ring);
    fixture.drawables.push_back(
        ball_part(glm::scale(at(pose, {x_m, 0.0, lens_m}), glm::dvec3(0.021, 0.021, 0.003)), glass));
    const double side_m = x_m < 0.0 ? -0.078 : 0.078;  // the temple, along the head
    fixture.drawables.push_back(part(BoxMesh{{0.004, 0.006, 0.11}}, at(pose, {side_m, 0.004, lens_m + 0.055}), dark));
    const double outer_m = x_m < 0.0 ? x_m - 0.024 : x_m + 0.024;
    fixture.drawables.push_back(part(BoxMesh{{std::abs(side_m - outer_m), 0.006, 0.004}},
                                     at(pose, {0.5 * (side_m + outer_m), 0.004, lens_m}), dark));
  }
  const double bridge_m = std::max(stage.interpupillary_m - 0.046, 0.002);
  fixture.drawables.push_back(part(BoxMesh{{bridge_m, 0.005, 0.004}}, at(pose, {0.0, 0.004, lens_m}), dark));
  return fixture;
}

Fixture projector_fixture(const Projector& projector) {
  Fixture fixture{{"projectors", projector.name}, projector.pose, {}};
  fixture.drawables.push_back(
      part(BoxMesh{{0.13, 0.055, 0.10}}, at(projector.pose, {0.0, 0.0, 0.068}), {0.10, 0.105, 0.115}));
  fixture.drawables.push_back(
      ball_part(glm::scale(at(projector.pose, {0.0, 0.0, 0.012}), glm::dvec3(0.020, 0.020, 0.012)), glass));
  return fixture;
}

}  // namespace

std::vector<Fixture> fixtures(const Project& project, const Stage& stage) {
  std::vector<Fixture> all{viewer_fixture(project, stage)};
  for (const Projector& projector : project.projectors) all.push_back(projector_fixture(projector));
  for (const Light& light : project.lights) {
    if (light.kind != LightKind::point) continue;
    Fixture lamp{{"lights", light.name}, Rigid{light.position_m}, {}};
    lamp.drawables.push_back(
        ball_part(glm::scale(at(lamp.pose, {0.0, 0.0, 0.0}), glm::dvec3(0.022)), glm::dvec3(1.0, 0.92, 0.72)));
    all.push_back(std::move(lamp));
  }
  return all;
}

std::optional<PickHit> first_with_fixtures(Picker& picker, const Stage& stage, const std::vector<Fixture>& fixtures,
                                           const Ray& ray, const MayPick& may) {
  std::optional<PickHit> best = picker.first(stage, ray, may);
  for (const Fixture& fixture : fixtures) {
    if (!may || may(fixture.thing)) picker.nearer(fixture.thing, fixture.drawables, ray, 0.0, best);
  }
  return best;
}

std::vector<Drawable> drawables_of(const Stage& stage, const std::vector<Fixture>& fixtures, const StagedName& thing) {
  for (const StagedSurface& surface : stage.surfaces) {
    if (thing == StagedName{"surfaces", surface.name}) return surface.drawables;
  }
  for (const StagedObject& object : stage.objects) {
    if (thing == StagedName{"objects", object.name}) return object.drawables;
  }
  for (const Fixture& fixture : fixtures) {
    if (thing == fixture.thing) return fixture.drawables;
  }
  return {};
}

}  // namespace focalstage
