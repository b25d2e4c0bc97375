#include "core/calibrate/projector_scan.h"

#include <doctest/doctest.h>

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <utility>

#include "core/calibrate/scan_mesh.h"
#include "io/files/files.h"
#include "io/image/png.h"
#include "io/project/project_file.h"
#include "tests/core/calibrate/simulated_board.h"

using namespace focalstage;

namespace {

const PatternSet set{800, 600, 2.2, 4, 16, 8};
const CharucoBoard board{9, 7, 0.06, 0.036, "4x4_50"};

/// A projector whose lens is shifted upwards, as projectors' are, and bent.
own::Lens projector() {
  own::Lens lens{800, 600, 1010.0, 1006.0, 409.0, 420.0};
  lens.k1 = -0.06;
  lens.k2 = 0.02;
  lens.p1 = 0.0006;
  lens.p2 = -0.0009;
  lens.world_from_own = own::turned(-13.0, -6.0, 1.5);
  lens.at = {-0.35, 0.22, 0.25};
  return lens;
}

own::Lens camera() {
  own::Lens lens{1280, 960, 1380.0, 1376.0, 632.0, 486.0};
  lens.k1 = -0.16;
  lens.k2 = 0.08;
  lens.p1 = -0.0004;
  lens.p2 = 0.0006;
  lens.k3 = -0.01;
  lens.world_from_own = own::turned(14.0, -3.0, -2.0);
  lens.at = {0.33, 0.05, 0.2};
  return lens;
}

/// What a project says of the projector before it is measured.
ProjectorModel known() { return {800, 600, {1400.0, 1400.0}, {400.0, 300.0}, {}, {}}; }

struct Held {
  own::Vector corner;
  own::Matrix turn;
};

/// Leaning each time another way; the first as it stands where its place is known.
const std::vector<Held> held = [] {
  std::vector<Held> all;
  const std::vector<double> depths{-1.0, -0.82, -1.08, -0.9, -1.04, -0.8, -1.12, -0.95};
  for (std::size_t i = 0; i < depths.size(); ++i) {
    const auto k = static_cast<double>(i);
    const double lean_deg = i == 0 ? 8.0 : 38.0;
    const double off = i == 0 ? 0.0 : 0.07;
    const own::Matrix turn = own::turned(lean_deg * std::cos(2.4 * k), lean_deg * std::sin(2.4 * k), 9.0 * k);
    const own::Vector middle{off * std::cos(1.7 * k), off * std::sin(1.7 * k) - 0.02, depths[i]};
    all.push_back({own::minus(middle, own::times(turn, own::Vector{0.27, 0.21, 0.0})), turn});
  }
  return all;
}();

std::vector<own::Thing> wall_and_sheet() {
  const auto wall = [](double x, double y) -> std::optional<double> { return own::texture(x, y); };
  return {own::wavy_wall(-1.3, 0.05, wall),
          own::sheet({-0.25, -0.2, -0.95}, own::turned(25.0, 5.0, 8.0), own::textured(0.25, 0.3))};
}

std::vector<own::Thing> with_board(const Held& where) {
  const auto gray = [](double, double) -> std::optional<double> { return 0.4; };
  return {own::sheet({-9.0, -9.0, -1.6}, own::turned(0.0, 0.0, 0.0), gray),
          own::sheet(where.corner, where.turn, own::charuco(board))};
}

/// The same camera with half its pixels.
own::Lens small_camera() {
  own::Lens lens = camera();
  lens.width /= 2;
  lens.height /= 2;
  for (double* length : {&lens.fx, &lens.fy, &lens.cx, &lens.cy}) *length /= 2.0;
  return lens;
}

ScannedCapture scanned(const std::string& name, const std::vector<own::Thing>& things, const own::Lens& from,
                       bool has_board, std::uint32_t seed) {
  own::Shot shot;
  shot.exposure = 0.9;
  shot.samples = has_board ? 3 : 2;  // squares have sharp edges
  own::Photographer photographer(things, projector(), from, shot, seed);
  const Capture capture = photographer.capture(set);
  auto decoded = decode_capture(set, capture);
  if (!decoded) FAIL(describe(decoded.fault()));
  ScannedCapture made{name, std::move(*decoded), {}};
  if (!has_board) return made;
  auto corners = find_board(board, capture[0]);
  if (!corners) FAIL(describe(corners.fault()));
  made.corners = std::move(*corners);
  return made;
}

/// All boards and then the room, photographed once.
const std::vector<ScannedCapture>& captures() {
  static const std::vector<ScannedCapture> all = [] {
    std::vector<ScannedCapture> made;
    for (std::size_t i = 0; i < held.size(); ++i) {
      made.push_back(scanned("board-" + std::to_string(i + 1), with_board(held[i]), camera(), true,
                             static_cast<std::uint32_t>(i + 1)));
    }
    made.push_back(scanned("room", wall_and_sheet(), camera(), false, 50));
    return made;
  }();
  return all;
}

Rigid world_from_board(const Held& where) {
  const own::Matrix& m = where.turn;
  const glm::dmat3 columns(m[0][0], m[1][0], m[2][0], m[0][1], m[1][1], m[2][1], m[0][2], m[1][2], m[2][2]);
  return {{where.corner[0], where.corner[1], where.corner[2]}, glm::quat_cast(columns)};
}

ScanWorld world() { return {0, world_from_board(held[0]), {}}; }

double off_mm(const ProjectorModel& model, const own::Lens& lens) {
  const glm::dvec3& p = model.world_from_projector.position_m;
  return 1e3 * own::length(own::minus({p.x, p.y, p.z}, lens.at));
}

double off_deg(const ProjectorModel& model, const own::Lens& lens) {
  return own::angle_deg(own::matrix_of(model.world_from_projector.rotation), lens.world_from_own);
}

/// How far the found projector's own formula, as a user would check it, is from the truth over the lit room.
double reprojection_median_px(const ProjectorModel& model) {
  own::Lens found = projector();
  found.fx = model.focal_px.x;
  found.fy = model.focal_px.y;
  found.cx = model.centre_px.x;
  found.cy = model.centre_px.y;
  found.k1 = model.distortion[0];
  found.k2 = model.distortion[1];
  found.p1 = model.distortion[2];
  found.p2 = model.distortion[3];
  found.world_from_own = own::matrix_of(model.world_from_projector.rotation);
  const glm::dvec3& p = model.world_from_projector.position_m;
  found.at = {p.x, p.y, p.z};
  std::vector<double> off;
  const auto things = wall_and_sheet();
  for (int v = 10; v < 600; v += 20) {
    for (int u = 10; u < 800; u += 20) {
      const own::Vector along = projector().look(u, v);
      const auto hit = own::first_hit(things, projector().at, along);
      if (!hit) continue;
      const auto pixel = found.pixel(own::plus(projector().at, own::scaled(along, hit->way)));
      off.push_back(std::hypot(pixel->x - u, pixel->y - v));
    }
  }
  std::ranges::sort(off);
  return off[off.size() / 2];
}

const ProjectorScan& solved() {
  static const ProjectorScan scan = [] {
    auto made = calibrate_by_scan(known(), captures(), world());
    if (!made) throw std::runtime_error(describe(made.fault()));
    return std::move(*made);
  }();
  return scan;
}

/// Four boards and the room: enough where no figure is at stake.
std::vector<ScannedCapture> some_captures() {
  auto some = captures();
  some.erase(some.begin() + 4, some.end() - 1);
  return some;
}

}  // namespace

TEST_CASE("a projector from camera pictures alone: within half a millimetre and a twentieth of a degree") {
  const ProjectorScan* scan = &solved();
  const double mm = off_mm(scan->projector, projector());
  const double deg = off_deg(scan->projector, projector());
  const double px = reprojection_median_px(scan->projector);
  MESSAGE("projector off by ", mm, " mm, ", deg, " degrees; said ", scan->report.uncertainty.position_mm, " mm, ",
          scan->report.uncertainty.rotation_deg, " degrees; camera off by ", off_mm(scan->camera, camera()), " mm");
  MESSAGE("residual median ", scan->report.median_px, ", 95 % ", scan->report.p95_px, ", left out ",
          *scan->report.left_out_median_px, ", camera ", scan->camera_report.median_px, " px; in the room ", px, " px");
  CHECK(mm < 0.5);
  CHECK(deg < 0.05);
  CHECK(px < 0.3);
  CHECK(scan->report.median_px < 0.3);
  CHECK(*scan->report.left_out_median_px < 0.3);
  CHECK(scan->agreements.back().median_off_px < 0.3);
  CHECK(check_limit(scan->report).ok());
  CHECK(check_limit(scan->camera_report).ok());
}

TEST_CASE("the room's surface becomes a mesh, cut where its sheet stands before the wall") {
  const Mesh mesh = scan_mesh(solved().camera, solved().projector, captures().back().decoded, {});
  CHECK(mesh.triangles.size() > 20000);
  const auto things = wall_and_sheet();
  std::vector<double> off_mm;
  for (const glm::dvec3& p : mesh.positions_m) {
    const own::Vector at{p.x, p.y, p.z};
    // Where boards were held: what the lenses do beyond is nobody's word.
    const auto pixel = projector().pixel(at);
    if (pixel->x < 200 || pixel->x > 600 || pixel->y < 200 || pixel->y > 500) continue;
    const own::Vector along = own::minus(at, camera().at);
    const auto hit = own::first_hit(things, camera().at, along);
    if (hit) off_mm.push_back(1e3 * std::abs(hit->way - 1.0) * own::length(along));
  }
  REQUIRE(off_mm.size() > 5000);
  std::ranges::sort(off_mm);
  MESSAGE("the mesh is off by ", off_mm[off_mm.size() / 2], " mm (median), 95 % within ",
          off_mm[off_mm.size() * 19 / 20], " mm");
  CHECK(off_mm[off_mm.size() / 2] < 0.3);
  CHECK(off_mm[off_mm.size() * 19 / 20] < 1.0);
  // Sheet and wall are 15 to 40 cm apart: no face leads from the one to the other.
  double longest_m = 0.0;
  for (const glm::uvec3& face : mesh.triangles) {
    for (int i = 0; i < 3; ++i) {
      const glm::dvec3 side = mesh.positions_m[face[i]] - mesh.positions_m[face[(i + 1) % 3]];
      longest_m = std::max(longest_m, own::length({side.x, side.y, side.z}));
    }
  }
  CHECK(longest_m < 0.04);
  // Faces are turned to the camera.
  const glm::uvec3& face = mesh.triangles[mesh.triangles.size() / 2];
  const auto corner = [&](int i) {
    const glm::dvec3& p = mesh.positions_m[face[i]];
    return own::Vector{p.x, p.y, p.z};
  };
  const own::Vector normal = own::cross(own::minus(corner(1), corner(0)), own::minus(corner(2), corner(0)));
  CHECK(own::dot(normal, own::minus(camera().at, corner(0))) > 0.0);
}

TEST_CASE("marks on the surface fix the world as a board does; one that lies is named") {
  const auto some = some_captures();
  const DecodedCapture& room = some.back().decoded;
  const auto things = wall_and_sheet();
  std::vector<WorldMark> marks;
  for (int k = 0; k < 12; ++k) {
    const int u = 340 + 200 * (k % 4);
    const int v = 260 + 170 * (k / 4);
    const own::Vector along = camera().look(u, v);
    const auto hit = own::first_hit(things, camera().at, along);
    // On faces, lit all about.
    bool lit = hit.has_value();
    for (int i = 0; lit && i < 225; ++i) {
      lit = std::isfinite(room.u[static_cast<std::size_t>((v + i / 15 - 7) * camera().width + u + i % 15 - 7)]);
    }
    if (!lit) continue;
    const own::Vector at = own::plus(camera().at, own::scaled(along, hit->way));
    marks.push_back({"m" + std::to_string(marks.size()), {u, v}, {at[0], at[1], at[2]}});
  }
  REQUIRE(marks.size() >= 5);
  const ScanWorld by_marks{some.size() - 1, std::nullopt, marks};
  const auto scan = calibrate_by_scan(known(), some, by_marks);
  if (!scan) FAIL(describe(scan.fault()));
  MESSAGE("by ", marks.size(), " marks: off by ", off_mm(scan->projector, projector()), " mm, marks agree to ",
          scan->marks->rms_mm, " mm");
  CHECK(off_mm(scan->projector, projector()) < 5.0);
  ScanWorld lying = by_marks;
  lying.marks[3].world_m.x += 0.05;
  const auto refused = calibrate_by_scan(known(), some, lying);
  REQUIRE_FALSE(refused);
  CHECK(refused.fault().code == "align.pair-off");
  CHECK(refused.fault().where.find("m3") != std::string::npos);
}

TEST_CASE("a camera that was moved between captures is refused, by the capture's name") {
  own::Lens moved = camera();
  moved.at[0] += 0.004;
  moved.world_from_own = own::times(moved.world_from_own, own::turned(0.0, 0.3, 0.0));
  auto all = some_captures();
  all.back() = scanned("room", wall_and_sheet(), moved, false, 60);
  const auto scan = calibrate_by_scan(known(), all, world());
  REQUIRE_FALSE(scan);
  CHECK(scan.fault().code == "scan.moved");
  CHECK(scan.fault().where == "room");
}

TEST_CASE("too few boards, and a world without one: refused by name") {
  auto few = captures();
  few.erase(few.begin() + 3, few.end() - 1);
  auto scan = calibrate_by_scan(known(), few, world());
  REQUIRE_FALSE(scan);
  CHECK(scan.fault().code == "scan.few");
  scan = calibrate_by_scan(known(), captures(), {captures().size() - 1, Rigid{}, {}});
  REQUIRE_FALSE(scan);
  CHECK(scan.fault().code == "scan.world");
  CHECK(scan.fault().where == "room");
}

TEST_CASE("the command line does the same with pictures on disk, and changes the project") {
  namespace fs = std::filesystem;
  const fs::path at = fs::temp_directory_path() / ("focalstage-scan-" + std::to_string(::getpid()));
  const auto run = [&](const std::string& arguments) {
    const std::string quoted = std::string("'") + FOCALSTAGE_PROGRAM + "' calibrate " + arguments;
    return std::system((quoted + " > '" + (at / "out.json").string() + "'").c_str());
  };
  fs::create_directories(at / "room");
  Project project;
  project.name = "room";
  project.projectors.emplace_back();
  project.projectors[0].name = "main";
  project.projectors[0].width_px = set.width_px;
  project.projectors[0].height_px = set.height_px;
  project.projectors[0].gamma = set.gamma;
  project.slices.powers_d = {0.0};
  REQUIRE(save_project(project, at / "room" / "room.focal").ok());
  REQUIRE(run("patterns '" + (at / "room").string() + "' -o '" + (at / "scan").string() + "'") == 0);
  std::string entries;
  for (std::size_t i = 0; i < 5; ++i) {
    const std::string name = i < 4 ? "board-" + std::to_string(i + 1) : "surface";
    own::Shot shot;
    shot.exposure = 0.9;
    shot.samples = i < 4 ? 3 : 2;
    own::Photographer photographer(i < 4 ? with_board(held[i]) : wall_and_sheet(), projector(), small_camera(), shot,
                                   static_cast<std::uint32_t>(i + 70));
    const Capture capture = photographer.capture(set);
    fs::create_directories(at / "scan" / name);
    for (std::size_t k = 0; k < capture.size(); ++k) {
      const fs::path file = at / "scan" / name / ("shot" + std::to_string(k) + ".png");
      REQUIRE(write_png(file, capture[k].width_px, capture[k].height_px, 1, capture[k].gray).ok());
    }
    entries += (i == 0 ? "" : ", ") + ("{\"folder\": \"" + name + "\", \"board\": " + (i < 4 ? "true}" : "false}"));
  }
  const Rigid board_at = world_from_board(held[0]);
  char text[1000];
  std::snprintf(text, sizeof text,
                "{\"board\": {\"squares\": [9, 7], \"square_m\": 0.06, \"marker_m\": 0.036}, \"captures\": [%s], "
                "\"world\": {\"capture\": \"board-1\", \"position_m\": [%.17g, %.17g, %.17g], "
                "\"rotation_xyzw\": [%.17g, %.17g, %.17g, %.17g]}}",
                entries.c_str(), board_at.position_m.x, board_at.position_m.y, board_at.position_m.z,
                board_at.rotation.x, board_at.rotation.y, board_at.rotation.z, board_at.rotation.w);
  REQUIRE(write_file_atomically(at / "scan" / "scan.json", std::string_view(text)).ok());
  CHECK(run("scan '" + (at / "scan").string() + "' '" + (at / "room").string() + "' --json --mesh '" +
            (at / "surface.ply").string() + "'") == 0);
  const auto saved = load_project(at / "room");
  REQUIRE(saved);
  const ProjectorModel found = projector_model(saved->project.projectors[0]);
  MESSAGE("four boards, a camera of 640 x 480: off by ", off_mm(found, projector()), " mm, ",
          off_deg(found, projector()), " degrees");
  CHECK(off_mm(found, projector()) < 8.0);
  CHECK(reprojection_median_px(found) < 0.3);
  CHECK(fs::file_size(at / "surface.ply") > 100000);
  fs::remove_all(at);
}
