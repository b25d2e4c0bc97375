#include <cmath>

#include "core/mesh/measure.h"
#include "tests/io/assets/reading.h"

using namespace focalstage;
using namespace focalstage::test;

namespace {

const glm::dvec3 tetrahedron[4] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
const glm::uvec3 faces[4] = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};

Bytes binary_stl(const std::string& header, const glm::vec3& normal = {0, 0, 0}) {
  Bytes bytes = bytes_of(header);
  bytes.resize(80);
  put(bytes, std::uint32_t{4});
  for (const glm::uvec3& face : faces) {
    for (int i = 0; i < 3; ++i) put(bytes, normal[i]);
    for (int k = 0; k < 3; ++k) {
      for (int i = 0; i < 3; ++i) put(bytes, static_cast<float>(tetrahedron[face[k]][i]));
    }
    put(bytes, std::uint16_t{7});
  }
  return bytes;
}

std::string ascii_stl() {
  std::string text = "solid a tetrahedron\n";
  for (const glm::uvec3& face : faces) {
    text += "facet normal 0 0 0\n outer loop\n";
    for (int k = 0; k < 3; ++k) {
      const glm::dvec3& p = tetrahedron[face[k]];
      text += "  vertex " + std::to_string(p.x) + " " + std::to_string(p.y) + " " + std::to_string(p.z) + "\n";
    }
    text += " endloop\nendfacet\n";
  }
  return text + "endsolid a tetrahedron\n";
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

const std::string off = "OFF\n# comment\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";

}  // namespace

TEST_CASE("STL keeps every facet and joins equal corners, binary as ascii") {
  for (const Bytes& bytes : {binary_stl("made by us"), binary_stl("solid but binary"), bytes_of(ascii_stl())}) {
    const MeshFile file = must_read(read("a.stl", bytes));
    CHECK(file.triangles == 4);
    CHECK(file.vertices == 4);
    CHECK(is_closed(only_mesh(file)));
    CHECK(enclosed_volume_m3(only_mesh(file)) == doctest::Approx(1.0 / 6));
    CHECK(file.findings.empty());
  }
}

TEST_CASE("degenerate facets stay; several solids are one; capitals are words, too") {
  const std::string twice = ascii_stl() + ascii_stl();
  CHECK(must_read(read("a.stl", twice)).triangles == 8);
  std::string shouted = ascii_stl();
  for (char& c : shouted) c = static_cast<char>(std::toupper(c));
  CHECK(must_read(read("a.stl", shouted)).triangles == 4);
  const std::string flat =
      "solid\nfacet normal nan nan nan\nouter loop\nvertex 0 0 0\nvertex 0 0 0\nvertex 1 0 0\n"
      "endloop\nendfacet\nendsolid\n";
  CHECK(must_read(read("a.stl", flat)).triangles == 1);
}

TEST_CASE("facets that wind against their normal are reported") {
  const MeshFile file = must_read(read("a.stl", binary_stl("x", {0, 0, 1})));
  REQUIRE(file.findings.size() == 1);  // three facets face down or sideways; the one facing down disagrees
  CHECK(file.findings[0].code == "asset.normals");
  CHECK(file.findings[0].message.starts_with("1 facets"));
}

TEST_CASE("an STL whose size and count disagree is refused") {
  Bytes bytes = binary_stl("made by us");
  bytes.push_back(std::byte{0});
  CHECK(refusal(read("a.stl", bytes)) == "asset.invalid");
  bytes.resize(84);
  CHECK(refusal(read("a.stl", bytes)) == "asset.invalid");
  // 84 bytes that announce four thousand million facets.
  for (std::size_t i = 80; i < 84; ++i) bytes[i] = std::byte{0xFF};
  const Result<MeshFile> huge = read("a.stl", bytes);
  REQUIRE(refusal(huge) == "asset.invalid");
  CHECK(huge.fault().message.find("4294967295") != std::string::npos);
  for (std::size_t i = 80; i < 84; ++i) bytes[i] = std::byte{0};
  CHECK(refusal(read("a.stl", bytes)) == "asset.invalid");  // no facet at all
  Bytes nan = binary_stl("made by us");
  for (std::size_t i = 96; i < 100; ++i) nan[i] = std::byte{0xFF};
  CHECK(refusal(read("a.stl", nan)) == "asset.invalid");
}

TEST_CASE("ascii STL is held to its grammar") {
  for (const auto& [from, to] : std::initializer_list<std::pair<std::string, std::string>>{
           {"facet normal 0 0 0", "facet 0 0 0"},
           {"outer loop", "loop"},
           {"vertex 0.000000", "vertex nan"},
           {"vertex 0.000000", "vertex"},
           {"endloop", "vertex 1 1 1\nendloop"},
           {"endfacet", ""},
           {"endsolid a tetrahedron", ""},
       }) {
    const std::string changed = from + " -> " + to;
    CAPTURE(changed);
    CHECK(refusal(read("a.stl", replaced(ascii_stl(), from, to))) == "asset.invalid");
  }
  CHECK(refusal(read("a.stl", "")) == "asset.invalid");
  CHECK(refusal(read("a.stl", "solid\nendsolid\n")) == "asset.invalid");
  CHECK(refusal(read("a.stl", ascii_stl() + "rubbish\n")) == "asset.invalid");
}

TEST_CASE("OFF with counts on the first or second line, polygons, normals and colours") {
  MeshFile file = must_read(read("a.off", off));
  CHECK(file.vertices == 4);
  CHECK(file.triangles == 4);
  CHECK(is_closed(only_mesh(file)));
  CHECK(enclosed_volume_m3(only_mesh(file)) == doctest::Approx(1.0 / 6));
  file = must_read(read("a.off", "OFF 4 1 4\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3 0.5 0.5 0.5\n"));
  CHECK(file.triangles == 2);
  CHECK(file.findings[0].code == "asset.colors");
  file = must_read(read("a.off", "NOFF\n3 1 0\n0 0 0 0 0 2\n1 0 0 0 0 2\n0 1 0 0 0 2\n3 0 1 2\n"));
  CHECK(only_mesh(file).normals[1] == glm::dvec3(0, 0, 1));
  file = must_read(read("a.off", "COFF\n3 1 0\n0 0 0 255 0 0 255\n1 0 0 255 0 0 255\n0 1 0 255 0 0 255\n3 0 1 2\n"));
  CHECK(file.triangles == 1);
}

TEST_CASE("what is not exactly an OFF is refused") {
  for (const auto& [from, to] : std::initializer_list<std::pair<std::string, std::string>>{
           {"OFF", "FOO"},
           {"4 4 0", "4 4"},
           {"4 4 0", "5 4 0"},
           {"4 4 0", "4 5 0"},
           {"4 4 0", "4 3 0"},
           {"4 4 0", "1000000000 4 0"},
           {"4 4 0", "4 -1 0"},
           {"3 0 2 1", "3 0 2 4"},
           {"3 0 2 1", "3 0 2 -1"},
           {"3 0 2 1", "2 0 2"},
           {"3 0 2 1", "1000000000 0 2 1"},
           {"1 0 0", "1 0"},
           {"1 0 0", "1 0 inf"},
           {"1 0 0", "1 0 0 0"},
       }) {
    const std::string changed = from + " -> " + to;
    CAPTURE(changed);
    CHECK(refusal(read("a.off", replaced(off, from, to))) == "asset.invalid");
  }
  CHECK(refusal(read("a.off", "OFF BINARY\n")) == "asset.unsupported");
  CHECK(refusal(read("a.off", "4OFF\n")) == "asset.unsupported");
}

TEST_CASE("an ending that is not known is refused with those that are") {
  const Result<MeshFile> file = read("a.fbx", "x");
  REQUIRE(refusal(file) == "asset.unsupported");
  CHECK(file.fault().remedy == "use obj, ply, stl, off, gltf or glb");
  CHECK(refusal(read("folder.obj/mesh", "x")) == "asset.unsupported");
}
