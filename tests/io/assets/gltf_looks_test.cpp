#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "core/scene/edit.h"
#include "core/scene/project.h"
#include "io/files/files.h"
#include "tests/io/assets/gltf_writer.h"

using namespace focalstage;
using namespace focalstage::test;

namespace {

const Finding* finding_of(const MeshFile& file, const std::string& code) {
  const auto found =
      std::find_if(file.findings.begin(), file.findings.end(), [&](const Finding& f) { return f.code == code; });
  return found == file.findings.end() ? nullptr : &*found;
}

Json& primitive_of(Gltf& gltf) { return gltf.json["meshes"][0]["primitives"][0]; }
Json& material_of(Gltf& gltf) { return gltf.json["materials"][0]; }
Json& texture_of(Gltf& gltf) { return material_of(gltf)["pbrMetallicRoughness"]["baseColorTexture"]; }
const Mesh& mesh_of(const MeshFile& file) { return *file.model.nodes.at(1).parts.at(0).mesh; }

MeshFile read_whole(const Gltf& gltf) { return must_read(read("a.glb", gltf.glb())); }

Bytes from_hex(const std::string& hex) {
  Bytes bytes;
  for (std::size_t i = 0; i + 1 < hex.size(); i += 2) {
    bytes.push_back(static_cast<std::byte>(std::stoi(hex.substr(i, 2), nullptr, 16)));
  }
  return bytes;
}

// Two pixels side by side of gray 9, of alpha 0 and 255, and of alpha 60 and 120: written with Python's zlib.
const char* const clear_and_full =
    "89504e470d0a1a0a0000000d4948445200000002000000010806000000f4227f8a0000000f4944415478da63e0e4e46400e2ff0002160136"
    "c64a6afa0000000049454e44ae426082";
const char* const thin =
    "89504e470d0a1a0a0000000d4948445200000002000000010806000000f4227f8a0000000f4944415478da63e0e4e4b401e20a0002bb00eb"
    "6b61f2ec0000000049454e44ae426082";

}  // namespace

TEST_CASE("vertex colours are linear, of three or four numbers, floats or fractions, between 0 and 1") {
  Gltf gltf = square_gltf();
  Json& attributes = primitive_of(gltf)["attributes"];
  attributes["COLOR_0"] = gltf.add_floats("VEC3", {1, 0, 0, 0, 0.5, 0, 0, 0, 0.25, 1.5, -1, 1});
  CHECK(mesh_of(read_whole(gltf)).colors == std::vector<glm::dvec3>{{1, 0, 0}, {0, 0.5, 0}, {0, 0, 0.25}, {1, 0, 1}});
  CHECK(read_whole(gltf).findings.empty());
  for (const int component_type : {5121, 5123}) {
    Bytes data;
    for (int i = 0; i < 16; ++i) {
      if (component_type == 5121) put(data, static_cast<std::uint8_t>(17 * i));
      if (component_type == 5123) put(data, static_cast<std::uint16_t>(4369 * i));
    }
    gltf.json["accessors"].push_back({{"bufferView", gltf.add_view(data)},
                                      {"componentType", component_type},
                                      {"normalized", true},
                                      {"count", 4},
                                      {"type", "VEC4"}});
    attributes["COLOR_0"] = gltf.json["accessors"].size() - 1;
    const std::vector<glm::dvec3> colors = mesh_of(read_whole(gltf)).colors;
    for (std::size_t i = 0; i < 4; ++i) {
      const auto k = static_cast<double>(4 * i);
      CHECK(glm::length(colors[i] - glm::dvec3(k, k + 1, k + 2) / 15.0) < 1e-15);
    }
  }
  // With a material that uses alpha, that of the vertices is left out.
  CHECK(finding_of(read_whole(gltf), "asset.drawn-opaque") == nullptr);
  material_of(gltf)["alphaMode"] = "BLEND";
  CHECK(finding_of(read_whole(gltf), "asset.drawn-opaque") != nullptr);
}

TEST_CASE("a moved, turned and scaled texture lies where KHR_texture_transform puts it") {
  Gltf gltf = square_gltf();
  gltf.json["extensionsUsed"] = gltf.json["extensionsRequired"] = {"KHR_texture_transform"};
  primitive_of(gltf)["attributes"]["TEXCOORD_1"] = gltf.add_floats("VEC2", {0, 0, 1, 0, 0, 1, 1, 1});
  Json& transform = texture_of(gltf)["extensions"]["KHR_texture_transform"];
  transform = {{"offset", {0.25, 0.5}}, {"scale", {2, 4}}, {"texCoord", 1}};
  // In glTF's UV (0,0) (1,0) (0,1) (1,1) become (0.25,0.5) (2.25,0.5) (0.25,4.5) (2.25,4.5); ours runs up.
  CHECK(mesh_of(read_whole(gltf)).uvs == std::vector<glm::dvec2>{{0.25, 0.5}, {2.25, 0.5}, {0.25, -3.5}, {2.25, -3.5}});
  transform = {{"rotation", std::numbers::pi / 2}, {"texCoord", 1}};
  // Counter-clockwise to the eye, V running down: glTF's (1,0) goes to (0,-1), (0,1) to (1,0).
  const std::vector<glm::dvec2> turned = mesh_of(read_whole(gltf)).uvs;
  const std::vector<glm::dvec2> expected{{0, 1}, {0, 2}, {1, 1}, {1, 2}};
  for (std::size_t i = 0; i < 4; ++i) CHECK(glm::length(turned[i] - expected[i]) < 1e-15);
  // The same vertices under another transform are another mesh.
  gltf.json["materials"].push_back(material_of(gltf));
  gltf.json["materials"][1]["pbrMetallicRoughness"]["baseColorTexture"].erase("extensions");
  gltf.json["meshes"][0]["primitives"].push_back(primitive_of(gltf));
  gltf.json["meshes"][0]["primitives"][1]["material"] = 1;
  const MeshFile two = read_whole(gltf);
  CHECK(two.model.nodes[1].parts[0].mesh->uvs != two.model.nodes[1].parts[1].mesh->uvs);
  for (const Json& wrong : {Json({{"offset", {1}}}), Json({{"scale", {1, 2, 3}}}), Json({{"rotation", "left"}}),
                            Json({{"rotation", 1e6}}), Json({{"scale", {1e300, 1}}}), Json({{"texCoord", 7}})}) {
    texture_of(gltf)["extensions"]["KHR_texture_transform"] = wrong;
    CAPTURE(wrong.dump());
    CHECK(refusal(read("a.glb", gltf.glb())) == "asset.invalid");
  }
}

TEST_CASE("a sampler says whether a texture is smoothed") {
  Gltf gltf = square_gltf();
  CHECK(read_whole(gltf).model.materials[0].texture->magnify == Magnify::linear);
  gltf.json["samplers"][0]["magFilter"] = 9729;
  CHECK(read_whole(gltf).model.materials[0].texture->magnify == Magnify::linear);
  gltf.json["samplers"][0]["magFilter"] = 9728;
  CHECK(read_whole(gltf).model.materials[0].texture->magnify == Magnify::nearest);
}

TEST_CASE(
    "a mask that cuts all away draws nothing, one that cuts nothing is opaque, all else is drawn opaque and said") {
  struct Case {
    const char* mode;
    const char* picture;
    double factor;
    double cutoff;
    std::size_t parts;
    bool said;
    double cut_below = 0.0;  ///< of the texture's alpha
  };
  const Case cases[] = {
      {"MASK", clear_and_full, 1.0, 0.5, 1, false, 0.5},  // half of it is cut away
      {"MASK", thin, 1.0, 0.5, 0, false},                 // 120/255 < 0.5
      {"MASK", thin, 1.0, 0.2, 1, false},                 // 60/255 > 0.2
      {"MASK", thin, 0.5, 0.2, 1, false, 0.4},            // 30/255 < 0.2 < 60/255
      {"MASK", nullptr, 0.4, 0.5, 0, false},
      {"MASK", nullptr, 0.6, 0.5, 1, false},
      {"BLEND", nullptr, 1.0, 0.5, 1, false},  // lets nothing through
      {"BLEND", nullptr, 0.9, 0.5, 1, true},
      {"BLEND", thin, 1.0, 0.5, 1, true},
      {"OPAQUE", thin, 0.1, 0.5, 1, false},
  };
  for (const Case& each : cases) {
    CAPTURE(each.mode);
    CAPTURE(each.factor);
    Gltf gltf = square_gltf();
    material_of(gltf)["alphaMode"] = each.mode;
    material_of(gltf)["alphaCutoff"] = each.cutoff;
    material_of(gltf)["pbrMetallicRoughness"]["baseColorFactor"] = {1, 1, 1, each.factor};
    if (each.picture == nullptr) {
      material_of(gltf)["pbrMetallicRoughness"].erase("baseColorTexture");
    } else {
      gltf.json["images"][0] = {{"bufferView", gltf.add_view(from_hex(each.picture))}, {"mimeType", "image/png"}};
    }
    const MeshFile file = read_whole(gltf);
    CHECK(file.model.nodes[1].parts.size() == each.parts);
    CHECK((finding_of(file, "asset.drawn-opaque") != nullptr) == each.said);
    CHECK(file.model.materials[0].alpha_cutoff == doctest::Approx(each.cut_below));
  }
}

TEST_CASE("a texture keeps the 16 bits of its picture, and its mask counts in them") {
  const std::filesystem::path fixture = std::filesystem::path(FOCALSTAGE_SOURCE_DIR) / "tests/io/image/fixture";
  Gltf gltf = square_gltf();
  const Bytes corners = *read_file(fixture / "corners16.png", 10000);  // alpha 32768, 65535, 1 and 0
  gltf.json["images"][0] = {{"bufferView", gltf.add_view(corners)}, {"mimeType", "image/png"}};
  material_of(gltf)["alphaMode"] = "MASK";
  const auto material = [&] { return read_whole(gltf).model.materials[0]; };
  CHECK(material().texture->rgba16.at(4) == 0x1234);
  CHECK(material().alpha_cutoff == 0.5);
}

TEST_CASE("a camera can be the viewer or a projector: each an edit that a project takes") {
  Gltf gltf = square_gltf();
  gltf.json["cameras"] = {{{"type", "perspective"},
                           {"name", "seat"},
                           {"perspective", {{"yfov", 2.0 * std::atan(0.25)}, {"znear", 0.1}, {"aspectRatio", 1.5}}}}};
  // Turned to the left by a right angle, on a parent that is scaled: it looks along -X.
  const double s = std::sqrt(0.5);
  gltf.json["nodes"].push_back({{"scale", {2, 2, 2}}, {"translation", {1, 0, 0}}, {"children", {3}}});
  gltf.json["nodes"].push_back({{"camera", 0}, {"translation", {0, 3, 0}}, {"rotation", {0, s, 0, s}}});
  gltf.json["scenes"][0]["nodes"].push_back(2);
  const MeshFile file = read_whole(gltf);
  const Finding* viewer = finding_of(file, "asset.camera");
  const Finding* projector = finding_of(file, "asset.camera-projector");
  REQUIRE(viewer != nullptr);
  REQUIRE(projector != nullptr);
  CHECK(viewer->message.find("seat") != std::string::npos);
  const Result<Project> seated = apply_all(Project{}, viewer->remedy);
  REQUIRE(seated.ok());
  const Rigid& pose = seated->viewer.placement.pose;
  CHECK(glm::length(pose.position_m - glm::dvec3(1, 6, 0)) < 1e-12);
  CHECK(glm::length(pose.direction({0, 0, -1}) - glm::dvec3(-1, 0, 0)) < 1e-6);
  const Result<Project> lit = apply_all(Project{}, projector->remedy);
  REQUIRE(lit.ok());
  const Projector& made = lit->projectors.at(0);
  CHECK(made.name == "seat");
  CHECK(made.width_px == 1620);
  CHECK(made.height_px == 1080);
  CHECK(made.fy_px == doctest::Approx(540.0 / 0.25));
  CHECK(made.cx_px == 810.0);
  CHECK(glm::length(made.pose.position_m - glm::dvec3(1, 6, 0)) < 1e-12);
  for (const auto& [pointer, value] : {std::pair<const char*, Json>{"/cameras/0/type", "fisheye"},
                                       {"/cameras/0/perspective", nullptr},
                                       {"/cameras/0/perspective/yfov", 0},
                                       {"/cameras/0/perspective/yfov", 4},
                                       {"/nodes/3/camera", 1}}) {
    Gltf spoilt = gltf;
    spoilt.json[Json::json_pointer(pointer)] = value;
    CAPTURE(pointer);
    CHECK(refusal(read("a.glb", spoilt.glb())) == "asset.invalid");
  }
}

TEST_CASE("a light can be one of the project's: an edit that a project takes") {
  Gltf gltf = square_gltf();
  gltf.json["extensionsUsed"] = gltf.json["extensionsRequired"] = {"KHR_lights_punctual"};
  gltf.json["extensions"]["KHR_lights_punctual"]["lights"] = {
      {{"type", "directional"}, {"name", "noon"}, {"color", {1, 0.5, 0}}, {"intensity", std::numbers::pi}},
      {{"type", "point"}, {"intensity", 2 * std::numbers::pi}},
      {{"type", "spot"}, {"spot", Json::object()}}};
  for (int i = 0; i < 3; ++i) {
    Json node = {{"name", "lamp"}, {"translation", {0, i, 0}}};
    node["extensions"]["KHR_lights_punctual"]["light"] = i;
    gltf.json["nodes"].push_back(node);
    gltf.json["scenes"][0]["nodes"].push_back(2 + i);
  }
  const MeshFile file = read_whole(gltf);
  std::vector<const Finding*> lights;
  for (const Finding& finding : file.findings) {
    if (finding.code == "asset.light") lights.push_back(&finding);
  }
  REQUIRE(lights.size() == 3);
  const Result<Project> sunny = apply_all(Project{}, lights[0]->remedy);
  REQUIRE(sunny.ok());
  CHECK(sunny->lights.at(0).kind == LightKind::sun);
  CHECK(sunny->lights.at(0).name == "noon");
  CHECK(sunny->lights.at(0).direction == glm::dvec3(0, 0, -1));
  CHECK(sunny->lights.at(0).color == glm::dvec3(1, 0.5, 0));
  CHECK(sunny->lights.at(0).intensity == doctest::Approx(1.0));
  const Result<Project> lamp = apply_all(Project{}, lights[1]->remedy);
  REQUIRE(lamp.ok());
  CHECK(lamp->lights.at(0).kind == LightKind::point);
  CHECK(lamp->lights.at(0).position_m == glm::dvec3(0, 1, 0));
  CHECK(lamp->lights.at(0).intensity == doctest::Approx(2.0));
  CHECK(lights[2]->message.find("cone") != std::string::npos);
  for (const auto& [pointer, value] :
       {std::pair<const char*, Json>{"/extensions/KHR_lights_punctual/lights/0/type", "moon"},
        {"/extensions/KHR_lights_punctual/lights/0/color", {1, 1}},
        {"/extensions/KHR_lights_punctual/lights/0/color", {1, 1, -1}},
        {"/extensions/KHR_lights_punctual/lights/1/intensity", -1},
        {"/extensions/KHR_lights_punctual/lights", 3},
        {"/nodes/2/extensions/KHR_lights_punctual/light", 3},
        {"/nodes/2/extensions/KHR_lights_punctual/light", "first"}}) {
    Gltf spoilt = gltf;
    spoilt.json[Json::json_pointer(pointer)] = value;
    CAPTURE(pointer);
    CHECK(refusal(read("a.glb", spoilt.glb())) == "asset.invalid");
  }
}
