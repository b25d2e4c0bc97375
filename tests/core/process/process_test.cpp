#include "core/process/process.h"

#include <algorithm>
#include <cmath>
#include <thread>

#include <doctest/doctest.h>

#include <glm/geometric.hpp>

#include "core/mesh/measure.h"
#include "core/process/report.h"
#include "tests/core/process/meshes.h"

namespace focalstage {
namespace {

using test::grid;
using test::plain_box;

Mesh after(const Mesh& mesh, const ProcessKind& step) {
  Result<Mesh> made = processed(mesh, {{step, {}}});
  REQUIRE(made);
  CHECK(check_mesh(*made).ok());
  return *std::move(made);
}

TEST_CASE("welding closes what was read as loose triangles, and keeps seams of the texture") {
  Mesh loose;
  const Mesh box = plain_box();
  std::mt19937 random(3);
  std::uniform_real_distribution<double> off_m(-4e-6, 4e-6);
  for (const glm::uvec3& triangle : box.triangles) {
    const auto first = static_cast<std::uint32_t>(loose.positions_m.size());
    for (int k = 0; k < 3; ++k) {
      loose.positions_m.push_back(box.positions_m[triangle[k]] +
                                  glm::dvec3(off_m(random), off_m(random), off_m(random)));
    }
    loose.triangles.push_back({first, first + 1, first + 2});
  }
  CHECK(!is_closed(after(loose, WeldStep{})));
  const Mesh welded = after(loose, WeldStep{0.05});
  CHECK(welded.positions_m.size() == 8);
  CHECK(welded.triangles.size() == 12);
  CHECK(is_closed(welded));

  // The box with a texture on each face: corners keep three of them.
  const Mesh textured = after(make_box({1, 1, 1}), WeldStep{0.05});
  CHECK(textured.positions_m.size() == 24);
}

TEST_CASE("a weld as coarse as the mesh leaves nothing, and says so") {
  const auto made = processed(plain_box(0.1), {{FlipStep{}, {}}, {WeldStep{500.0}, {}}});
  REQUIRE(!made);
  CHECK(made.fault().code == "process.empty");
  CHECK(made.fault().where == "/1");
}

TEST_CASE("filling: by shape, or all up to a length; too long a border stays") {
  Mesh sheet = grid(20, [](glm::dvec2) { return 0.0; });
  sheet.triangles.erase(sheet.triangles.begin() + 420, sheet.triangles.begin() + 422);  // one square in the middle
  const double missing_m2 = 1.0 - mesh_area_m2(sheet);
  CHECK(missing_m2 == doctest::Approx(1.0 / 400.0));
  CHECK(mesh_area_m2(after(sheet, FillHolesStep{})) == doctest::Approx(1.0));
  CHECK(mesh_area_m2(after(sheet, FillHolesStep{100.0})) < 0.9999);  // 200 mm around
  CHECK(mesh_area_m2(after(sheet, FillHolesStep{250.0})) == doctest::Approx(1.0));
  // The rim is a border too, for who asks.
  CHECK(mesh_area_m2(after(sheet, FillHolesStep{5000.0})) == doctest::Approx(2.0));
}

TEST_CASE("parts between folds, the largest first") {
  const Mesh box = make_box({1, 2, 3});
  for (int part = 0; part < 6; ++part) {
    const double area_m2 = mesh_area_m2(after(box, KeepPartStep{part, 30.0}));
    CHECK(area_m2 == doctest::Approx(part < 2 ? 6.0 : part < 4 ? 3.0 : 2.0));
  }
  const auto none = processed(box, {{KeepPartStep{6, 30.0}, {}}});
  REQUIRE(!none);
  CHECK(none.fault().code == "process.no-part");
  CHECK(none.fault().where == "/0/part");
  CHECK(mesh_area_m2(after(box, KeepPartStep{0, 120.0})) == doctest::Approx(22.0));
}

TEST_CASE("decimation: as few as asked, or no further off than said; borders stay") {
  const Mesh wave = grid(40, [](glm::dvec2 at) { return 0.05 * std::sin(6.0 * at.x) * std::cos(5.0 * at.y); });
  const Mesh few = after(wave, DecimateStep{800, std::nullopt});
  CHECK(few.triangles.size() <= 800);
  CHECK(few.triangles.size() > 700);
  CHECK(few.uvs.size() == few.positions_m.size());
  for (std::size_t i = 0; i < few.positions_m.size(); ++i) {
    CHECK(few.uvs[i].x == doctest::Approx(few.positions_m[i].x));  // each kept what it had
    CHECK(few.uvs[i].y == doctest::Approx(few.positions_m[i].y));
  }
  // Every vertex of before is near what is left, as far as its height says.
  const Mesh near = after(wave, DecimateStep{std::nullopt, 0.5});
  CHECK(near.triangles.size() < wave.triangles.size() / 2);
  double worst_m = 0.0;
  for (const glm::dvec3& point : wave.positions_m) {
    double least_m = 1.0;
    for (const glm::uvec3& t : near.triangles) {
      const glm::dvec3& a = near.positions_m[t.x];
      const glm::dvec3 u = near.positions_m[t.y] - a;
      const glm::dvec3 v = near.positions_m[t.z] - a;
      const double area = u.x * v.y - u.y * v.x;
      const glm::dvec3 p = point - a;
      const double s = (p.x * v.y - p.y * v.x) / area;
      const double r = (u.x * p.y - u.y * p.x) / area;
      if (s >= -1e-9 && r >= -1e-9 && s + r <= 1.0 + 1e-9)
        least_m = std::min(least_m, std::abs(p.z - s * u.z - r * v.z));
    }
    worst_m = std::max(worst_m, least_m);
  }
  CHECK(worst_m < 0.7e-3);  // upright; 0.5 mm along the slanted normal
  CHECK(mesh_bounds(near).size_m().x == doctest::Approx(1.0));
}

TEST_CASE("a flat sheet has no error at all, and its border is what is left") {
  const Mesh flat = after(grid(20, [](glm::dvec2) { return 0.0; }), DecimateStep{std::nullopt, 0.001});
  CHECK(flat.triangles.size() < 110);  // 80 border vertices
  CHECK(mesh_area_m2(flat) == doctest::Approx(1.0));
}

TEST_CASE("smoothing takes noise away and leaves the features") {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> noise_m(-0.002, 0.002);
  const auto roof = [&](glm::dvec2 at) { return 0.5 - std::abs(at.x - 0.5) + noise_m(random); };
  const Mesh noisy = grid(40, roof);
  const auto error_m = [](const Mesh& mesh) {
    double sum = 0.0;
    int count = 0;
    for (const glm::dvec3& p : mesh.positions_m) {
      if (std::abs(p.x - 0.5) < 0.1 || std::min({p.x, p.y, 1 - p.x, 1 - p.y}) < 0.1) continue;
      sum += std::pow(p.z - (0.5 - std::abs(p.x - 0.5)), 2);
      ++count;
    }
    return std::sqrt(sum / count);
  };
  const Mesh smooth = after(noisy, SmoothStep{10, 60.0});
  CHECK(error_m(smooth) < 0.4 * error_m(noisy));
  // By their texture coordinates, which smoothing leaves alone.
  const auto moved_m = [&](const Mesh& mesh) {
    double most_m = 0.0;
    for (std::size_t i = 0; i < mesh.positions_m.size(); ++i) {
      if (mesh.uvs[i].x != 0.5) continue;
      const auto before = static_cast<std::size_t>(std::lround(mesh.uvs[i].y * 40.0) * 41 + 20);
      most_m = std::max(most_m, glm::distance(noisy.positions_m[before], mesh.positions_m[i]));
    }
    return most_m;
  };
  CHECK(moved_m(smooth) == 0.0);
  CHECK(moved_m(after(noisy, SmoothStep{10, 180.0})) > 0.005);
}

TEST_CASE("subdivision: so many triangles, the sphere rounder, the texture where it was") {
  const Mesh box = plain_box();
  CHECK(after(box, SubdivideStep{Subdivision::loop, 2}).triangles.size() == 192);
  CHECK(after(box, SubdivideStep{Subdivision::sqrt3, 2}).triangles.size() == 108);
  const Mesh sheet = after(grid(4, [](glm::dvec2) { return 0.0; }), SubdivideStep{Subdivision::loop, 2});
  CHECK(sheet.triangles.size() == 512);
  REQUIRE(sheet.uvs.size() == sheet.positions_m.size());
  for (std::size_t i = 0; i < sheet.uvs.size(); ++i) {
    CHECK(sheet.uvs[i].x == doctest::Approx(sheet.positions_m[i].x));
    CHECK(sheet.uvs[i].y == doctest::Approx(sheet.positions_m[i].y));
  }
  const auto too_many = processed(make_rabbit(), {{FlipStep{}, {}}, {SubdivideStep{Subdivision::loop, 8}, {}}});
  REQUIRE(!too_many);
  CHECK(too_many.fault().code == "process.too-large");
  CHECK(too_many.fault().where == "/1/rounds");
}

TEST_CASE("normals come along, or are made anew") {
  const Mesh smooth = after(make_sphere(0.5), DecimateStep{4000, std::nullopt});
  CHECK(smooth.triangles.size() <= 4000);
  REQUIRE(smooth.normals.size() == smooth.positions_m.size());
  for (std::size_t i = 0; i < smooth.normals.size(); ++i) {
    CHECK(glm::dot(smooth.normals[i], glm::normalize(smooth.positions_m[i])) > 0.9);
  }
  const Mesh back = after(make_plane({1, 1}), FlipStep{});
  CHECK(back.normals[0].z == -1.0);
}

TEST_CASE("colours come along through every step") {
  Mesh painted = grid(10, [](glm::dvec2) { return 0.0; });
  for (const glm::dvec3& position_m : painted.positions_m) painted.colors.push_back(position_m);
  for (const ProcessKind& step :
       std::vector<ProcessKind>{WeldStep{1.0}, CleanStep{}, FixWindingStep{}, FlipStep{}, DecimateStep{60, {}},
                                SmoothStep{}, SubdivideStep{}, SubdivideStep{Subdivision::sqrt3, 2}}) {
    const Mesh made = after(painted, step);
    REQUIRE(made.colors.size() == made.positions_m.size());
    if (std::holds_alternative<SmoothStep>(step)) continue;  // moves places, not what they carry
    for (std::size_t i = 0; i < made.colors.size(); ++i)
      CHECK(glm::distance(made.colors[i], made.positions_m[i]) < 1e-9);
  }
}

TEST_CASE("shapes that half-edges cannot hold come through every step") {
  std::mt19937 random(11);
  for (int round = 0; round < 50; ++round) {
    Mesh soup;
    for (int i = 0; i < 12; ++i) soup.positions_m.push_back({random() % 4, random() % 4, random() % 4});
    for (int i = 0; i < 40; ++i) {
      soup.triangles.push_back({random() % 12, random() % 12, random() % 12});
    }
    for (const ProcessKind& step :
         std::vector<ProcessKind>{WeldStep{10.0}, CleanStep{}, DropFinsStep{}, DropBitsStep{}, FixWindingStep{},
                                  FillHolesStep{1e6}, DecimateStep{10, {}}, DecimateStep{{}, 100.0}, SmoothStep{},
                                  SubdivideStep{}, SubdivideStep{Subdivision::sqrt3, 2}}) {
      const auto made = processed(soup, {{step, {}}});
      if (made) CHECK(check_mesh(*made).ok());
    }
    report_mesh(soup);
  }
}

TEST_CASE("the same is made once, whoever asks") {
  const auto mesh = std::make_shared<const Mesh>(make_sphere(0.5));
  const std::vector<ProcessStep> steps{{DecimateStep{300, std::nullopt}, {}}};
  std::vector<std::shared_ptr<const Mesh>> made(4);
  {
    std::vector<std::jthread> threads;
    for (auto& mine : made) threads.emplace_back([&] { mine = *processed_once(mesh, steps); });
  }
  for (const auto& mine : made) CHECK(mine == made[0]);
  CHECK(processed_once(mesh, {})->get() == mesh.get());
}

}  // namespace
}  // namespace focalstage
