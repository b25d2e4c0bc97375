#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "core/stage/stage.h"
#include "tests/io/assets/gltf_writer.h"

using namespace focalstage;
using namespace focalstage::test;

namespace {

bool has_code(const MeshFile& file, const std::string& code) {
  return std::any_of(file.findings.begin(), file.findings.end(), [&](const Finding& f) { return f.code == code; });
}

Json& primitive_of(Gltf& gltf) { return gltf.json["meshes"][0]["primitives"][0]; }

template <class T>
std::size_t add_vec4(Gltf& gltf, int component_type, bool normalized, const std::vector<T>& values) {
  Bytes data;
  for (const T value : values) put(data, value);
  gltf.json["accessors"].push_back({{"bufferView", gltf.add_view(data)},
                                    {"componentType", component_type},
                                    {"count", values.size() / 4},
                                    {"type", "VEC4"},
                                    {"normalized", normalized}});
  return gltf.json["accessors"].size() - 1;
}

/// The square with its lower edge on a joint at (0,0,0) and its upper edge on one at (0,1,0), which turns in the second
/// second by a right angle about Z. The mesh's node stands elsewhere, which means nothing.
Gltf skinned_square() {
  Gltf gltf = square_gltf();
  gltf.json.erase("animations");
  gltf.json["nodes"].push_back({{"name", "foot"}, {"children", {3}}});
  gltf.json["nodes"].push_back({{"name", "head"}, {"translation", {0, 1, 0}}});
  gltf.json["scenes"][0]["nodes"] = {0, 2};
  primitive_of(gltf)["attributes"]["JOINTS_0"] =
      add_vec4<std::uint8_t>(gltf, 5121, false, {0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0});
  primitive_of(gltf)["attributes"]["WEIGHTS_0"] =
      gltf.add_floats("VEC4", {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0});
  Bytes binds;
  for (const float y : {0.0f, -1.0f}) {
    for (const float value :
         {1.0f, 0.0f, 0.0f, 0.0f, 0.0f, 1.0f, 0.0f, 0.0f, 0.0f, 0.0f, 1.0f, 0.0f, 0.0f, y, 0.0f, 1.0f}) {
      put(binds, value);
    }
  }
  gltf.json["accessors"].push_back(
      {{"bufferView", gltf.add_view(binds)}, {"componentType", 5126}, {"count", 2}, {"type", "MAT4"}});
  gltf.json["skins"].push_back({{"joints", {2, 3}}, {"inverseBindMatrices", gltf.json["accessors"].size() - 1}});
  gltf.json["nodes"][1]["skin"] = 0;
  Json sampler;
  const float s = std::sqrt(0.5f);
  sampler["input"] = gltf.add_floats("SCALAR", {1, 2});
  sampler["output"] = gltf.add_floats("VEC4", {0, 0, 0, 1, 0, 0, s, s});
  gltf.json["animations"].push_back(
      {{"samplers", {sampler}}, {"channels", {{{"sampler", 0}, {"target", {{"node", 3}, {"path", "rotation"}}}}}}});
  return gltf;
}

/// The square with two morph targets: its right edge goes right by 2 m, everything comes forward by 3 m.
Gltf morphing_square() {
  Gltf gltf = square_gltf();
  gltf.json.erase("animations");
  gltf.json["nodes"] = {{{"mesh", 0}}};
  Json right;
  right["POSITION"] = gltf.add_floats("VEC3", {0, 0, 0, 2, 0, 0, 2, 0, 0, 0, 0, 0});
  right["NORMAL"] = gltf.add_floats("VEC3", {1, 0, -1, 0, 0, 0, 0, 0, 0, 0, 0, 0});
  Json forward;
  forward["POSITION"] = gltf.add_floats("VEC3", {0, 0, 3, 0, 0, 3, 0, 0, 3, 0, 0, 3});
  primitive_of(gltf)["targets"] = {right, forward};
  Json sampler;
  sampler["input"] = gltf.add_floats("SCALAR", {0, 2});
  sampler["output"] = gltf.add_floats("SCALAR", {0, 1, 1, 0.5});
  gltf.json["animations"].push_back(
      {{"samplers", {sampler}}, {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "weights"}}}}}}});
  return gltf;
}

/// The corners of the first thing drawn, in the world, at a moment.
std::vector<glm::dvec3> corners_at(const MeshFile& file, double time_s) {
  Project project;
  Object object;
  object.name = "square";
  object.mesh.shape = FileMesh{"a.glb"};
  project.objects = {object};
  const Result<Stage> stood = stage(project, {{{"a.glb", std::make_shared<Model>(file.model)}}}, time_s);
  REQUIRE(stood.ok());
  const Drawable& drawable = stood->objects[0].drawables.at(0);
  std::vector<glm::dvec3> corners;
  for (const glm::dvec3& p : drawable.mesh->positions_m) {
    corners.emplace_back(drawable.world_from_mesh * glm::dvec4(p, 1.0));
  }
  return corners;
}

void check_near(const std::vector<glm::dvec3>& corners, const std::vector<glm::dvec3>& expected) {
  REQUIRE(corners.size() == expected.size());
  for (std::size_t i = 0; i < corners.size(); ++i) {
    CAPTURE(i);
    CHECK(glm::length(corners[i] - expected[i]) < 1e-7);  // as floats in the file
  }
}

}  // namespace

TEST_CASE("a skin carries its vertices with its joints, from where they were bound") {
  const MeshFile file = must_read(read("a.glb", skinned_square().glb()));
  CHECK(file.findings.empty());
  check_near(corners_at(file, 0.0), {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
  // About (0,1,0) the upper edge's right end turns upwards.
  check_near(corners_at(file, 2.0), {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0, 1, 0}});
  const double s = std::sqrt(0.5);
  check_near(corners_at(file, 1.5), {{0, 0, 0}, {1, 0, 0}, {s, 1 + s, 0}, {0, 1, 0}});
}

TEST_CASE("without inverse bind matrices a mesh is bound in its joints' own space") {
  Gltf gltf = skinned_square();
  gltf.json["skins"][0].erase("inverseBindMatrices");
  const MeshFile file = must_read(read("a.glb", gltf.glb()));
  check_near(corners_at(file, 0.0), {{0, 0, 0}, {1, 0, 0}, {1, 2, 0}, {0, 2, 0}});
}

TEST_CASE("shares of several sets add up; those that do not make one are scaled, and that is said") {
  Gltf gltf = skinned_square();
  Json& attributes = primitive_of(gltf)["attributes"];
  // The upper right corner: half on joint 0 in the first set, half on joint 1 in the second.
  attributes["WEIGHTS_0"] = add_vec4<std::uint8_t>(gltf, 5121, true,
                                                   {255, 0, 0, 0, 255, 0, 0, 0,  //
                                                    0, 128, 0, 0, 255, 0, 0, 0});
  attributes["JOINTS_1"] = add_vec4<std::uint16_t>(gltf, 5123, false, {0, 0, 0, 0, 0, 0, 0, 0, 1, 9, 9, 9, 0, 0, 0, 0});
  attributes["WEIGHTS_1"] = add_vec4<std::uint16_t>(gltf, 5123, true,
                                                    {0, 0, 0, 0, 0, 0, 0, 0,  //
                                                     32896, 0, 0, 0, 0, 0, 0, 0});
  MeshFile file = must_read(read("a.glb", gltf.glb()));
  CHECK(file.findings.empty());
  check_near(corners_at(file, 2.0), {{0, 0, 0}, {1, 0, 0}, {0.5, 1.5, 0}, {0, 1, 0}});
  attributes["WEIGHTS_1"] = add_vec4<std::uint16_t>(gltf, 5123, true, {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0});
  file = must_read(read("a.glb", gltf.glb()));
  CHECK(has_code(file, "asset.weights"));
  check_near(corners_at(file, 2.0), {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
}

TEST_CASE("morph targets move by the node's weights, the mesh's, or the animation's") {
  Gltf gltf = morphing_square();
  MeshFile file = must_read(read("a.glb", gltf.glb()));
  CHECK(file.findings.empty());
  check_near(corners_at(file, 0.0), {{0, 0, 3}, {1, 0, 3}, {1, 1, 3}, {0, 1, 3}});
  check_near(corners_at(file, 1.0), {{0, 0, 2.25}, {2, 0, 2.25}, {2, 1, 2.25}, {0, 1, 2.25}});
  gltf.json.erase("animations");
  check_near(corners_at(must_read(read("a.glb", gltf.glb())), 1.0), {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
  gltf.json["meshes"][0]["weights"] = {0.5, 0};
  check_near(corners_at(must_read(read("a.glb", gltf.glb())), 1.0), {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}});
  gltf.json["nodes"][0]["weights"] = {0, 1};
  check_near(corners_at(must_read(read("a.glb", gltf.glb())), 1.0), {{0, 0, 3}, {1, 0, 3}, {1, 1, 3}, {0, 1, 3}});
}

TEST_CASE("a morph target's normals turn with it; a sparse target names the vertices it moves") {
  Gltf gltf = morphing_square();
  gltf.json.erase("animations");
  gltf.json["meshes"][0]["weights"] = {1, 0};
  Bytes place;
  put(place, std::uint16_t{2});
  Bytes offset;
  for (const float value : {0.0f, 5.0f, 0.0f}) put(offset, value);
  Json accessor = {{"componentType", 5126}, {"count", 4}, {"type", "VEC3"}};
  accessor["sparse"]["count"] = 1;
  accessor["sparse"]["indices"] = {{"bufferView", gltf.add_view(place)}, {"componentType", 5123}};
  accessor["sparse"]["values"] = {{"bufferView", gltf.add_view(offset)}};
  gltf.json["accessors"].push_back(accessor);
  primitive_of(gltf)["targets"][0]["POSITION"] = gltf.json["accessors"].size() - 1;
  const MeshFile file = must_read(read("a.glb", gltf.glb()));
  const Deformation& deformation = *file.model.nodes[0].parts[0].deformation;
  CHECK(deformation.targets[0].vertices == std::vector<std::uint32_t>{0, 2});
  check_near(corners_at(file, 0.0), {{0, 0, 0}, {1, 0, 0}, {1, 6, 0}, {0, 1, 0}});
  const std::vector<double> weights{1, 0};
  CHECK(deformed(*file.model.nodes[0].parts[0].mesh, deformation, weights, {}).normals[0] == glm::dvec3(1, 0, 0));
  primitive_of(gltf)["targets"][1]["COLOR_0"] = gltf.add_floats("VEC3", std::vector<float>(12, 0.0f));
  CHECK(has_code(must_read(read("a.glb", gltf.glb())), "asset.morph-left-out"));
}

TEST_CASE("skins and morph targets are held to their joints, matrices, weights and counts") {
  const std::pair<const char*, Json> skin_spoils[] = {
      {"/skins/0/joints", Json::array()},
      {"/skins/0/joints", {2, 2}},
      {"/skins/0/joints", {2, 9}},
      {"/skins/0/joints", {2}},     // vertices name the second
      {"/skins/0/joints", {2, 0}},  // no common root
      {"/skins/0/joints", "all"},
      {"/skins/0/skeleton", 9},
      {"/skins/0/inverseBindMatrices", 0},
      {"/skins/0/inverseBindMatrices", 99},
      {"/nodes/1/skin", 1},
      {"/nodes/0/skin", 0},  // it has no mesh
      {"/meshes/0/primitives/0/attributes/JOINTS_0", 0},
      {"/meshes/0/primitives/0/attributes/JOINTS_1", 7},
      {"/meshes/0/primitives/0/attributes/WEIGHTS_0", 2},
  };
  for (const auto& [pointer, value] : skin_spoils) {
    Gltf gltf = skinned_square();
    gltf.json[Json::json_pointer(pointer)] = value;
    CAPTURE(pointer);
    CHECK(refusal(read("a.glb", gltf.glb())) == "asset.invalid");
  }
  for (const std::vector<float>& weights :
       {std::vector<float>{1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0},   // the last hangs on nothing
        std::vector<float>{1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 2, -1, 0, 0},  // less than nothing
        std::vector<float>{1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, std::nanf(""), 0, 0, 0}}) {
    Gltf gltf = skinned_square();
    primitive_of(gltf)["attributes"]["WEIGHTS_0"] = gltf.add_floats("VEC4", weights);
    CHECK(refusal(read("a.glb", gltf.glb())) == "asset.invalid");
  }
  const std::pair<const char*, Json> morph_spoils[] = {
      {"/meshes/0/weights", {1}},
      {"/nodes/0/weights", {1, 2, 3}},
      {"/meshes/0/primitives/0/targets/0/POSITION", 99},
      {"/meshes/0/primitives/0/targets/0/POSITION", 2},
      {"/meshes/0/primitives/0/targets/0/NORMAL", 3},
      {"/meshes/0/primitives/0/targets/0", 3},
      {"/animations/0/samplers/0/output", 0},
      {"/animations/0/channels/0/target/path", "rotation"},
  };
  for (const auto& [pointer, value] : morph_spoils) {
    Gltf gltf = morphing_square();
    gltf.json[Json::json_pointer(pointer)] = value;
    CAPTURE(pointer);
    CHECK(refusal(read("a.glb", gltf.glb())) == "asset.invalid");
  }
  Gltf uneven = morphing_square();
  uneven.json["meshes"][0]["primitives"].push_back(primitive_of(uneven));
  uneven.json["meshes"][0]["primitives"][1].erase("targets");
  CHECK(refusal(read("a.glb", uneven.glb())) == "asset.invalid");
  Gltf short_of = morphing_square();
  short_of.json["animations"][0]["samplers"][0]["output"] = short_of.add_floats("SCALAR", {0, 1, 1});
  CHECK(refusal(read("a.glb", short_of.glb())) == "asset.invalid");
}

TEST_CASE("small files cannot ask for many weights") {
  Gltf gltf = morphing_square();
  Json& targets = primitive_of(gltf)["targets"];
  while (targets.size() < 5000) targets.push_back(Json::object());
  gltf.json.erase("animations");
  gltf.json.erase("scenes");
  gltf.json.erase("scene");
  while (gltf.json["nodes"].size() < 5000) gltf.json["nodes"].push_back({{"mesh", 0}});
  CHECK(refusal(read("a.glb", gltf.glb())) == "asset.too-large");
}
