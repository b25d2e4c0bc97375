#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "core/stage/animation.h"
#include "tests/io/assets/gltf_writer.h"

using namespace focalstage;
using namespace focalstage::test;

namespace {

bool has_code(const MeshFile& file, const std::string& code) {
  return std::any_of(file.findings.begin(), file.findings.end(), [&](const Finding& f) { return f.code == code; });
}

const Mesh& leaf_mesh(const MeshFile& file) { return *file.model.nodes.at(1).parts.at(0).mesh; }

std::string base64(const Bytes& bytes) {
  static const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      group = group << 8 | (i + k < bytes.size() ? std::to_integer<std::uint32_t>(bytes[i + k]) : 0);
    }
    for (std::size_t k = 0; k < 4; ++k) text += i + k <= bytes.size() ? digits[group >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

Json& primitive_of(Gltf& gltf) { return gltf.json["meshes"][0]["primitives"][0]; }

}  // namespace

TEST_CASE("a GLB's nodes, mesh, material, texture and animation are read") {
  const MeshFile file = must_read(read("square.glb", square_gltf().glb()));
  CHECK(file.vertices == 4);
  CHECK(file.triangles == 2);
  CHECK(file.findings.empty());
  REQUIRE(file.model.nodes.size() == 2);
  CHECK(file.model.nodes[0].name == "root");
  CHECK(file.model.nodes[0].pose.translation == glm::dvec3(1, 2, 3));
  CHECK(file.model.nodes[1].parent == 0);
  CHECK(file.model.nodes[1].pose.scale == glm::dvec3(2));
  const Mesh& mesh = leaf_mesh(file);
  CHECK(mesh.positions_m[2] == glm::dvec3(1, 1, 0));
  CHECK(mesh.normals[0] == glm::dvec3(0, 0, 1));
  CHECK(mesh.uvs[0] == glm::dvec2(0, 0));  // glTF's (0, 1) is the picture's lower left corner
  CHECK(mesh.uvs[2] == glm::dvec2(1, 1));
  CHECK(mesh.triangles == std::vector<glm::uvec3>{{0, 1, 2}, {0, 2, 3}});
  const Material& material = file.model.materials.at(0);
  CHECK(material.base_color == glm::dvec3(1, 0.5, 0.25));
  CHECK_FALSE(material.unlit);
  CHECK(material.texture->width_px == 2);
  CHECK(material.texture->rgba[8] == 255);  // red, in the lower row
  CHECK(material.texture->wrap_u == Wrap::clamp);
  CHECK(material.texture->wrap_v == Wrap::mirror);
  REQUIRE(file.model.animations.size() == 1);
  CHECK(poses_at(file.model, 1.25)[1].translation == glm::dvec3(1, 2, 0));
  CHECK(poses_at(file.model, 1.25)[1].scale == glm::dvec3(2));
}

TEST_CASE("a .gltf takes its buffers and images from beside it or from within") {
  Gltf gltf = square_gltf();
  const MeshFile from_glb = must_read(read("a.glb", gltf.glb()));
  gltf.json["buffers"][0]["uri"] = "my%20data/a+b.bin";
  const std::map<std::string, Bytes> beside{{"my data/a+b.bin", gltf.buffer}};
  const MeshFile from_file = must_read(read("a.gltf", gltf.json.dump(), beside));
  CHECK(leaf_mesh(from_file) == leaf_mesh(from_glb));
  CHECK(*from_file.model.materials[0].texture == *from_glb.model.materials[0].texture);

  gltf.json["buffers"][0]["uri"] = "data:application/octet-stream;base64," + base64(gltf.buffer);
  gltf.json["images"][0] = {{"uri", "pixel.png"}};
  const std::vector<std::uint8_t> pixel{9, 8, 7};
  const MeshFile from_data = must_read(read("a.gltf", gltf.json.dump(), {{"pixel.png", *encode_png(1, 1, 3, pixel)}}));
  CHECK(leaf_mesh(from_data) == leaf_mesh(from_glb));
  CHECK(from_data.model.materials[0].texture->rgba == std::vector<std::uint8_t>{9, 8, 7, 255});

  CHECK(refusal(read("a.gltf", gltf.json.dump())) == "asset.missing");
  for (const char* uri : {"https://example.org/a.bin", "file:///etc/passwd", "ftp:a"}) {
    gltf.json["buffers"][0]["uri"] = uri;
    CHECK(refusal(read("a.gltf", gltf.json.dump())) == "asset.unsupported");
  }
  gltf.json["buffers"][0]["uri"] = "%zz.bin";
  CHECK(refusal(read("a.gltf", gltf.json.dump())) == "asset.invalid");
  gltf.json["buffers"][0]["uri"] = "short.bin";
  CHECK(refusal(read("a.gltf", gltf.json.dump(), {{"short.bin", Bytes(8)}})) == "asset.invalid");
}

TEST_CASE("strips and fans wind as their triangles do") {
  Gltf gltf = square_gltf();
  primitive_of(gltf)["mode"] = 5;
  primitive_of(gltf)["indices"] = gltf.add_indices({0, 1, 3, 2});
  const MeshFile strip = must_read(read("a.glb", gltf.glb()));
  CHECK(leaf_mesh(strip).triangles == std::vector<glm::uvec3>{{0, 1, 3}, {1, 2, 3}});
  primitive_of(gltf)["mode"] = 6;
  primitive_of(gltf)["indices"] = gltf.add_indices({0, 1, 2, 3});
  const MeshFile fan = must_read(read("a.glb", gltf.glb()));
  CHECK(leaf_mesh(fan).triangles == std::vector<glm::uvec3>{{1, 2, 0}, {2, 3, 0}});
  primitive_of(gltf).erase("indices");
  CHECK(leaf_mesh(must_read(read("a.glb", gltf.glb()))).triangles.size() == 2);
}

TEST_CASE("points and lines have no area: they are left out, and that is said") {
  for (int mode = 0; mode < 4; ++mode) {
    Gltf gltf = square_gltf();
    Json lines = primitive_of(gltf);
    lines["mode"] = mode;
    gltf.json["meshes"][0]["primitives"].push_back(lines);
    const MeshFile file = must_read(read("a.glb", gltf.glb()));
    CHECK(file.triangles == 2);
    CHECK(file.model.nodes[1].parts.size() == 1);
    CHECK(has_code(file, "asset.no-area"));
  }
  Gltf odd = square_gltf();
  primitive_of(odd)["mode"] = 1;
  primitive_of(odd)["indices"] = odd.add_indices({0, 1, 2});
  CHECK(refusal(read("a.glb", odd.glb())) == "asset.invalid");
}

TEST_CASE("interleaved vertices, byte indices and normalized UVs are read by their strides") {
  Gltf gltf = square_gltf();
  Bytes data;
  for (const glm::vec2& p : {glm::vec2(0, 0), glm::vec2(1, 0), glm::vec2(1, 1)}) {
    put(data, p.x);
    put(data, p.y);
    put(data, 0.5f);
    put(data, static_cast<std::uint16_t>(p.x * 65535));
    put(data, static_cast<std::uint16_t>(p.y * 65535));
  }
  const std::size_t view = gltf.add_view(data);
  gltf.json["bufferViews"][view]["byteStride"] = 16;
  const std::size_t first = gltf.json["accessors"].size();
  gltf.json["accessors"].push_back({{"bufferView", view}, {"componentType", 5126}, {"count", 3}, {"type", "VEC3"}});
  gltf.json["accessors"].push_back({{"bufferView", view},
                                    {"byteOffset", 12},
                                    {"componentType", 5123},
                                    {"normalized", true},
                                    {"count", 3},
                                    {"type", "VEC2"}});
  const std::size_t index_view = gltf.add_view({std::byte{2}, std::byte{0}, std::byte{1}});
  gltf.json["accessors"].push_back(
      {{"bufferView", index_view}, {"componentType", 5121}, {"count", 3}, {"type", "SCALAR"}});
  primitive_of(gltf)["attributes"] = {{"POSITION", first}, {"TEXCOORD_0", first + 1}};
  primitive_of(gltf)["indices"] = first + 2;
  const MeshFile file = must_read(read("a.glb", gltf.glb()));
  CHECK(leaf_mesh(file).positions_m[1] == glm::dvec3(1, 0, 0.5));
  CHECK(leaf_mesh(file).uvs[1] == glm::dvec2(1, 1));
  CHECK(leaf_mesh(file).triangles == std::vector<glm::uvec3>{{2, 0, 1}});
  CHECK(leaf_mesh(file).normals.empty());
}

TEST_CASE("a matrix is kept as written, mirrored and sheared ones included") {
  Gltf gltf = square_gltf();
  // Scale (-2, 3, 4), then 90 degrees about Z, then a move: columns.
  gltf.json["nodes"][0] = {{"children", {1}}, {"matrix", {0, -2, 0, 0, -3, 0, 0, 0, 0, 0, 4, 0, 5, 6, 7, 1}}};
  const MeshFile file = must_read(read("a.glb", gltf.glb()));
  const glm::dmat4 matrix = model_from_nodes(file.model, poses_at(file.model, 0))[0];
  CHECK(glm::length(glm::dvec3(matrix * glm::dvec4(1, 10, 100, 1)) - glm::dvec3(5 - 30, 6 - 2, 7 + 400)) < 1e-12);
  CHECK_FALSE(has_code(file, "asset.sheared"));
  gltf.json["nodes"][0]["matrix"] = {1, 0, 0, 0, 0.5, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  const MeshFile sheared = must_read(read("a.glb", gltf.glb()));
  const glm::dmat4 slanted = model_from_nodes(sheared.model, poses_at(sheared.model, 0))[0];
  CHECK(glm::length(glm::dvec3(slanted * glm::dvec4(1, 2, 3, 1)) - glm::dvec3(1 + 0.5 * 2, 2, 3)) < 1e-15);
  CHECK(has_code(sheared, "asset.sheared"));
  gltf.json["nodes"][0]["matrix"] = {1, 0, 0, 0.5, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  CHECK(refusal(read("a.glb", gltf.glb())) == "asset.invalid");
  gltf.json["nodes"][0]["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0};
  CHECK(refusal(read("a.glb", gltf.glb())) == "asset.invalid");
  gltf.json["nodes"][0]["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  gltf.json["nodes"][0]["scale"] = {1, 1, 1};
  CHECK(refusal(read("a.glb", gltf.glb())) == "asset.invalid");
}

TEST_CASE("parents stand before children whatever the file's order; what is outside the scene is not drawn") {
  Gltf gltf = square_gltf();
  gltf.json["nodes"] = {{{"mesh", 0}}, {{"children", {0}}, {"scale", {3, 3, 3}}}, {{"mesh", 0}}};
  gltf.json["scenes"] = {{{"nodes", {2}}}, {{"nodes", {1}}}};
  gltf.json["scene"] = 1;
  const MeshFile file = must_read(read("a.glb", gltf.glb()));
  REQUIRE(file.model.nodes.size() == 3);
  std::size_t drawn = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(file.model.nodes[i].parent < static_cast<int>(i));
    drawn += file.model.nodes[i].parts.size();
    if (!file.model.nodes[i].parts.empty()) CHECK(file.model.nodes[i].parent >= 0);
  }
  CHECK(drawn == 1);
  CHECK(has_code(file, "asset.scenes"));
  // The animation drives the file's node 1, which is the parent here.
  CHECK(poses_at(file.model, 2.0)[static_cast<std::size_t>(file.model.animations[0].channels[0].node)].scale ==
        glm::dvec3(3));
}

TEST_CASE("materials: unlit, a second UV set, blending and no material") {
  Gltf gltf = square_gltf();
  gltf.json["extensionsUsed"] = {"KHR_materials_unlit"};
  gltf.json["materials"][0]["extensions"]["KHR_materials_unlit"] = Json::object();
  gltf.json["materials"][0]["alphaMode"] = "BLEND";
  gltf.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["texCoord"] = 1;
  primitive_of(gltf)["attributes"]["TEXCOORD_1"] = gltf.add_floats("VEC2", {5, 5, 6, 6, 7, 7, 8, 8});
  const MeshFile file = must_read(read("a.glb", gltf.glb()));
  CHECK(file.model.materials[0].unlit);
  CHECK(leaf_mesh(file).uvs[0] == glm::dvec2(5, -4));
  primitive_of(gltf)["attributes"].erase("TEXCOORD_1");
  CHECK(refusal(read("a.glb", gltf.glb())) == "asset.invalid");
  primitive_of(gltf).erase("material");
  CHECK(must_read(read("a.glb", gltf.glb())).model.nodes[1].parts[0].material == -1);
}

TEST_CASE("rotations and cubics are animated") {
  Gltf gltf = square_gltf();
  const double s = std::sqrt(0.5);
  Json& animation = gltf.json["animations"][0];
  animation["samplers"][0]["input"] = gltf.add_floats("SCALAR", {1, 2});
  animation["samplers"][0]["output"] =
      gltf.add_floats("VEC4", {0, 0, 0, 1, 0, 0, static_cast<float>(s), static_cast<float>(s)});
  animation["channels"][0]["target"]["path"] = "rotation";
  MeshFile file = must_read(read("a.glb", gltf.glb()));
  CHECK(file.model.animations[0].channels.size() == 1);
  CHECK(poses_at(file.model, 1.5)[1].rotation.z == doctest::Approx(std::sin(0.39269908169872414)));
  animation["samplers"][0]["interpolation"] = "CUBICSPLINE";
  animation["samplers"][0]["output"] = gltf.add_floats("VEC3", {0, 0, 0, 1, 2, 3, 0, 0, 0, 0, 0, 0, 5, 6, 7, 0, 0, 0});
  animation["channels"][0]["target"]["path"] = "scale";
  file = must_read(read("a.glb", gltf.glb()));
  CHECK(poses_at(file.model, 1.0)[1].scale == glm::dvec3(1, 2, 3));
  CHECK(poses_at(file.model, 1.5)[1].scale == glm::dvec3(3, 4, 5));
}

TEST_CASE("what is valid glTF but not read here is named") {
  const std::pair<std::string, std::string> cases[] = {
      {R"({"extensionsUsed":["EXT_meshopt_compression"]})", "EXT_meshopt"},
      {R"({"extensionsRequired":["EXT_texture_webp"]})", "EXT_texture_webp"},
      {R"({"asset":{"version":"1.0"}})", "glTF 2.0"},
      {R"({"asset":{"minVersion":"2.1"}})", "glTF 2.0"},
  };
  for (const auto& [patch, word] : cases) {
    Gltf gltf = square_gltf();
    gltf.json.merge_patch(Json::parse(patch));
    CAPTURE(patch);
    const Result<MeshFile> file = read("a.glb", gltf.glb());
    REQUIRE(refusal(file) == "asset.unsupported");
    CHECK(file.fault().message.find(word) != std::string::npos);
  }
  Gltf pointing = square_gltf();
  pointing.json["animations"][0]["channels"][0]["target"] = {{"path", "pointer"}};
  CHECK(refusal(read("a.glb", pointing.glb())) == "asset.unsupported");
  pointing.json["animations"][0]["channels"][0]["target"] = {{"node", 0}, {"path", "visible"}};
  CHECK(refusal(read("a.glb", pointing.glb())) == "asset.unsupported");
  pointing.json["animations"][0]["channels"][0]["target"] = {{"node", 0}, {"path", "weights"}};
  CHECK(refusal(read("a.glb", pointing.glb())) == "asset.invalid");  // there is nothing that they weigh
}

TEST_CASE("every reference, count, offset and type is checked before it is used") {
  // A JSON pointer and what to put there.
  const std::pair<const char*, Json> spoils[] = {
      {"/asset", nullptr},
      {"/asset/version", 2},
      {"/scene", 1},
      {"/scene", -1},
      {"/scene", "first"},
      {"/scenes/0/nodes", {7}},
      {"/scenes/0/nodes", {1}},
      {"/scenes/0/nodes", {0.5}},
      {"/nodes/0/children", {0}},
      {"/nodes/0/children", {1, 1}},
      {"/nodes/0/children", {9}},
      {"/nodes/1/children", {0}},
      {"/nodes/1/mesh", 1},
      {"/nodes/1/mesh", -2},
      {"/nodes/1/mesh", 4294967296},
      {"/nodes/1/scale", {1, 1}},
      {"/nodes/1/rotation", {0, 0, 0, 0}},
      {"/nodes/1/rotation", {0, 0, 3, 4}},
      {"/nodes", {{"0", 1}}},
      {"/meshes/0/primitives", Json::array()},
      {"/meshes/0/primitives/0/attributes", Json::object()},
      {"/meshes/0/primitives/0/attributes/POSITION", 99},
      {"/meshes/0/primitives/0/attributes/POSITION", 2},
      {"/meshes/0/primitives/0/attributes/POSITION", "zero"},
      {"/meshes/0/primitives/0/attributes/NORMAL", 2},
      {"/meshes/0/primitives/0/attributes/TEXCOORD_0", 0},
      {"/meshes/0/primitives/0/attributes/COLOR_0", 3},
      {"/meshes/0/primitives/0/indices", 0},
      {"/meshes/0/primitives/0/indices", 99},
      {"/meshes/0/primitives/0/material", 1},
      {"/meshes/0/primitives/0/mode", 7},
      {"/meshes/0/weights", {0.5}},
      {"/nodes/1/weights", {0.5}},
      {"/nodes/1/camera", 0},
      {"/nodes/1/skin", 0},
      {"/accessors/0/count", 5},
      {"/accessors/0/count", 0},
      {"/accessors/0/count", 2147483647},
      {"/accessors/0/count", 1e99},
      {"/accessors/0/byteOffset", 4},
      {"/accessors/0/byteOffset", 2},
      {"/accessors/0/componentType", 5124},
      {"/accessors/0/componentType", 5130},
      {"/accessors/0/componentType", 5123},
      {"/accessors/0/type", "VEC5"},
      {"/accessors/0/normalized", true},
      {"/accessors/0/bufferView", 99},
      {"/accessors/3/count", 4},
      {"/accessors/3/componentType", 5122},
      {"/bufferViews/0/buffer", 1},
      {"/bufferViews/0/byteOffset", 1},
      {"/bufferViews/0/byteOffset", 2147483647},
      {"/bufferViews/0/byteLength", 2147483647},
      {"/bufferViews/0/byteLength", 0},
      {"/bufferViews/0/byteStride", 8},
      {"/bufferViews/0/byteStride", 16},
      {"/bufferViews/0/byteStride", 13},
      {"/bufferViews/3/byteStride", 4},
      {"/buffers/0/byteLength", 2147483647},
      {"/buffers/0/byteLength", 0},
      {"/buffers/0/byteLength", 8},
      {"/buffers/0/byteLength", "many"},
      {"/materials/0/pbrMetallicRoughness/baseColorFactor", {1, 1, 1}},
      {"/materials/0/pbrMetallicRoughness/baseColorFactor", {2, 1, 1, 1}},
      {"/materials/0/pbrMetallicRoughness/baseColorFactor", {-1, 1, 1, 1}},
      {"/materials/0/pbrMetallicRoughness/baseColorTexture/index", 1},
      {"/materials/0/alphaMode", "GHOST"},
      {"/textures/0/source", 1},
      {"/textures/0/sampler", 1},
      {"/samplers/0/wrapS", 1},
      {"/samplers/0/magFilter", 9984},
      {"/samplers/0/minFilter", 1},
      {"/materials/0/alphaCutoff", -1},
      {"/images/0/bufferView", 99},
      {"/images/0/uri", "both.png"},
      {"/animations/0/channels/0/sampler", 1},
      {"/animations/0/channels/0/target/node", 2},
      {"/animations/0/samplers/0/input", 99},
      {"/animations/0/samplers/0/input", 0},
      {"/animations/0/samplers/0/output", 0},
      {"/animations/0/samplers/0/output", 2},
      {"/animations/0/samplers/0/interpolation", "WOBBLE"},
  };
  for (const auto& [pointer, value] : spoils) {
    Gltf gltf = square_gltf();
    gltf.json[Json::json_pointer(pointer)] = value;
    const std::string spoil = std::string(pointer) + " = " + value.dump();
    CAPTURE(spoil);
    const Result<MeshFile> file = read("a.glb", gltf.glb());
    CHECK(refusal(file) == "asset.invalid");
    if (!file) CHECK(file.fault().where.starts_with("a.glb"));
  }
  for (const char* pointer :
       {"/animations/0/channels/0/target/path", "/bufferViews/0/byteLength", "/accessors/0/type"}) {
    Gltf gltf = square_gltf();
    const Json::json_pointer at(pointer);
    gltf.json[at.parent_pointer()].erase(at.back());
    CHECK(refusal(read("a.glb", gltf.glb())) == "asset.invalid");
  }
}

TEST_CASE("values inside the buffers are checked, too") {
  const float nan = std::nanf("");
  Gltf gltf = square_gltf();
  primitive_of(gltf)["attributes"]["POSITION"] = gltf.add_floats("VEC3", {0, 0, 0, 1, 0, 0, 1, nan, 0, 0, 1, 0});
  CHECK(refusal(read("a.glb", gltf.glb())) == "asset.invalid");
  gltf = square_gltf();
  primitive_of(gltf)["indices"] = gltf.add_indices({0, 1, 4});
  CHECK(refusal(read("a.glb", gltf.glb())) == "asset.invalid");
  primitive_of(gltf)["indices"] = gltf.add_indices({0, 1, 2, 3});
  CHECK(refusal(read("a.glb", gltf.glb())) == "asset.invalid");
  gltf = square_gltf();
  primitive_of(gltf)["attributes"]["NORMAL"] = gltf.add_floats("VEC3", {0, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0, 1});
  const MeshFile flat = must_read(read("a.glb", gltf.glb()));
  CHECK(leaf_mesh(flat).normals.empty());
  CHECK(has_code(flat, "asset.normals"));
  gltf = square_gltf();
  gltf.json["animations"][0]["samplers"][0]["input"] = gltf.add_floats("SCALAR", {0, 2, 1});
  CHECK(refusal(read("a.glb", gltf.glb())) == "asset.invalid");
  gltf.json["animations"][0]["samplers"][0]["input"] = gltf.add_floats("SCALAR", {-1, 1, 2});
  CHECK(refusal(read("a.glb", gltf.glb())) == "asset.invalid");
  gltf.json["animations"][0]["samplers"][0]["input"] = gltf.add_floats("SCALAR", {0, 1});
  CHECK(refusal(read("a.glb", gltf.glb())) == "asset.invalid");
}

TEST_CASE("primitives of the same data are one mesh, and a scene with nothing in it says so") {
  Gltf gltf = square_gltf();
  gltf.json["meshes"][0]["primitives"].push_back(primitive_of(gltf));
  const MeshFile file = must_read(read("a.glb", gltf.glb()));
  REQUIRE(file.model.nodes[1].parts.size() == 2);
  CHECK(file.model.nodes[1].parts[0].mesh == file.model.nodes[1].parts[1].mesh);
  CHECK(file.vertices == 4);
  gltf.json["nodes"][1].erase("mesh");
  CHECK(has_code(must_read(read("a.glb", gltf.glb())), "asset.empty"));
}
