#include <chrono>
#include <random>

#include "core/mesh/measure.h"
#include "io/files/files.h"
#include "tests/io/assets/gltf_writer.h"

using namespace focalstage;
using namespace focalstage::test;

namespace {

/// Files another program wrote, the companions a .gltf needs, and a GLB with all that we read.
struct Sample {
  std::string path;
  Bytes bytes;
  std::map<std::string, Bytes> companions;
};

Bytes fixture(const std::string& name) {
  const auto bytes = read_file(std::string(FOCALSTAGE_SOURCE_DIR) + "/tests/io/assets/fixture/" + name, 1 << 20);
  if (!bytes) FAIL(describe(bytes.fault()));
  return *bytes;
}

std::vector<Sample> samples() {
  std::vector<Sample> list;
  for (const char* name : {"torus_binary.stl", "torus_ascii.stl", "torus_binary.ply", "torus_ascii.ply", "torus.glb"}) {
    list.push_back({name, fixture(name), {}});
  }
  list.push_back({"torus.obj", fixture("torus.obj"), {{"torus.mtl", fixture("torus.mtl")}}});
  list.push_back({"torus.gltf", fixture("torus.gltf"), {{"torus_0.bin", fixture("torus_0.bin")}}});
  list.push_back({"square.glb", square_gltf().glb(), {}});
  list.push_back({"tetrahedron.off",
                  bytes_of("OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n"),
                  {}});
  return list;
}

/// Whatever comes of it: a fault that says where, or meshes that can be drawn.
void must_be_sound(const Sample& sample, const Bytes& bytes) {
  const Result<MeshFile> file = read(sample.path, bytes, sample.companions);
  if (!file) {
    REQUIRE_FALSE(file.fault().code.empty());
    REQUIRE_FALSE(file.fault().where.empty());
    return;
  }
  for (std::size_t i = 0; i < file->model.nodes.size(); ++i) {
    REQUIRE(file->model.nodes[i].parent < static_cast<int>(i));
    for (const ModelPart& part : file->model.nodes[i].parts) {
      REQUIRE(check_mesh(*part.mesh).ok());
      REQUIRE(part.material < static_cast<int>(file->model.materials.size()));
      const bool textured =
          part.material >= 0 && file->model.materials[static_cast<std::size_t>(part.material)].texture;
      if (textured) REQUIRE_FALSE(part.mesh->uvs.empty());
    }
  }
}

template <class Work>
double seconds(Work&& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

TEST_CASE("files of another program are read whole: a torus of 8 by 6 quads") {
  for (const Sample& sample : samples()) {
    CAPTURE(sample.path);
    const MeshFile file = must_read(read(sample.path, sample.bytes, sample.companions));
    if (!sample.path.starts_with("torus")) continue;
    CHECK(file.triangles == 96);
    double area_m2 = 0.0;
    for (const Node& node : file.model.nodes) {
      for (const ModelPart& part : node.parts) area_m2 += mesh_area_m2(*part.mesh);
    }
    // 4 pi^2 R r = 15.79 for the round one, less what the facets cut off.
    CHECK(area_m2 == doctest::Approx(13.5).epsilon(0.05));
    if (sample.path.ends_with("stl")) CHECK(is_closed(only_mesh(file)));
  }
}

TEST_CASE("a file cut at any byte is refused or sound") {
  for (const Sample& sample : samples()) {
    CAPTURE(sample.path);
    // Text is parsed from its start each time: every byte of short files, every seventh of long ones.
    const std::size_t step = sample.bytes.size() > 6000 ? 7 : 1;
    for (std::size_t size = 0; size < sample.bytes.size(); size += step) {
      must_be_sound(sample, Bytes(sample.bytes.begin(), sample.bytes.begin() + static_cast<std::ptrdiff_t>(size)));
    }
  }
}

TEST_CASE("binary files cut at any byte are refused") {
  for (const Sample& sample : samples()) {
    if (sample.path != "torus_binary.stl" && sample.path != "torus_binary.ply" && !sample.path.ends_with("glb"))
      continue;
    CAPTURE(sample.path);
    for (std::size_t size = 0; size < sample.bytes.size(); ++size) {
      const Bytes part(sample.bytes.begin(), sample.bytes.begin() + static_cast<std::ptrdiff_t>(size));
      CHECK_FALSE(read(sample.path, part).ok());
    }
  }
}

TEST_CASE("flipped bits and changed bytes are refused or sound") {
  std::mt19937 random(20260101);
  for (const Sample& sample : samples()) {
    CAPTURE(sample.path);
    for (int round = 0; round < 1000; ++round) {
      Bytes damaged = sample.bytes;
      for (int changes = 0; changes <= round % 4; ++changes) {
        std::byte& at = damaged[random() % damaged.size()];
        at = round % 2 == 0 ? at ^ static_cast<std::byte>(1u << random() % 8) : static_cast<std::byte>(random());
      }
      must_be_sound(sample, damaged);
    }
  }
}

TEST_CASE("every number in the JSON of a glTF, replaced by any other, is refused or sound") {
  const Gltf whole = square_gltf();
  const Json flat = whole.json.flatten();
  const Sample sample{"a.glb", {}, {}};
  for (const auto& [pointer, value] : flat.items()) {
    for (const Json& other :
         {Json(0), Json(1), Json(2), Json(3), Json(5), Json(-1), Json(0.5), Json(2147483647), Json(4294967295u),
          Json(1e300), Json("x"), Json(nullptr), Json(true), Json::array(), Json::object(), Json::array({0})}) {
      Gltf spoilt = whole;
      spoilt.json[Json::json_pointer(pointer)] = other;
      CAPTURE(pointer);
      must_be_sound(sample, spoilt.glb());
    }
  }
}

TEST_CASE("deep JSON, deep nodes and long lists end at once") {
  CHECK(seconds([] {
          CHECK(refusal(read("a.gltf", std::string(1000000, '['))) == "asset.invalid");
          CHECK(refusal(read("a.gltf", R"({"asset":{"version":"2.0","extras":)" + std::string(100000, '[') +
                                           std::string(100000, ']') + "}}")) == "asset.invalid");
          std::string many = R"({"asset":{"version":"2.0"},"nodes":[{})";
          for (int i = 0; i < 200000; ++i) many += ",{}";
          CHECK(refusal(read("a.gltf", many + "]}")) == "asset.invalid");
        }) < 10.0);
  // A chain of 20,000 nodes is valid, and followed without recursion.
  Gltf chain = square_gltf();
  for (int i = 1; i < 20000; ++i) {
    if (i > 1) chain.json["nodes"].push_back(Json::object());
    chain.json["nodes"][static_cast<std::size_t>(i)]["children"] = {i + 1};
  }
  chain.json["nodes"].push_back(Json::object());
  CHECK(must_read(read("a.glb", chain.glb())).model.nodes.size() == 20001);
  chain.json["nodes"].back()["children"] = {0};
  chain.json["scenes"][0]["nodes"] = Json::array();
  CHECK(refusal(read("a.glb", chain.glb())) == "asset.invalid");
}

TEST_CASE("small files cannot ask for much: repeated references are shared or bounded") {
  Gltf gltf = square_gltf();
  Json& primitives = gltf.json["meshes"][0]["primitives"];
  while (primitives.size() < 1000) primitives.push_back(primitives[0]);
  Json& nodes = gltf.json["nodes"];
  nodes = Json::array();
  gltf.json.erase("scenes");
  gltf.json.erase("scene");
  gltf.json.erase("animations");
  while (nodes.size() < 100) nodes.push_back({{"mesh", 0}});
  CHECK(refusal(read("a.glb", gltf.glb())) == "asset.too-large");  // 100,000 parts
  nodes.erase(nodes.begin() + 60, nodes.end());
  const MeshFile file = must_read(read("a.glb", gltf.glb()));
  CHECK(file.model.nodes[59].parts[999].mesh == file.model.nodes[0].parts[0].mesh);
}

TEST_CASE("a picture in a glTF that promises too much is refused") {
  Gltf gltf = square_gltf();
  const std::vector<std::uint8_t> one{1, 2, 3};
  Bytes png = *encode_png(1, 1, 3, one);
  png[16] = png[20] = std::byte{0x10};  // 268 million pixels a side; the checksum breaks, too
  gltf.json["images"][0] = {{"bufferView", gltf.add_view(png)}, {"mimeType", "image/png"}};
  CHECK(refusal(read("a.glb", gltf.glb())) == "image.invalid");
  gltf.json["images"][0] = {{"bufferView", gltf.add_view(bytes_of("no picture"))}, {"mimeType", "image/png"}};
  CHECK(refusal(read("a.glb", gltf.glb())) == "image.unsupported");
}

TEST_CASE("a GLB's container is checked before its content") {
  const Bytes whole = square_gltf().glb();
  const auto with = [&](std::size_t at, std::uint32_t value) {
    Bytes changed = whole;
    for (std::size_t i = 0; i < 4; ++i) changed[at + i] = static_cast<std::byte>(value >> (8 * i));
    return changed;
  };
  CHECK(refusal(read("a.glb", with(4, 1))) == "asset.unsupported");
  CHECK(refusal(read("a.glb", with(8, 0xFFFFFFFFu))) == "asset.invalid");
  CHECK(refusal(read("a.glb", with(12, 0xFFFFFFFFu))) == "asset.invalid");
  CHECK(refusal(read("a.glb", with(12, 0))) == "asset.invalid");
  CHECK(refusal(read("a.glb", with(16, 0))) == "asset.invalid");
  Bytes longer = whole;
  longer.resize(longer.size() + 4);
  CHECK(refusal(read("a.glb", longer)) == "asset.invalid");
}
