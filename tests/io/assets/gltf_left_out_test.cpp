#include "tests/io/assets/gltf_writer.h"

using namespace focalstage;
using namespace focalstage::test;

TEST_CASE("what a material says beyond its base colour is told, and only that") {
  Gltf gltf = square_gltf();
  const auto told = [&] {
    const MeshFile file = must_read(read("a.glb", gltf.glb()));
    std::string all;
    for (const Finding& finding : file.findings) {
      if (finding.code == "asset.drawn-matt") all += finding.message.substr(finding.message.find(": ") + 2) + ";";
    }
    return all;
  };
  CHECK(told() == "");
  Json& material = gltf.json["materials"][0];
  material["pbrMetallicRoughness"]["metallicFactor"] = 0;
  material["pbrMetallicRoughness"]["roughnessFactor"] = 1;
  material["emissiveFactor"] = {0, 0, 0};
  CHECK(told() == "");
  material["pbrMetallicRoughness"]["metallicFactor"] = 0.5;
  CHECK(told() == "metal;");
  material["pbrMetallicRoughness"]["metallicFactor"] = 0;
  material["pbrMetallicRoughness"]["roughnessFactor"] = 0.4;
  CHECK(told() == "gloss;");
  material["pbrMetallicRoughness"]["roughnessFactor"] = 1;
  material["pbrMetallicRoughness"]["metallicRoughnessTexture"] = {{"index", 0}};
  CHECK(told() == "metal, gloss;");
  material["pbrMetallicRoughness"].erase("metallicRoughnessTexture");
  material["emissiveFactor"] = {0, 0, 1};
  material["normalTexture"] = {{"index", 0}};
  material["occlusionTexture"] = {{"index", 0}};
  gltf.json["extensionsUsed"] = {"KHR_materials_clearcoat"};
  material["extensions"]["KHR_materials_clearcoat"] = {{"clearcoatFactor", 1}};
  CHECK(told() == "light of its own, a normal map, occlusion, KHR_materials_clearcoat;");
  // No light acts on it, so that none of it was meant.
  gltf.json["extensionsUsed"] = {"KHR_materials_clearcoat", "KHR_materials_unlit"};
  material["extensions"]["KHR_materials_unlit"] = Json::object();
  CHECK(told() == "");
}

TEST_CASE("an extension that a file uses but does not require is left out, and told") {
  Gltf gltf = square_gltf();
  gltf.json["extensionsUsed"] = {"EXT_lights_image_based", "KHR_texture_transform"};
  const MeshFile file = must_read(read("a.glb", gltf.glb()));
  REQUIRE(file.findings.size() == 1);
  CHECK(file.findings[0].code == "asset.extension");
  CHECK(file.findings[0].message == "EXT_lights_image_based is left out");
}
