#include "core/reference/reference.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <numeric>

using namespace focalstage;

namespace {

constexpr double lens_to_pupil_m = 0.015;

/// A rectangle of two triangles facing +Z.
Drawable rectangle(glm::dvec2 low_m, glm::dvec2 high_m, double z_m) {
  auto mesh = std::make_shared<Mesh>();
  mesh->positions_m = {{low_m, z_m}, {high_m.x, low_m.y, z_m}, {high_m, z_m}, {low_m.x, high_m.y, z_m}};
  mesh->uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  mesh->triangles.emplace_back(0, 1, 2);
  mesh->triangles.emplace_back(0, 2, 3);
  return {mesh, glm::dmat4(1.0), {}};
}

StagedSurface surface(const Drawable& drawable) { return {"surface", 0, 0.0, {}, {drawable}}; }
StagedObject object(const Drawable& drawable, const Depth& depth = {}) { return {"object", 0, depth, {}, {drawable}}; }

/// Both eyes and the projector at the origin; a wide screen 0.5 m from the lens centre.
Stage room(const Drawable& shown, const Depth& depth = {}) {
  Stage stage;
  stage.interpupillary_m = 0.0;
  stage.surfaces = {surface(rectangle({-3, -3}, {3, 3}, -0.5 - lens_to_pupil_m))};
  stage.objects = {object(shown, depth)};
  return stage;
}

/// A row of pixels whose tangents start at zero and grow by 1/1000.
CompileSettings row_of(int width_px, std::vector<double> powers_d) {
  Project project;
  project.projectors.push_back({});
  project.slices.powers_d = std::move(powers_d);
  CompileSettings settings = compile_settings(project);
  settings.projector.width_px = width_px;
  settings.projector.height_px = 1;
  settings.projector.focal_px = {1000.0, 1000.0};
  settings.projector.centre_px = {0.0, 0.5};
  return settings;
}

int code_at(const CompiledFrame& frame, std::size_t image, std::size_t byte = 0) {
  return frame.images.image(image)[byte];
}

std::ptrdiff_t lit_bytes(const CompiledFrame& frame, std::size_t image) {
  const auto codes = frame.images.image(image);
  return std::count_if(codes.begin(), codes.end(), [](std::uint8_t code) { return code > 0; });
}

CompiledFrame compiled(const Stage& stage, const CompileSettings& settings) {
  Result<CompiledFrame> frame = compile_reference(stage, settings);
  REQUIRE(frame);
  return *std::move(frame);
}

const Drawable wide_at_40cm = rectangle({-3, -3}, {3, 3}, -0.4 - lens_to_pupil_m);

}  // namespace

TEST_CASE("half-way between two powers each slice gets half the light, encoded by gamma") {
  // Screen at 0.5 m, image wanted at 0.4 m: v = 2 - 2.5 = -0.5 D.
  CompileSettings settings = row_of(1, {0.0, -1.0});
  const CompiledFrame frame = compiled(room(wide_at_40cm), settings);
  REQUIRE(frame.images.count == 4);
  for (std::size_t image = 0; image < 4; ++image) CHECK(code_at(frame, image) == 128);  // 127.5 rounds up
  settings.gamma = 2.0;
  CHECK(code_at(compiled(room(wide_at_40cm), settings), 0) == 180);  // 255 sqrt(0.5) = 180.3
  settings.gamma = 1.0;
  settings.bits = 1;
  CHECK(code_at(compiled(room(wide_at_40cm), settings), 0) == 1);
}

TEST_CASE("the picture grows and shrinks with the power as the paper's resize says") {
  // Object edge at the look 0.3. Slice -1 D: stretch 0.515 / (0.515 + 0.0075) = 0.98565, so the edge stands at the
  // straight look 0.30437: pixel centres below it are 0..303. Slice 0 D: 0..299. Slice +1: 0.3 / 1.014778: 0..295.
  const Drawable edge = rectangle({-3, -3}, {0.3 * 0.415, 3}, -0.415);
  CompileSettings settings = row_of(400, {-1.0, 0.0, 1.0});
  Stage stage = room(edge, {DepthMode::slice, 0.0, 0, {}});
  CHECK(lit_bytes(compiled(stage, settings), 0) == 304);
  CHECK(lit_bytes(compiled(stage, settings), 1) == 0);
  stage.objects[0].depth.index = 1;
  CHECK(lit_bytes(compiled(stage, settings), 1) == 300);
  stage.objects[0].depth.index = 2;
  CHECK(lit_bytes(compiled(stage, settings), 2) == 296);
  settings.slices.breathing = Breathing::off;
  CHECK(lit_bytes(compiled(stage, settings), 2) == 300);
}

TEST_CASE("planar breathing resizes all of a smooth part by the distance of its centre") {
  // A screen that recedes to the right, 0.515 from the pupil at its centre, which lies straight ahead; the lens, for
  // once 0.1 m before the pupil, at 8 D. Planar: d_c = 0.415, so the edge at the look 0.3 stands at the straight look
  // 0.3 (1 - 0.8 * 0.415 / 0.515) = 0.106602: pixel centres 0..106. Exactly: the point at the straight look s lies
  // 0.515 + 0.16 m deep with 0.6 m = s * depth; at s = 0.10529 that is 0.52988: 0.3 (1 - 0.8 * 0.42988 / 0.52988).
  const Drawable edge = rectangle({-3, -3}, {0.3 * 0.415, 3}, -0.415);
  Stage stage = room(edge, {DepthMode::slice, 0.0, 0, {}});
  stage.surfaces[0].drawables[0].world_from_mesh[0] = {0.6, 0.0, -0.16, 0.0};
  CompileSettings settings = row_of(400, {8.0});
  settings.lens_to_pupil_m = 0.1;
  CHECK(lit_bytes(compiled(stage, settings), 0) == 105);
  settings.slices.breathing = Breathing::planar;
  CHECK(lit_bytes(compiled(stage, settings), 0) == 107);
}

TEST_CASE("depth modes: fixed and offset vergences, and light beyond the outermost slice") {
  const CompileSettings settings = row_of(1, {-1.0, 0.0, 1.0});
  // fixed 2.25 D: v = 2 - 2.25 = -0.25 D.
  const CompiledFrame fixed = compiled(room(wide_at_40cm, {DepthMode::fixed, 2.25, 0, {}}), settings);
  CHECK(code_at(fixed, 0) == 64);   // 63.75
  CHECK(code_at(fixed, 1) == 191);  // 191.25
  CHECK(code_at(fixed, 2) == 0);
  // offset -1.25 D: v = 2 - (2.5 - 1.25) = 0.75 D.
  const CompiledFrame offset = compiled(room(wide_at_40cm, {DepthMode::offset, -1.25, 0, {}}), settings);
  CHECK(code_at(offset, 1) == 64);
  CHECK(code_at(offset, 2) == 191);
  CHECK(offset.measure.objects[0].samples == 4);  // two slices, two eyes
  CHECK(offset.measure.objects[0].beyond == 0);
  // fixed 5 D: v = -3 D, 2 D below the lowest.
  const CompiledFrame beyond = compiled(room(wide_at_40cm, {DepthMode::fixed, 5.0, 0, {}}), settings);
  CHECK(code_at(beyond, 0) == 255);
  CHECK(code_at(beyond, 1) == 0);
  CHECK(beyond.measure.objects[0].samples == 2);
  CHECK(beyond.measure.objects[0].beyond == 2);
  CHECK(beyond.measure.objects[0].worst_beyond_d == doctest::Approx(2.0));
}

TEST_CASE("a nearer object hides a farther one even in slices where it has no weight itself") {
  Stage stage = room(wide_at_40cm, {DepthMode::slice, 0.0, 1, {}});
  stage.objects.push_back(object(rectangle({-3, -3}, {3, 3}, -0.3), {DepthMode::slice, 0.0, 0, {}}));
  stage.objects[1].index = 1;
  const CompiledFrame frame = compiled(stage, row_of(1, {-1.0, 0.0}));
  CHECK(code_at(frame, 0) == 255);
  CHECK(code_at(frame, 1) == 0);
}

TEST_CASE("a virtual object behind the real surface is drawn, one before the lens plane is not") {
  const CompileSettings settings = row_of(1, {0.0});
  CHECK(code_at(compiled(room(rectangle({-9, -9}, {9, 9}, -4.0)), settings), 0) == 255);
  CHECK(code_at(compiled(room(rectangle({-3, -3}, {3, 3}, -0.0155)), settings), 0) == 0);  // 0.5 mm before the lens
}

TEST_CASE("a point that another surface hides from one eye is dark for that eye alone") {
  // The projector at the origin sees past a post that stands between the left eye and the point.
  Stage stage = room(wide_at_40cm);
  stage.interpupillary_m = 0.06;
  stage.surfaces.push_back(surface(rectangle({-0.02, -1}, {-0.01, 1}, -0.2575)));  // half-way
  const CompiledFrame frame = compiled(stage, row_of(1, {0.0}));
  CHECK(code_at(frame, 0) == 0);
  CHECK(code_at(frame, 1) == 255);
}

TEST_CASE("the two eyes see an object shifted by their parallax") {
  // Object edge at x = 0.1, depth 0.415; screen at depth 0.515. Left eye at -0.03: look 0.13/0.415 = 0.313253, on the
  // screen at 0.161325 - 0.03 = 0.131325, from the projector at the tangent 0.255; right: 0.286864 * 1000 -> 0..286.
  Stage stage = room(rectangle({-3, -3}, {0.1, 3}, -0.415));
  stage.interpupillary_m = 0.06;
  const CompiledFrame frame = compiled(stage, row_of(400, {0.0}));
  const double left = (0.13 / 0.415 * 0.515 - 0.03) / 0.515 * 1000.0;
  const double right = (0.07 / 0.415 * 0.515 + 0.03) / 0.515 * 1000.0;
  CHECK(lit_bytes(frame, 0) == std::lround(left));
  CHECK(lit_bytes(frame, 1) == std::lround(right));
}

TEST_CASE("four samples a pixel give an edge its share of light") {
  // Straight looks of the samples: 0.25 and 0.75 px; the edge at 0.5 px takes the left half of the pixel.
  const Drawable edge = rectangle({-3, -3}, {0.0005 * 0.415, 3}, -0.415);
  CompileSettings settings = row_of(2, {0.0});
  settings.slices.samples_per_pixel = 4;
  const CompiledFrame frame = compiled(room(edge), settings);
  CHECK(code_at(frame, 0, 0) == 128);
  CHECK(code_at(frame, 0, 1) == 0);
}

TEST_CASE("illumination is added where a surface is hit, and alone in a light image") {
  Stage stage = room(rectangle({0.5, 0.5}, {1, 1}, -0.415));  // the object is elsewhere
  stage.surfaces[0].illumination = 0.4;
  CompileSettings settings = row_of(1, {0.5});
  settings.images = {{ImageEye::left, ImageKind::content_and_light, 0.5, 0},
                     {ImageEye::right, ImageKind::content, 0.5, 0},
                     {ImageEye::both, ImageKind::surface_light, 0.0, -1}};
  const CompiledFrame frame = compiled(stage, settings);
  CHECK(code_at(frame, 0) == 102);
  CHECK(code_at(frame, 1) == 0);
  CHECK(code_at(frame, 2) == 102);
}

TEST_CASE("colour projectors get three channels, too much light is clipped and counted") {
  Drawable drawable = wide_at_40cm;
  drawable.finish.a = {1.5, 0.5, 0.0};
  CompileSettings settings = row_of(2, {0.0});
  settings.channels = 3;
  const CompiledFrame frame = compiled(room(drawable), settings);
  CHECK(code_at(frame, 0, 0) == 255);
  CHECK(code_at(frame, 0, 1) == 128);
  CHECK(code_at(frame, 0, 2) == 0);
  CHECK(code_at(frame, 0, 3) == 255);
  CHECK(frame.measure.lit_pixels == 4);
  CHECK(frame.measure.clipped_pixels == 4);
  settings.channels = 1;
  CHECK(compiled(room(drawable), settings).measure.clipped_pixels == 0);  // luminance 0.68
}

TEST_CASE("surfaces outside the projector's depth of field are counted with how far") {
  CompileSettings settings = row_of(5, {0.0});
  settings.focus_m = 1.0;
  settings.depth_of_field_d = 0.5;
  const CompiledFrame frame = compiled(room(wide_at_40cm), settings);
  CHECK(frame.measure.surface_pixels == 5);
  CHECK(frame.measure.defocused_pixels == 5);
  CHECK(frame.measure.worst_defocus_d == doctest::Approx(1.0 / 0.515 - 1.0 - 0.25));  // beyond half the depth of field
  settings.depth_of_field_d = 2.0;
  CHECK(compiled(room(wide_at_40cm), settings).measure.defocused_pixels == 0);
}

TEST_CASE("the rule that is not known is refused") {
  CompileSettings settings = row_of(1, {0.0});
  settings.slices.assignment = Assignment::optimal;
  const auto frame = compile_reference(room(wide_at_40cm), settings);
  REQUIRE_FALSE(frame);
  CHECK(frame.fault().code == "compile.assignment");
  CHECK(frame.fault().remedy.find("--reference") != std::string::npos);
}

TEST_CASE("an empty room is dark") {
  const CompiledFrame frame = compiled(Stage{}, row_of(3, {0.0}));
  CHECK(std::accumulate(frame.images.codes.begin(), frame.images.codes.end(), 0) == 0);
  CHECK(frame.measure.surface_pixels == 0);
}
