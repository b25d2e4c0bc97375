#include <algorithm>
#include <chrono>
#include <random>

#include "core/mesh/measure.h"
#include "core/stage/stage.h"
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
  const auto figures =
      read_file(std::string(FOCALSTAGE_SOURCE_DIR) + "/tests/golden/deforming-figures/assets/figures.glb", 1 << 20);
  if (!figures) FAIL(describe(figures.fault()));
  list.push_back({"figures.glb", *figures, {}});
  list.push_back({"tetrahedron.off",
                  bytes_of("OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n"),
                  {}});
  return list;
}

/// What a model's parts deform by names vertices, joints and nodes that there are.
void must_deform(const Model& model, const Node& node, const ModelPart& part) {
  const Deformation& deformation = *part.deformation;
  const std::size_t vertices = part.mesh->positions_m.size();
  const Skin* skin = node.skin < 0 ? nullptr : &model.skins.at(static_cast<std::size_t>(node.skin));
  for (const MorphTarget& target : deformation.targets) {
    REQUIRE(target.offsets_m.size() == target.vertices.size());
    for (const std::uint32_t vertex : target.vertices) REQUIRE(vertex < vertices);
  }
  if (!deformation.first_share.empty()) REQUIRE(deformation.first_share.size() == vertices + 1);
  for (const JointShare& share : deformation.shares) {
    if (skin != nullptr) REQUIRE(share.joint < skin->joints.size());
  }
  if (skin == nullptr) return;
  REQUIRE(skin->joint_from_mesh.size() == skin->joints.size());
  for (const int joint : skin->joints) REQUIRE(static_cast<std::size_t>(joint) < model.nodes.size());
}

/// And can stand on a stage at any time.
void must_stand(const Sample& sample, const Model& model) {
  Project project;
  project.objects.emplace_back();
  project.objects[0].mesh.shape = FileMesh{sample.path};
  const Assets assets{{{sample.path, std::make_shared<const Model>(model)}}};
  for (const double time_s : {0.0, 0.75, 3.0}) {
    const Result<Stage> stood = stage(project, assets, time_s);
    REQUIRE(stood.ok());
    for (const Drawable& drawable : stood->objects[0].drawables) REQUIRE(check_mesh(*drawable.mesh).ok());
  }
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
      if (part.deformation) must_deform(file->model, file->model.nodes[i], part);
    }
  }
  if (sample.path.ends_with("glb")) must_stand(sample, file->model);
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

namespace {

/// The deforming figures as JSON and buffer.
Gltf figures_gltf() {
  const std::vector<Sample> all = samples();
  const Bytes bytes =
      std::find_if(all.begin(), all.end(), [](const Sample& one) { return one.path == "figures.glb"; })->bytes;
  std::uint32_t json_bytes = 0;
  std::memcpy(&json_bytes, bytes.data() + 12, 4);
  Gltf gltf;
  gltf.json = Json::parse(reinterpret_cast<const char*>(bytes.data()) + 20,
                          reinterpret_cast<const char*>(bytes.data()) + 20 + json_bytes);
  gltf.buffer.assign(bytes.begin() + 28 + json_bytes, bytes.end());
  return gltf;
}

void must_bear_any_number(const Gltf& whole) {
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

}  // namespace

TEST_CASE("every number in the JSON of a glTF, replaced by any other, is refused or sound") {
  must_bear_any_number(square_gltf());
  must_bear_any_number(figures_gltf());
}

TEST_CASE("floats that are no numbers, or too large, in any place of a buffer are refused or sound") {
  const Gltf whole = figures_gltf();
  const Sample sample{"a.glb", {}, {}};
  for (std::size_t at = 0; at + 4 <= whole.buffer.size(); at += 4) {
    for (const std::uint32_t bits : {0x7FC00000u, 0x7F800000u, 0xFF7FFFFFu, 0xFFFFFFFFu, 1u}) {
      Gltf spoilt = whole;
      for (std::size_t i = 0; i < 4; ++i) spoilt.buffer[at + i] = static_cast<std::byte>(bits >> (8 * i));
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
