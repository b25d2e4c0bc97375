#include "core/stage/stage.h"

#include <doctest/doctest.h>

#include <limits>
#include <thread>

#include <glm/geometric.hpp>

#include "core/mesh/primitives.h"

using namespace focalstage;

namespace {

Surface surface(const std::string& name, MeshShape shape) {
  Surface made;
  made.name = name;
  made.mesh.shape = std::move(shape);
  return made;
}

Object object(const std::string& name, MeshShape shape, Appearance appearance = MaterialAppearance{}) {
  Object made;
  made.name = name;
  made.mesh.shape = std::move(shape);
  made.appearance = std::move(appearance);
  return made;
}

/// A red, a textured and an unlit part on a child node that stands at x = 1 and moves up in a second.
Assets assets_with_model() {
  auto mesh = std::make_shared<const Mesh>(make_plane({1, 1}));
  auto model = std::make_shared<Model>();
  model->materials.push_back({"red", {1, 0, 0}, nullptr, false});
  model->materials.push_back({"tiles", {1, 1, 1}, std::make_shared<Texture>(Texture{1, 1, {9, 9, 9, 255}}), false});
  model->materials.push_back({"glow", {0, 1, 0}, nullptr, true});
  model->nodes.resize(2);
  model->nodes[1].parent = 0;
  model->nodes[1].pose.translation = {1, 0, 0};
  model->nodes[1].parts = {{mesh, 0}, {mesh, 1}, {mesh, 2}, {mesh, -1}};
  AnimationChannel rise;
  rise.node = 0;
  rise.times_s = {0, 1};
  rise.values = {{0, 0, 0, 0}, {0, 1, 0, 0}};
  model->animations.push_back({"rise", {rise}});
  return {{{"assets/parts.glb", model}}};
}

Finish flat(const glm::dvec3& color, bool lit = false) {
  Finish finish;
  finish.a = color;
  finish.lit = lit;
  return finish;
}

glm::dvec3 origin_of(const Drawable& drawable) { return glm::dvec3(drawable.world_from_mesh[3]); }

}  // namespace

TEST_CASE("a thing stands at its pose, scaled, and keeps its place in the project's list") {
  Project project;
  project.surfaces = {surface("hidden", PlaneMesh{}), surface("screen", PlaneMesh{{2, 1}})};
  project.surfaces[0].hidden = true;
  project.surfaces[1].placement.pose.position_m = {0, 0, -0.5};
  project.surfaces[1].scale = 3.0;
  project.surfaces[1].illumination = 0.25;
  project.objects = {object("near", BoxMesh{})};
  project.objects[0].depth.mode = DepthMode::fixed;
  project.viewer.interpupillary_mm = 60;
  const Result<Stage> stood = stage(project, {}, 0.0);
  REQUIRE(stood.ok());
  REQUIRE(stood->surfaces.size() == 1);
  CHECK(stood->surfaces[0].name == "screen");
  CHECK(stood->surfaces[0].index == 1);
  CHECK(stood->surfaces[0].illumination == 0.25);
  CHECK(stood->surfaces[0].drawables[0].world_from_mesh * glm::dvec4(1, 0.5, 0, 1) == glm::dvec4(3, 1.5, -0.5, 1));
  CHECK(stood->objects[0].depth.mode == DepthMode::fixed);
  CHECK(stood->interpupillary_m == doctest::Approx(0.06));
}

TEST_CASE("viewer, surfaces and a file's own animation run on one clock") {
  Project project;
  Keyframe start;
  Keyframe end;
  end.time_s = 2.0;
  end.pose.position_m = {4, 0, 0};
  project.viewer.placement.keys = {start, end};
  project.objects = {object("parts", FileMesh{"assets/parts.glb"})};
  project.objects[0].placement.keys = {start, end};
  project.objects[0].scale = 10.0;
  const Result<Stage> stood = stage(project, assets_with_model(), 0.5);
  REQUIRE(stood.ok());
  CHECK(stood->world_from_viewer.position_m == glm::dvec3(1, 0, 0));
  REQUIRE(stood->objects[0].drawables.size() == 4);
  // The object at x = 1, its node at 10 x (1, 0.5, 0).
  CHECK(glm::length(origin_of(stood->objects[0].drawables[0]) - glm::dvec3(11, 5, 0)) < 1e-14);
}

TEST_CASE("appearance decides the finish; light acts on materials that take it, where there is some") {
  Project project;
  project.objects = {object("file", FileMesh{"assets/parts.glb"}),
                     object("unlit", FileMesh{"assets/parts.glb"}, UnlitAppearance{{0.1, 0.2, 0.3}}),
                     object("checker", SphereMesh{0.1}, CheckerAppearance{{4, 2}, {1, 1, 0}, {0, 0, 1}}),
                     object("plain", SphereMesh{0.1})};
  for (const bool lights : {false, true}) {
    if (lights) project.lights.emplace_back();
    const Result<Stage> stood = stage(project, assets_with_model(), 0.0);
    REQUIRE(stood.ok());
    CHECK(stood->lights.size() == (lights ? 1 : 0));
    const auto& parts = stood->objects[0].drawables;
    CHECK(parts[0].finish == flat({1, 0, 0}, lights));
    CHECK(parts[1].finish.kind == Finish::Kind::textured);
    CHECK(parts[1].finish.texture->rgba[0] == 9);
    CHECK(parts[1].finish.lit == lights);
    CHECK(parts[2].finish == flat({0, 1, 0}));
    CHECK(parts[3].finish == flat({1, 1, 1}, lights));
    for (const Drawable& part : stood->objects[1].drawables) CHECK(part.finish == flat({0.1, 0.2, 0.3}));
    const Finish& checker = stood->objects[2].drawables[0].finish;
    CHECK(checker.kind == Finish::Kind::checker);
    CHECK(checker.a == glm::dvec3(1, 1, 0));
    CHECK(checker.b == glm::dvec3(0, 0, 1));
    CHECK(checker.squares == glm::ivec2(4, 2));
    CHECK_FALSE(checker.lit);
    CHECK(stood->objects[3].drawables[0].finish == flat({1, 1, 1}, lights));
  }
}

namespace {

/// Remembers what it was asked for; a texture of one pixel, or a fault.
class OnePixel : public StoredPicture {
 public:
  explicit OnePixel(int code) : code_(code) {}

  Result<std::shared_ptr<const Texture>> texture(const TextureUse& use) const override {
    if (code_ < 0) return Fault{"image.invalid", "frames/b4.png", "bad PNG", "export it again"};
    Texture texture{1, 1, {static_cast<std::uint8_t>(code_), 0, 0, 255}};
    texture.wrap_u = texture.wrap_v = use.wrap;
    return std::make_shared<const Texture>(texture);
  }

 private:
  int code_;
};

}  // namespace

TEST_CASE("a sequence's picture of the moment is the object's finish; between shows it is not there") {
  Assets assets;
  for (int k = 1; k <= 3; ++k) {
    assets.pictures["frames/b" + std::to_string(k) + ".png"] = std::make_shared<const OnePixel>(k);
  }
  assets.pictures["frames/b4.png"] = std::make_shared<const OnePixel>(-1);
  ImageAppearance image;
  image.file = "frames/b#.png";
  image.count = 3;
  image.rate_hz = 10.0;
  image.start_s = 1.0;
  image.end = SequenceEnd::once;
  image.wrap = Wrap::mirror;
  image.lit = true;
  image.alpha_cutoff = 0.25;
  Project project;
  project.objects = {object("poster", PlaneMesh{}, image), object("box", BoxMesh{})};
  project.lights.resize(1);
  const auto at = [&](double time_s) {
    const Result<Stage> stood = stage(project, assets, time_s);
    if (!stood) FAIL(describe(stood.fault()));
    return *stood;
  };
  for (int k = 0; k < 3; ++k) {
    const Stage stood = at(1.0 + k / 10.0);
    REQUIRE(stood.objects[0].drawables.size() == 1);
    const Finish& finish = stood.objects[0].drawables[0].finish;
    CHECK(finish.kind == Finish::Kind::textured);
    CHECK(finish.texture->rgba[0] == k + 1);
    CHECK(finish.texture->wrap_v == Wrap::mirror);
    CHECK(finish.lit);
    CHECK(finish.alpha_cutoff == 0.25);
    CHECK(finish.a == glm::dvec3(1.0));
  }
  for (const double outside_s : {0.0, 0.95, 1.3, 50.0}) {
    const Stage stood = at(outside_s);
    CHECK(stood.objects.size() == 2);
    CHECK(stood.objects[0].drawables.empty());
    CHECK(stood.objects[1].drawables.size() == 1);
  }
  std::get<ImageAppearance>(project.objects[0].appearance).count = 5;
  const auto fault_at = [&](double time_s) {
    const Result<Stage> stood = stage(project, assets, time_s);
    REQUIRE_FALSE(stood.ok());
    CHECK(stood.fault().where.starts_with("/objects/0/appearance/image/file"));
    return stood.fault();
  };
  CHECK(fault_at(1.3).code == "image.invalid");
  CHECK(fault_at(1.3).message.find("frames/b4.png") != std::string::npos);
  CHECK(fault_at(1.4).code == "stage.asset-missing");
  CHECK(fault_at(1.4).message.find("frames/b5.png") != std::string::npos);
}

TEST_CASE("one shape is one mesh, between calls and between threads") {
  Project project;
  project.surfaces = {surface("a", RabbitMesh{}), surface("b", RabbitMesh{}), surface("c", PlaneMesh{{0.3, 0.4}})};
  std::vector<const Mesh*> seen(4);
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    threads.emplace_back([&, i] { seen[i] = stage(project, {}, 0.0)->surfaces[0].drawables[0].mesh.get(); });
  }
  for (std::thread& thread : threads) thread.join();
  for (const Mesh* mesh : seen) CHECK(mesh == seen[0]);
  const Stage again = *stage(project, {}, 1.0);
  CHECK(again.surfaces[1].drawables[0].mesh.get() == seen[0]);
  CHECK(*again.surfaces[2].drawables[0].mesh == make_plane({0.3, 0.4}));
  project.surfaces[2].mesh.shape = PlaneMesh{{0.3, 0.41}};
  CHECK(stage(project, {}, 1.0)->surfaces[2].drawables[0].mesh != again.surfaces[2].drawables[0].mesh);
}

TEST_CASE("what cannot be stood up is named by its place in the project") {
  Project project;
  project.surfaces = {surface("screen", PlaneMesh{})};
  project.objects = {object("a", TeapotMesh{}), object("b", FileMesh{"assets/none.obj"})};
  Result<Stage> stood = stage(project, {}, 0.0);
  REQUIRE_FALSE(stood.ok());
  CHECK(stood.fault().code == "stage.asset-missing");
  CHECK(stood.fault().where == "/objects/1/mesh/file");
  project.objects[1].hidden = true;
  CHECK(stage(project, {}, 0.0).ok());

  project.surfaces[0].mesh.process = {{FlipStep{}, {}}, {KeepPartStep{3, 30.0}, {}}};
  stood = stage(project, {}, 0.0);
  REQUIRE_FALSE(stood.ok());
  CHECK(stood.fault().code == "process.no-part");
  CHECK(stood.fault().where == "/surfaces/0/mesh/process/1/part");
}

TEST_CASE("a thing's mesh stands there after its steps, the same one in every frame") {
  Project project;
  project.surfaces = {surface("screen", PlaneMesh{})};
  project.surfaces[0].mesh.process = {{FlipStep{}, {}}};
  const Result<Stage> stood = stage(project, {}, 0.0);
  REQUIRE(stood);
  CHECK(stood->surfaces[0].drawables[0].mesh->normals[0].z == -1.0);
  CHECK(stage(project, {}, 1.0)->surfaces[0].drawables[0].mesh == stood->surfaces[0].drawables[0].mesh);
}

TEST_CASE("the lengths of steps are the room's, whatever the file was written in") {
  Project project;
  project.objects = {object("bowl", SphereMesh{500.0})};  // millimetres
  project.objects[0].scale = 0.001;
  const auto triangles = [&](double error_mm) {
    project.objects[0].mesh.process = {{DecimateStep{std::nullopt, error_mm}, {}}};
    return stage(project, {}, 0.0)->objects[0].drawables[0].mesh->triangles.size();
  };
  const std::size_t as_said = triangles(2.0);
  project.objects[0].scale = 1.0;
  project.objects[0].mesh.shape = SphereMesh{0.5};
  const std::size_t in_metres = triangles(2.0);
  CHECK(as_said < 3000);
  CHECK(static_cast<double>(as_said) == doctest::Approx(static_cast<double>(in_metres)).epsilon(0.02));
}

TEST_CASE("sizes no mesh can be made of are refused") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::pair<MeshShape, std::string> wrong[] = {
      {PlaneMesh{{0, 1}}, "size_m"},          {PlaneMesh{{1, -1}}, "size_m"},     {PlaneMesh{{nan, 1}}, "size_m"},
      {BoxMesh{{1, 1, 1e300}}, "size_m"},     {SphereMesh{0}, "radius_m"},        {CornerMesh{{1, 1}, 0}, "angle_deg"},
      {CornerMesh{{1, 1}, 360}, "angle_deg"}, {CornerMesh{{0, 1}, 90}, "size_m"}, {StepMesh{{1, 1}, nan}, "depth_m"},
      {StepMesh{{1, 0}, 0.1}, "size_m"},
  };
  for (const auto& [shape, key] : wrong) {
    Project project;
    project.surfaces = {surface("screen", shape)};
    const Result<Stage> stood = stage(project, {}, 0.0);
    REQUIRE_FALSE(stood.ok());
    CHECK(stood.fault().code == "stage.mesh-size");
    CHECK(stood.fault().where == "/surfaces/0/mesh/" + key);
  }
}

TEST_CASE("a surface stands with its paint: a colour, a picture, its own material without the lights") {
  Project project;
  project.lights.emplace_back();
  project.surfaces = {surface("plain", PlaneMesh{}), surface("painted", PlaneMesh{}), surface("pictured", PlaneMesh{}),
                      surface("own", FileMesh{"assets/parts.glb"})};
  project.surfaces[1].albedo = PlainAlbedo{{0.5, 0.25, 0.125}};
  project.surfaces[2].albedo = FileAlbedo{"assets/bricks.png", {}};
  project.surfaces[3].albedo = MaterialAlbedo{};
  Assets assets = assets_with_model();
  const Result<Stage> without = stage(project, assets, 0.0);
  REQUIRE_FALSE(without.ok());
  CHECK(without.fault().code == "stage.asset-missing");
  CHECK(without.fault().where == "/surfaces/2/albedo/file");
  assets.pictures["assets/bricks.png"] = std::make_shared<const OnePixel>(3);
  const Result<Stage> staged = stage(project, assets, 0.0);
  REQUIRE(staged.ok());
  const auto& surfaces = staged->surfaces;
  CHECK(surfaces[0].drawables[0].finish == Finish{});
  CHECK(surfaces[1].drawables[0].finish == flat({0.5, 0.25, 0.125}));
  CHECK(surfaces[2].drawables[0].finish.kind == Finish::Kind::textured);
  REQUIRE(surfaces[2].drawables[0].finish.texture);
  CHECK(surfaces[2].drawables[0].finish.texture->wrap_u == Wrap::clamp);
  CHECK(surfaces[3].drawables[0].finish.a == glm::dvec3(1, 0, 0));
  for (const Drawable& drawable : surfaces[3].drawables) CHECK_FALSE(drawable.finish.lit);
}
