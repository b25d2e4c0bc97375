#include "core/process/report.h"

#include <doctest/doctest.h>

#include "core/mesh/measure.h"
#include "core/process/process.h"
#include "tests/core/process/meshes.h"

namespace focalstage {
namespace {

using test::both;
using test::plain_box;

std::vector<std::string> codes_of(const Mesh& mesh) {
  std::vector<std::string> codes;
  for (const MeshFlaw& flaw : flaws_of(report_mesh(mesh))) codes.push_back(flaw.code);
  return codes;
}

/// One click for each flaw, in the order in which they are told, until there is none.
Mesh mended(Mesh mesh) {
  for (int clicks = 0; clicks < 10; ++clicks) {
    const auto flaws = flaws_of(report_mesh(mesh));
    if (flaws.empty()) return mesh;
    const auto made = processed(mesh, {{*flaws.front().step, {}}});
    REQUIRE(made);
    mesh = *made;
  }
  return mesh;
}

TEST_CASE("what the primitives are made of has nothing wrong with it; a sheet's rim is no hole") {
  for (const Mesh& mesh : {plain_box(), make_box({1, 2, 3}), make_sphere(0.5), make_plane({1, 2}),
                           make_corner({1, 1}, 90), make_step({1, 1}, 0.1), make_rabbit()}) {
    CHECK(codes_of(mesh).empty());
    CHECK(report_mesh(mesh).sound());
  }
}

TEST_CASE("each flaw is counted, named, and mended by its own step") {
  using Codes = std::vector<std::string>;
  const Mesh box = plain_box();

  Mesh repeated = box;
  repeated.triangles.push_back({3, 1, 2});
  repeated.triangles.push_back({1, 3, 2});  // the same places the other way round
  CHECK(report_mesh(repeated).repeated == 2);
  CHECK(codes_of(repeated) == Codes{"mesh.repeated"});
  CHECK(mended(repeated).triangles == box.triangles);

  Mesh no_area = box;
  no_area.positions_m.push_back({-0.5, -0.5, 0.0});
  no_area.triangles.push_back({0, 8, 4});
  CHECK(report_mesh(no_area).no_area == 1);
  CHECK(codes_of(no_area) == Codes{"mesh.no-area"});
  CHECK(mended(no_area).positions_m.size() == 8);

  Mesh wound = box;
  std::swap(wound.triangles[3].y, wound.triangles[3].z);
  CHECK(report_mesh(wound).edges_against == 3);
  CHECK(codes_of(wound) == Codes{"mesh.winding"});
  CHECK(enclosed_volume_m3(mended(wound)) == doctest::Approx(1.0));

  Mesh inside_out = both(box, plain_box(0.5, {3, 0, 0}));
  for (std::size_t i = 12; i < 24; ++i) std::swap(inside_out.triangles[i].y, inside_out.triangles[i].z);
  CHECK(report_mesh(inside_out).bodies_inside_out == 1);
  CHECK(codes_of(inside_out) == Codes{"mesh.inside-out"});
  CHECK(enclosed_volume_m3(mended(inside_out)) == doctest::Approx(1.125));

  Mesh holed = box;
  holed.triangles.erase(holed.triangles.begin() + 4);
  CHECK(report_mesh(holed).holes == 1);
  CHECK(report_mesh(holed).longest_hole_m == doctest::Approx(2.0 + std::sqrt(2.0)));
  CHECK(codes_of(holed) == Codes{"mesh.holes"});
  CHECK(is_closed(mended(holed)));
  CHECK(enclosed_volume_m3(mended(holed)) == doctest::Approx(1.0));

  const Mesh crumbs = both(box, plain_box(0.05, {3, 0, 0}));
  CHECK(report_mesh(crumbs).bits == 1);
  CHECK(codes_of(crumbs) == Codes{"mesh.bits"});
  CHECK(mended(crumbs).positions_m.size() == 8);

  Mesh fin = box;
  fin.positions_m.push_back({0.0, -0.9, -0.5});
  fin.triangles.push_back({0, 8, 1});
  CHECK(report_mesh(fin).forked_edges == 1);
  CHECK(codes_of(fin) == Codes{"mesh.forks"});
  CHECK(mended(fin).triangles == box.triangles);
}

TEST_CASE("a wall inside a body goes, bodies that touch along an edge stay whole") {
  Mesh walled = plain_box();
  walled.triangles.push_back({0, 1, 6});  // a wall across, from edge to edge
  walled.triangles.push_back({1, 7, 6});
  CHECK(report_mesh(walled).forked_edges == 2);
  CHECK(mended(walled).triangles.size() == 12);

  const Mesh touching = both(plain_box(), plain_box(1.0, {1, 1, 0}));
  CHECK(report_mesh(touching).forked_edges == 1);
  const auto kept = processed(touching, {{DropFinsStep{}, {}}});
  REQUIRE(kept);
  CHECK(kept->triangles.size() == 24);
}

TEST_CASE("many flaws at once are mended one after the other") {
  Mesh mesh = make_rabbit();
  mesh.normals.clear();
  const double volume_m3 = enclosed_volume_m3(mesh);
  std::mt19937 random(7);
  for (int i = 0; i < 300; ++i) {
    glm::uvec3& triangle = mesh.triangles[random() % mesh.triangles.size()];
    std::swap(triangle.y, triangle.z);
  }
  for (int i = 0; i < 20; ++i) mesh.triangles.push_back(mesh.triangles[random() % mesh.triangles.size()]);
  mesh.triangles.erase(mesh.triangles.begin() + 1000);
  mesh.triangles.erase(mesh.triangles.begin() + 5000);
  mesh.positions_m.push_back({5, 5, 5});
  mesh.uvs.push_back({0, 0});
  const auto lone = static_cast<std::uint32_t>(mesh.positions_m.size() - 1);
  mesh.triangles.push_back({lone, lone, lone});
  const MeshReport report = report_mesh(mesh);
  CHECK(report.repeated == 20);
  CHECK(report.no_area == 1);
  CHECK(report.edges_against > 600);
  CHECK(report.holes == 2);
  const Mesh whole = mended(mesh);
  CHECK(report_mesh(whole).sound());
  CHECK(is_closed(whole));
  CHECK(enclosed_volume_m3(whole) == doctest::Approx(volume_m3).epsilon(1e-3));
}

}  // namespace
}  // namespace focalstage
