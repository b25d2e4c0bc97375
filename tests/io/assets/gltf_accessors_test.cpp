#include <cmath>
#include <limits>

#include "tests/io/assets/gltf_writer.h"

using namespace focalstage;
using namespace focalstage::test;

namespace {

Json& attributes_of(Gltf& gltf) { return gltf.json["meshes"][0]["primitives"][0]["attributes"]; }

const Mesh& mesh_of(const MeshFile& file) { return *file.model.nodes.at(1).parts.at(0).mesh; }

/// A sparse part with 16-bit indices and floats.
Json sparse_of(Gltf& gltf, const std::vector<std::uint16_t>& places, const std::vector<float>& values) {
  Bytes indices;
  for (const std::uint16_t place : places) put(indices, place);
  Bytes data;
  for (const float value : values) put(data, value);
  Json sparse;
  sparse["count"] = places.size();
  sparse["indices"] = {{"bufferView", gltf.add_view(indices)}, {"componentType", 5123}};
  sparse["values"] = {{"bufferView", gltf.add_view(data)}};
  return sparse;
}

/// Adds an accessor of one element per four bytes or less, padded to strides of a multiple of four.
template <class T>
std::size_t add_packed(Gltf& gltf, const std::string& type, int component_type, bool normalized,
                       const std::vector<std::vector<T>>& elements) {
  Bytes data;
  for (const std::vector<T>& element : elements) {
    for (const T component : element) put(data, component);
    while (data.size() % 4 != 0) data.push_back(std::byte{0});
  }
  const std::size_t view = gltf.add_view(data);
  gltf.json["bufferViews"][view]["byteStride"] = data.size() / elements.size();
  gltf.json["accessors"].push_back({{"bufferView", view},
                                    {"componentType", component_type},
                                    {"count", elements.size()},
                                    {"type", type},
                                    {"normalized", normalized}});
  return gltf.json["accessors"].size() - 1;
}

}  // namespace

TEST_CASE("sparse values replace elements of the data, or of zeros where there are none") {
  Gltf gltf = square_gltf();
  gltf.json["accessors"][0]["sparse"] = sparse_of(gltf, {1, 3}, {7, 8, 9, -1, -2, -3});
  MeshFile file = must_read(read("a.glb", gltf.glb()));
  CHECK(mesh_of(file).positions_m == std::vector<glm::dvec3>{{0, 0, 0}, {7, 8, 9}, {1, 1, 0}, {-1, -2, -3}});
  gltf.json["accessors"][0].erase("bufferView");
  file = must_read(read("a.glb", gltf.glb()));
  CHECK(mesh_of(file).positions_m == std::vector<glm::dvec3>{{0, 0, 0}, {7, 8, 9}, {0, 0, 0}, {-1, -2, -3}});
}

TEST_CASE("an accessor without data is zeros, as positions and as indices") {
  Gltf gltf = square_gltf();
  gltf.json["accessors"][2].erase("bufferView");
  CHECK(mesh_of(must_read(read("a.glb", gltf.glb()))).uvs == std::vector<glm::dvec2>(4, glm::dvec2(0, 1)));
  gltf.json["accessors"][3].erase("bufferView");
  CHECK(mesh_of(must_read(read("a.glb", gltf.glb()))).triangles == std::vector<glm::uvec3>(2, glm::uvec3(0)));
}

TEST_CASE("sparse parts are held to their views, their order and their count") {
  Gltf whole = square_gltf();
  whole.json["accessors"][0]["sparse"] = sparse_of(whole, {1, 3}, {7, 8, 9, -1, -2, -3});
  const std::pair<const char*, Json> spoils[] = {
      {"/count", 0},
      {"/count", 5},
      {"/count", 3},
      {"/count", "two"},
      {"/indices", nullptr},
      {"/values", 3},
      {"/indices/bufferView", 99},
      {"/indices/bufferView", -1},
      {"/indices/byteOffset", 1},
      {"/indices/byteOffset", 4},
      {"/indices/componentType", 5122},
      {"/indices/componentType", 5126},
      {"/indices/componentType", 5121},
      {"/values/bufferView", 99},
      {"/values/byteOffset", 4},
      {"/values/byteOffset", 2147483644},
  };
  for (const auto& [pointer, value] : spoils) {
    Gltf gltf = whole;
    gltf.json[Json::json_pointer("/accessors/0/sparse" + std::string(pointer))] = value;
    CAPTURE(pointer);
    CAPTURE(value.dump());
    const Result<MeshFile> file = read("a.glb", gltf.glb());
    REQUIRE(refusal(file) == "asset.invalid");
    CHECK(file.fault().where.find("/accessors/0/sparse") != std::string::npos);
  }
  for (const std::vector<std::uint16_t>& places : {std::vector<std::uint16_t>{3, 1}, {1, 1}, {1, 4}}) {
    Gltf gltf = square_gltf();
    gltf.json["accessors"][0]["sparse"] = sparse_of(gltf, places, {7, 8, 9, -1, -2, -3});
    CHECK(refusal(read("a.glb", gltf.glb())) == "asset.invalid");
  }
  Gltf gltf = square_gltf();
  gltf.json["accessors"][0]["sparse"] = sparse_of(gltf, {1}, {0, std::numeric_limits<float>::infinity(), 0});
  CHECK(refusal(read("a.glb", gltf.glb())) == "asset.invalid");
}

TEST_CASE("quantized positions, normals and UVs are what they stand for; without the extension they are refused") {
  const auto quantized = [](bool declared) {
    Gltf gltf = square_gltf();
    if (declared) gltf.json["extensionsUsed"] = gltf.json["extensionsRequired"] = {"KHR_mesh_quantization"};
    attributes_of(gltf)["POSITION"] =
        add_packed<std::int16_t>(gltf, "VEC3", 5122, false, {{0, 0, 0}, {-300, 0, 0}, {-300, 20, 0}, {0, 20, 7}});
    attributes_of(gltf)["NORMAL"] =
        add_packed<std::int8_t>(gltf, "VEC3", 5120, true, {{0, 0, 127}, {0, 0, -128}, {127, 0, 0}, {0, 127, 0}});
    attributes_of(gltf)["TEXCOORD_0"] =
        add_packed<std::uint8_t>(gltf, "VEC2", 5121, false, {{0, 0}, {2, 0}, {2, 3}, {0, 3}});
    return read("a.glb", gltf.glb());
  };
  CHECK(refusal(quantized(false)) == "asset.invalid");
  const MeshFile file = must_read(quantized(true));
  CHECK(mesh_of(file).positions_m == std::vector<glm::dvec3>{{0, 0, 0}, {-300, 0, 0}, {-300, 20, 0}, {0, 20, 7}});
  CHECK(mesh_of(file).normals == std::vector<glm::dvec3>{{0, 0, 1}, {0, 0, -1}, {1, 0, 0}, {0, 1, 0}});
  CHECK(mesh_of(file).uvs == std::vector<glm::dvec2>{{0, 1}, {2, 1}, {2, -2}, {0, -2}});
}

TEST_CASE("every normalized integer is the fraction that glTF gives it") {
  const auto first_uv = [](std::size_t (*add)(Gltf&)) {
    Gltf gltf = square_gltf();
    gltf.json["extensionsUsed"] = {"KHR_mesh_quantization"};
    attributes_of(gltf)["TEXCOORD_0"] = add(gltf);
    return mesh_of(must_read(read("a.glb", gltf.glb()))).uvs[0];
  };
  CHECK(first_uv([](Gltf& g) {
          return add_packed<std::uint8_t>(g, "VEC2", 5121, true, {{51, 255}, {0, 0}, {0, 0}, {0, 0}});
        }) == glm::dvec2(0.2, 0));
  CHECK(first_uv([](Gltf& g) {
          return add_packed<std::uint16_t>(g, "VEC2", 5123, true, {{13107, 65535}, {0, 0}, {0, 0}, {0, 0}});
        }) == glm::dvec2(0.2, 0));
  CHECK(first_uv([](Gltf& g) {
          return add_packed<std::int8_t>(g, "VEC2", 5120, true, {{-128, -127}, {0, 0}, {0, 0}, {0, 0}});
        }) == glm::dvec2(-1, 2));
  CHECK(first_uv([](Gltf& g) {
          return add_packed<std::int16_t>(g, "VEC2", 5122, true, {{-32768, 32767}, {0, 0}, {0, 0}, {0, 0}});
        }) == glm::dvec2(-1, 0));
}

TEST_CASE("indices of one, two and four bytes name the same vertices") {
  for (const int component_type : {5121, 5123, 5125}) {
    Gltf gltf = square_gltf();
    Bytes data;
    for (const std::uint32_t index : {3u, 2u, 1u}) {
      if (component_type == 5121) put(data, static_cast<std::uint8_t>(index));
      if (component_type == 5123) put(data, static_cast<std::uint16_t>(index));
      if (component_type == 5125) put(data, index);
    }
    const std::size_t view = gltf.add_view(data);
    gltf.json["accessors"].push_back(
        {{"bufferView", view}, {"componentType", component_type}, {"count", 3}, {"type", "SCALAR"}});
    gltf.json["meshes"][0]["primitives"][0]["indices"] = gltf.json["accessors"].size() - 1;
    CHECK(mesh_of(must_read(read("a.glb", gltf.glb()))).triangles == std::vector<glm::uvec3>{{3, 2, 1}});
  }
}

TEST_CASE("bounds that are not those of the values are said, bounds of another length are refused") {
  Gltf gltf = square_gltf();
  const auto findings = [&] { return must_read(read("a.glb", gltf.glb())).findings; };
  gltf.json["accessors"][0]["min"] = {0, 0, 0};
  gltf.json["accessors"][0]["max"] = {1, 1, 0};
  CHECK(findings().empty());
  gltf.json["accessors"][0]["max"] = {1, 0.5, 0};
  REQUIRE(findings().size() == 1);
  CHECK(findings()[0].code == "asset.bounds");
  CHECK(findings()[0].where == "a.glb: /accessors/0");
  gltf.json["accessors"][0]["max"] = {1, 2, 0};
  CHECK(findings().size() == 1);
  gltf.json["accessors"][0]["max"] = {1, 1};
  CHECK(refusal(read("a.glb", gltf.glb())) == "asset.invalid");
}

TEST_CASE("small files cannot have much looked through: what accessors promise is bounded by what there is") {
  Gltf gltf = square_gltf();
  gltf.json["accessors"][1] = {{"componentType", 5126}, {"count", 2147483647}, {"type", "VEC3"}};
  CHECK(refusal(read("a.glb", gltf.glb())) == "asset.too-large");
  gltf = square_gltf();
  for (int i = 0; i < 2000; ++i) {
    gltf.json["accessors"].push_back({{"componentType", 5126}, {"count", 100000}, {"type", "VEC4"}});
  }
  CHECK(refusal(read("a.glb", gltf.glb())) == "asset.too-large");
}
