#include "core/mesh/measure.h"
#include "tests/io/assets/reading.h"

using namespace focalstage;
using namespace focalstage::test;

namespace {

const std::string ascii =
    "ply\nformat ascii 1.0\ncomment made by hand\nelement vertex 4\nproperty float x\nproperty float y\n"
    "property float z\nproperty uchar red\nproperty double nx\nproperty double ny\nproperty double nz\n"
    "property float s\nproperty float t\nelement face 1\nproperty list uchar int vertex_indices\nproperty uchar flag\n"
    "element edge 1\nproperty int vertex1\nproperty list uchar float weights\nend_header\n"
    "0 0 0 255 0 0 2 0 0\n1 0 0 255 0 0 2 1 0\n1 1 0 255 0 0 2 1 1\n0 1 0 255 0 0 2 0 1\n4 0 1 2 3 7\n1 2 0.5 0.25\n";

/// The same without the extras, in either byte order.
Bytes binary(std::endian order) {
  const char* name = order == std::endian::little ? "binary_little_endian" : "binary_big_endian";
  Bytes bytes = bytes_of(std::string("ply\r\nformat ") + name +
                         " 1.0\r\nelement vertex 4\r\nproperty double x\r\nproperty float y\r\nproperty short z\r\n"
                         "property list uint16 int8 tags\r\nelement face 2\r\n"
                         "property list uchar uint vertex_index\r\nend_header\r\n");
  for (const glm::ivec2& corner : {glm::ivec2(0, 0), glm::ivec2(1, 0), glm::ivec2(1, 1), glm::ivec2(0, 1)}) {
    put(bytes, corner.x + 0.1, order);
    put(bytes, static_cast<float>(corner.y), order);
    put(bytes, std::int16_t{-3}, order);
    put(bytes, std::uint16_t{2}, order);
    bytes.resize(bytes.size() + 2);
  }
  for (const glm::uvec3& face : {glm::uvec3(0, 1, 2), glm::uvec3(0, 2, 3)}) {
    bytes.push_back(std::byte{3});
    for (int i = 0; i < 3; ++i) put(bytes, face[i], order);
  }
  return bytes;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

}  // namespace

TEST_CASE("ascii PLY with other properties and elements around what counts") {
  const MeshFile file = must_read(read("a.ply", ascii));
  const Mesh& mesh = only_mesh(file);
  CHECK(file.vertices == 4);
  CHECK(file.triangles == 2);
  CHECK(mesh.positions_m[2] == glm::dvec3(1, 1, 0));
  CHECK(mesh.normals[2] == glm::dvec3(0, 0, 1));
  CHECK(mesh.uvs[2] == glm::dvec2(1, 1));
  REQUIRE(file.findings.size() == 1);
  CHECK(file.findings[0].code == "asset.colors");
}

TEST_CASE("binary PLY in both byte orders") {
  for (const std::endian order : {std::endian::little, std::endian::big}) {
    const MeshFile file = must_read(read("a.PLY", binary(order)));
    const Mesh& mesh = only_mesh(file);
    CHECK(mesh.positions_m[2] == glm::dvec3(1.1, 1, -3));
    CHECK(mesh.triangles == std::vector<glm::uvec3>{{0, 1, 2}, {0, 2, 3}});
    CHECK(mesh.normals.empty());
    CHECK(mesh_area_m2(mesh) == doctest::Approx(1.0));
  }
}

TEST_CASE("what is not exactly a PLY is refused") {
  const std::pair<std::string, std::string> wrong[] = {
      {"ply\n", "plx\n"},
      {"ascii 1.0", "ascii 1.1"},
      {"ascii 1.0", "text 1.0"},
      {"property float x", "property half x"},
      {"property float x", "property float w"},
      {"property float y", "property float x"},
      {"property list uchar int vertex_indices", "property list float int vertex_indices"},
      {"property list uchar int vertex_indices", "property list uchar float vertex_indices"},
      {"property list uchar int vertex_indices", "property list uchar int corners"},
      {"end_header\n", ""},
      {"element vertex 4", "element vertex 5"},
      {"element vertex 4", "element vertex -4"},
      {"element vertex 4", "element vertex 3"},
      {"element vertex 4", "element vertex 4 4"},
      {"element face 1", "element face 2"},
      {"4 0 1 2 3 7", "4 0 1 2 4 7"},
      {"4 0 1 2 3 7", "4 0 1 2 -1 7"},
      {"4 0 1 2 3 7", "2 0 1 7"},
      {"4 0 1 2 3 7", "4 0 1 2.5 3 7"},
      {"0 0 0 255", "0 nan 0 255"},
      {"0 0 0 255", "0 zero 0 255"},
      {"1 2 0.5 0.25\n", "1 2 0.5\n"},
      {"1 2 0.5 0.25\n", "1 2 0.5 0.25 8\n"},
  };
  for (const auto& [from, to] : wrong) {
    const std::string changed = from + " -> " + to;
    CAPTURE(changed);
    CHECK(refusal(read("a.ply", replaced(ascii, from, to))) == "asset.invalid");
  }
  CHECK(refusal(read("a.ply", replaced(replaced(ascii, "element edge", "element tristrips"), "vertex1", "v"))) ==
        "asset.unsupported");
  Bytes longer = binary(std::endian::little);
  longer.push_back(std::byte{0});
  CHECK(refusal(read("a.ply", longer)) == "asset.invalid");
  // The last of the first vertex's eight bytes of x holds its sign and exponent.
  Bytes infinite = binary(std::endian::little);
  const std::string header(reinterpret_cast<const char*>(infinite.data()), infinite.size());
  const std::size_t data = header.find("end_header\r\n") + 12;
  infinite[data + 6] = std::byte{0xF0};
  infinite[data + 7] = std::byte{0x7F};
  CHECK(refusal(read("a.ply", infinite)) == "asset.invalid");
}

TEST_CASE("a count of a billion in a small file allocates nothing") {
  for (const char* format : {"ascii", "binary_little_endian"}) {
    const std::string start = std::string("ply\nformat ") + format + " 1.0\n";
    CHECK(refusal(read("a.ply", start +
                                    "element vertex 1000000000\nproperty float x\nproperty float y\nproperty float z\n"
                                    "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n")) ==
          "asset.invalid");
    CHECK(refusal(read("a.ply", start + "element nothing 1000000000\nend_header\n")) == "asset.invalid");
    CHECK(refusal(read("a.ply", start + "element vertex 0\nproperty float x\nproperty float y\nproperty float z\n"
                                        "element face 1\nproperty list uint int vertex_indices\nend_header\n"
                                        "\xFF\xFF\xFF\x7F 1 2 3\n")) == "asset.invalid");
  }
}
