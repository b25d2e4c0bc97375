#include <doctest/doctest.h>

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "core/compile/compile.h"
#include "core/reference/reference.h"
#include "tests/exact/forward_trace.h"
#include "tests/exact/room_of.h"
#include "tests/support/shapes.h"

using namespace focalstage;
using namespace focalstage::exact;

namespace {

constexpr double tolerance_px = 0.05;  // design section 10

struct EdgeScene {
  std::string name;
  Stage stage;
  CompileSettings settings;
};

StagedObject checkered(const Drawable& drawable, glm::ivec2 squares, const Depth& depth = {}) {
  StagedObject object = support::object_of(drawable, depth);
  Finish& finish = object.drawables[0].finish;
  finish.kind = Finish::Kind::checker;
  finish.squares = squares;
  finish.b = glm::dvec3(0.3);
  return object;
}

Rigid at(const glm::dvec3& position_m, double angle_rad = 0.0, const glm::dvec3& axis = {0, 1, 0}) {
  return {position_m, glm::angleAxis(angle_rad, glm::normalize(axis))};
}

EdgeScene scene(std::string name, std::vector<double> powers_d, StagedSurface surface,
                std::vector<StagedObject> objects) {
  EdgeScene made;
  made.name = std::move(name);
  made.stage.surfaces = {std::move(surface)};
  made.stage.objects = std::move(objects);
  Project project;
  Projector projector;
  projector.width_px = 400;
  projector.height_px = 300;
  projector.fx_px = projector.fy_px = 480.0;
  projector.cx_px = 203.0;
  projector.cy_px = 148.5;
  projector.pose = support::looking({0.12, 0.2, 0.05}, {0.0, 0.0, -0.5}, 0.1);
  project.projectors.push_back(projector);
  project.slices.powers_d = std::move(powers_d);
  made.settings = compile_settings(project);
  return made;
}

std::vector<EdgeScene> edge_scenes() {
  using namespace support;
  std::vector<EdgeScene> all;
  all.push_back(scene("slanted screen, slanted checker", {-1.5, -0.5, 0.5, 1.5},
                      surface_of(standing(rectangle({1.4, 1.2}), at({0, 0, -0.5}, 0.5, {0.2, 1, 0}))),
                      {checkered(standing(rectangle({3.0, 2.4}), at({0, 0, -0.7}, -0.9)), {75, 60})}));
  all.push_back(scene("corner, two boxes", {1.0, -1.0, 0.0},
                      surface_of(standing(fold({0.6, 0.9}, 100.0), at({0.03, 0, -0.6}, 0.1))),
                      {checkered(standing(box({0.15, 0.2, 0.1}), at({-0.06, 0, -0.4}, 0.4)), {12, 12}),
                       checkered(standing(box({0.3, 0.3, 0.2}), at({0.15, 0.03, -0.9}, 0.7)), {12, 12},
                                 {DepthMode::offset, 0.3, 0, {}})}));
  all.push_back(scene("waves, blob", {-1.2, 0.0, 1.2},
                      surface_of(standing(bumpy({1.2, 0.9}, 0.03, 60, 2.0), at({0, 0, -0.52}))),
                      {checkered(standing(blob(0.16, 40, 0.2, 5), at({0.02, 0.0, -0.6})), {60, 30}),
                       checkered(standing(rectangle({0.2, 0.2}), at({-0.1, 0.02, -0.35}, 0.2)), {16, 16},
                                 {DepthMode::fixed, 2.2, 0, {}})}));
  EdgeScene bent = scene("step through a bent lens, head tilted", {-2.0, 2.0, 0.7},
                         surface_of(standing(step({1.3, 1.0}, 0.12), at({0.0, 0, -0.5}))),
                         {checkered(standing(rectangle({1.6, 1.6}), at({0.05, 0, -0.8}, 0.3, {1, 1, 0})), {60, 60},
                                    {DepthMode::slice, 0.0, 1, {}})});
  bent.settings.projector.distortion = {-0.12, 0.03, 0.002, -0.003, 0.01};
  bent.stage.world_from_viewer = at({0.02, -0.03, 0.04}, 0.15, {0.3, 0.5, 1.0});
  bent.settings.gamma = 2.2;
  bent.settings.slices.assignment = Assignment::nearest;
  all.push_back(std::move(bent));
  return all;
}

forward::EdgeReport checked(const forward::Room& room, const FrameImages& images, const std::vector<ImageSpec>& specs,
                            std::uint64_t enough = ~std::uint64_t{0}) {
  forward::EdgeReport all;
  for (std::size_t i = 0; i < specs.size() && all.contradicted < enough; ++i) {
    const int eye = specs[i].eye == ImageEye::left ? 0 : 1;
    all += forward::check_edges(room, {eye, static_cast<std::size_t>(specs[i].slice), images.image(i)}, tolerance_px,
                                enough);
  }
  return all;
}

FrameImages compiled(const Stage& stage, const CompileSettings& settings) {
  Result<CompiledFrame> frame = Compiler(settings).frame(stage);
  REQUIRE(frame);
  return std::move(frame->images);
}

struct Mutant {
  std::string name;
  std::function<void(Stage&, CompileSettings&)> change;
};

/// Mistakes that the check must notice.
const std::vector<Mutant>& mutants() {
  static const std::vector<Mutant> all{
      {"breathing off", [](Stage&, CompileSettings& settings) { settings.slices.breathing = Breathing::off; }},
      {"lens 1 mm farther", [](Stage&, CompileSettings& settings) { settings.lens_to_pupil_m += 0.001; }},
      {"eyes swapped",
       [](Stage&, CompileSettings& settings) {
         for (ImageSpec& image : settings.images) {
           image.eye = image.eye == ImageEye::left ? ImageEye::right : ImageEye::left;
         }
       }},
      {"half a pixel aside", [](Stage&, CompileSettings& settings) { settings.projector.centre_px.x -= 0.5; }},
      {"half a pixel down", [](Stage&, CompileSettings& settings) { settings.projector.centre_px.y += 0.5; }},
      {"a tenth of a pixel aside", [](Stage&, CompileSettings& settings) { settings.projector.centre_px.x += 0.1; }}};
  return all;
}

/// Two of the scenes from a projector whose mirrors stand on their corners: rows are half as far apart.
std::vector<EdgeScene> diamond_scenes() {
  std::vector<EdgeScene> all = edge_scenes();
  all.erase(all.begin() + 1, all.end() - 1);
  for (EdgeScene& scene : all) {
    scene.name += ", from diamonds";
    ProjectorModel& projector = scene.settings.projector;
    projector.layout = PixelLayout::diamond;
    projector.height_px *= 2;
    projector.focal_px.y *= 2.0;
    projector.centre_px.y *= 2.0;
  }
  return all;
}

/// As if even rows were the shifted ones: of a picture one row higher, all rows but the first.
FrameImages compiled_with_even_rows_shifted(const Stage& stage, CompileSettings settings) {
  settings.projector.height_px += 1;
  settings.projector.centre_px.y += 1.0;
  FrameImages higher = compiled(stage, settings);
  FrameImages images = higher;
  images.height_px -= 1;
  images.codes.clear();
  for (std::size_t i = 0; i < settings.images.size(); ++i) {
    const auto codes = higher.image(i);
    images.codes.insert(images.codes.end(), codes.begin() + higher.width_px, codes.end());
  }
  return images;
}

/// That what the compiler makes of a scene lies where the light says.
void check_edges_of(const EdgeScene& scene) {
  INFO(scene.name);
  const forward::Room room = room_of(scene.stage, scene.settings);
  const forward::EdgeReport report = checked(room, compiled(scene.stage, scene.settings), scene.settings.images);
  MESSAGE(scene.name << ": " << report.edges << " edges, worst " << report.worst_px << " px, mean " << report.mean_px()
                     << " px off");
  CHECK(report.edges > 5000);
  CHECK(report.contradicted == 0);
  CHECK(report.worst_px <= tolerance_px);
  CHECK(report.mean_px() < 1e-3);
}

}  // namespace

TEST_CASE("every edge lies where light through a thin lens puts it") {
  for (const EdgeScene& scene : edge_scenes()) check_edges_of(scene);
}

TEST_CASE("the reference's edges lie there too") {
  for (const EdgeScene& scene : edge_scenes()) {
    INFO(scene.name);
    const auto frame = compile_reference(scene.stage, scene.settings);
    REQUIRE(frame);
    const forward::EdgeReport report =
        checked(room_of(scene.stage, scene.settings), frame->images, scene.settings.images);
    CHECK(report.contradicted == 0);
    CHECK(report.mean_px() < 1e-4);
  }
}

TEST_CASE("the check notices each mistake in every scene") {
  for (const EdgeScene& scene : edge_scenes()) {
    const forward::Room room = room_of(scene.stage, scene.settings);
    for (const Mutant& mutant : mutants()) {
      Stage stage = scene.stage;
      CompileSettings settings = scene.settings;
      mutant.change(stage, settings);
      const forward::EdgeReport report = checked(room, compiled(stage, settings), scene.settings.images, 100);
      INFO(scene.name << ", " << mutant.name << ": " << report.contradicted << " contradictions");
      CHECK(report.contradicted >= 100);
    }
  }
}

TEST_CASE("from a diamond lattice edges lie where the light of its true mirrors puts them") {
  for (const EdgeScene& scene : diamond_scenes()) {
    INFO(scene.name);
    check_edges_of(scene);
    const auto reference = compile_reference(scene.stage, scene.settings);
    REQUIRE(reference);
    CHECK(checked(room_of(scene.stage, scene.settings), reference->images, scene.settings.images).contradicted == 0);
  }
}

TEST_CASE("the check notices a lattice that is taken for another") {
  for (const EdgeScene& scene : diamond_scenes()) {
    INFO(scene.name);
    const forward::Room room = room_of(scene.stage, scene.settings);
    const FrameImages even = compiled_with_even_rows_shifted(scene.stage, scene.settings);
    CHECK(checked(room, even, scene.settings.images, 100).contradicted >= 100);
    CompileSettings square = scene.settings;
    square.projector.layout = PixelLayout::square;
    CHECK(checked(room, compiled(scene.stage, square), scene.settings.images, 100).contradicted >= 100);
    square.projector.centre_px.x -= 0.25;  // right on average, wrong in every row
    CHECK(checked(room, compiled(scene.stage, square), scene.settings.images, 100).contradicted >= 100);
  }
}
