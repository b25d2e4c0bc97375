#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <random>

#include <glm/geometric.hpp>

#include "core/mesh/measure.h"
#include "tests/io/assets/gltf_writer.h"

using namespace focalstage;
using namespace focalstage::test;

namespace {

constexpr int columns = 12;

/// A point of a wavy sheet of 1 m, and where it lies in a picture.
glm::vec3 position_at(int column, int row) {
  const float x = static_cast<float>(column) / columns;
  return {x, static_cast<float>(row) / columns, 0.1f * std::sin(6.0f * x)};
}

glm::vec2 uv_at(int column, int row) {
  return {static_cast<float>(column) / columns, 1.0f - static_cast<float>(row) / columns};
}

/// Positions, UVs and joints of the sheet, compressed by Draco's own encoder; the ids that it gave them.
struct Packed {
  Bytes bytes;
  int position = 0;
  int uv = 0;
  int joints = 0;
  std::size_t points = 0;
  std::size_t faces = 0;
};

Packed packed_sheet(int method) {
  draco::TriangleSoupMeshBuilder builder;
  builder.Start(2 * columns * columns);
  Packed packed;
  packed.position = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
  packed.uv = builder.AddAttribute(draco::GeometryAttribute::TEX_COORD, 2, draco::DT_FLOAT32);
  packed.joints = builder.AddAttribute(draco::GeometryAttribute::GENERIC, 4, draco::DT_UINT8);
  draco::FaceIndex face(0);
  const auto add = [&](const glm::ivec2& a, const glm::ivec2& b, const glm::ivec2& c) {
    const glm::vec3 p[] = {position_at(a.x, a.y), position_at(b.x, b.y), position_at(c.x, c.y)};
    const glm::vec2 t[] = {uv_at(a.x, a.y), uv_at(b.x, b.y), uv_at(c.x, c.y)};
    std::uint8_t j[3][4] = {};
    for (int i = 0; i < 3; ++i) j[i][0] = p[i].x > 0.5f ? 1 : 0;
    builder.SetAttributeValuesForFace(packed.position, face, &p[0], &p[1], &p[2]);
    builder.SetAttributeValuesForFace(packed.uv, face, &t[0], &t[1], &t[2]);
    builder.SetAttributeValuesForFace(packed.joints, face, j[0], j[1], j[2]);
    ++face;
  };
  for (int y = 0; y < columns; ++y) {
    for (int x = 0; x < columns; ++x) {
      add({x, y}, {x + 1, y}, {x + 1, y + 1});
      add({x, y}, {x + 1, y + 1}, {x, y + 1});
    }
  }
  const std::unique_ptr<draco::Mesh> mesh = builder.Finalize();
  draco::Encoder encoder;
  encoder.SetEncodingMethod(method);
  encoder.SetTrackEncodedProperties(true);
  encoder.SetAttributeQuantization(draco::GeometryAttribute::POSITION, 14);
  encoder.SetAttributeQuantization(draco::GeometryAttribute::TEX_COORD, 12);
  draco::EncoderBuffer out;
  REQUIRE(encoder.EncodeMeshToBuffer(*mesh, &out).ok());
  const auto* from = reinterpret_cast<const std::byte*>(out.data());
  packed.bytes.assign(from, from + out.size());
  packed.points = encoder.num_encoded_points();
  packed.faces = encoder.num_encoded_faces();
  return packed;
}

/// The square with the sheet in place of its mesh, as exporters write it: accessors without data.
Gltf packed_gltf(const Packed& packed) {
  Gltf gltf = square_gltf();
  gltf.json["extensionsUsed"] = gltf.json["extensionsRequired"] = {"KHR_draco_mesh_compression"};
  const auto bare = [&](const char* type, int component_type, std::size_t count) {
    gltf.json["accessors"].push_back({{"componentType", component_type}, {"count", count}, {"type", type}});
    return gltf.json["accessors"].size() - 1;
  };
  Json primitive = {{"material", 0}, {"indices", bare("SCALAR", 5123, 3 * packed.faces)}};
  primitive["attributes"] = {{"POSITION", bare("VEC3", 5126, packed.points)},
                             {"TEXCOORD_0", bare("VEC2", 5126, packed.points)},
                             {"JOINTS_0", bare("VEC4", 5121, packed.points)},
                             {"WEIGHTS_0", bare("VEC4", 5126, packed.points)}};
  Json& extension = primitive["extensions"]["KHR_draco_mesh_compression"];
  extension["bufferView"] = gltf.add_view(packed.bytes);
  extension["attributes"] = {{"POSITION", packed.position}, {"TEXCOORD_0", packed.uv}, {"JOINTS_0", packed.joints}};
  gltf.json["meshes"][0]["primitives"] = {primitive};
  return gltf;
}

Json& extension_of(Gltf& gltf) {
  return gltf.json["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"];
}

constexpr int methods[] = {draco::MESH_SEQUENTIAL_ENCODING, draco::MESH_EDGEBREAKER_ENCODING};

}  // namespace

TEST_CASE("what Draco compressed is there again, within the steps that it was rounded to") {
  for (const int method : methods) {
    const MeshFile file = must_read(read("a.glb", packed_gltf(packed_sheet(method)).glb()));
    CHECK(file.triangles == 2 * columns * columns);
    CHECK(file.vertices == (columns + 1) * (columns + 1));
    const ModelPart& part = file.model.nodes[1].parts.at(0);
    const Mesh& mesh = *part.mesh;
    REQUIRE(check_mesh(mesh).ok());
    std::vector<bool> met((columns + 1) * (columns + 1), false);
    for (std::size_t i = 0; i < mesh.positions_m.size(); ++i) {
      const glm::dvec3& p = mesh.positions_m[i];
      const int column = static_cast<int>(std::lround(p.x * columns));
      const int row = static_cast<int>(std::lround(p.y * columns));
      met.at(static_cast<std::size_t>(row * (columns + 1) + column)) = true;
      CHECK(glm::length(p - glm::dvec3(position_at(column, row))) < 2.0 / (1 << 14));
      const glm::dvec2 uv(static_cast<double>(column) / columns, static_cast<double>(row) / columns);
      CHECK(glm::length(mesh.uvs[i] - uv) < 2.0 / (1 << 12));
    }
    CHECK(std::find(met.begin(), met.end(), false) == met.end());
    for (const glm::uvec3& t : mesh.triangles) {
      CHECK(doubled_area(mesh.positions_m[t.x], mesh.positions_m[t.y], mesh.positions_m[t.z]).z > 0.0);
    }
  }
}

TEST_CASE("joints come out of compressed data as the integers they are") {
  Gltf gltf = packed_gltf(packed_sheet(draco::MESH_EDGEBREAKER_ENCODING));
  gltf.json["nodes"][1]["skin"] = 0;
  gltf.json["nodes"].push_back({{"children", {3}}});
  gltf.json["nodes"].push_back(Json::object());
  gltf.json["scenes"][0]["nodes"].push_back(2);
  gltf.json["skins"].push_back({{"joints", {2, 3}}});
  std::vector<float> weights;
  for (int i = 0; i < (columns + 1) * (columns + 1); ++i) weights.insert(weights.end(), {1, 0, 0, 0});
  gltf.json["meshes"][0]["primitives"][0]["attributes"]["WEIGHTS_0"] = gltf.add_floats("VEC4", weights);
  const MeshFile file = must_read(read("a.glb", gltf.glb()));
  const ModelPart& part = file.model.nodes[2].parts.at(0);  // roots stand first
  REQUIRE(part.deformation);
  for (std::size_t i = 0; i < part.mesh->positions_m.size(); ++i) {
    CHECK(part.deformation->shares[i].joint == (part.mesh->positions_m[i].x > 0.5 + 1e-3 ? 1u : 0u));
  }
}

TEST_CASE("compressed data that do not fit what the file says of them are refused with the place") {
  const Packed packed = packed_sheet(draco::MESH_EDGEBREAKER_ENCODING);
  const std::pair<const char*, Json> spoils[] = {
      {"/bufferView", 99},          {"/bufferView", 0},
      {"/bufferView", nullptr},     {"/attributes", nullptr},
      {"/attributes/POSITION", 77}, {"/attributes/POSITION", packed.uv},
      {"/attributes/NORMAL", 0},    {"/attributes/POSITION", "first"},
  };
  for (const auto& [pointer, value] : spoils) {
    Gltf gltf = packed_gltf(packed);
    extension_of(gltf)[Json::json_pointer(pointer)] = value;
    CAPTURE(pointer);
    const Result<MeshFile> file = read("a.glb", gltf.glb());
    REQUIRE(refusal(file) == "asset.invalid");
    CHECK(file.fault().where.find("KHR_draco_mesh_compression") != std::string::npos);
  }
  for (const char* member : {"count", "componentType"}) {
    Gltf gltf = packed_gltf(packed);
    const auto accessor = gltf.json["meshes"][0]["primitives"][0]["attributes"]["POSITION"].get<std::size_t>();
    gltf.json["accessors"][accessor][member] = member == std::string("count") ? 5 : 5130;
    CHECK(refusal(read("a.glb", gltf.glb())) == "asset.invalid");
  }
  Gltf strip = packed_gltf(packed);
  strip.json["meshes"][0]["primitives"][0]["mode"] = 5;
  CHECK(refusal(read("a.glb", strip.glb())) == "asset.unsupported");
}

TEST_CASE("compressed data cut, flipped or with huge counts are refused or sound, and at once") {
  std::mt19937 random(7);
  for (const int method : methods) {
    const Packed whole = packed_sheet(method);
    const auto bear = [&](const Bytes& bytes) {
      Packed damaged = whole;
      damaged.bytes = bytes;
      const auto start = std::chrono::steady_clock::now();
      const Result<MeshFile> file = read("a.glb", packed_gltf(damaged).glb());
      CHECK(std::chrono::steady_clock::now() - start < std::chrono::seconds(1));
      if (!file) {
        REQUIRE_FALSE(file.fault().where.empty());
      } else {
        REQUIRE(check_mesh(*file->model.nodes[1].parts.at(0).mesh).ok());
      }
    };
    for (std::size_t size = 1; size < whole.bytes.size(); ++size) {
      bear(Bytes(whole.bytes.begin(), whole.bytes.begin() + static_cast<std::ptrdiff_t>(size)));
    }
    for (int round = 0; round < 1500; ++round) {
      Bytes damaged = whole.bytes;
      damaged[random() % damaged.size()] ^= static_cast<std::byte>(1u << random() % 8);
      bear(damaged);
      // A number of up to 2^35, as Draco writes them, in the header or anywhere.
      const std::size_t at = 11 + random() % (round % 2 == 0 ? 30 : damaged.size() - 16);
      for (std::size_t i = 0; i < 5; ++i)
        damaged[at + i] = static_cast<std::byte>(i < 4 ? random() | 0x80u : random() % 8);
      bear(damaged);
    }
  }
}
