#include <algorithm>

#include "core/mesh/measure.h"
#include "io/image/png.h"
#include "tests/io/assets/reading.h"

using namespace focalstage;
using namespace focalstage::test;

namespace {

const std::string cube =
    "# a unit cube of quads\n"
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
    "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 4 8 7 3\nf 1 5 8 4\nf 2 3 7 6\n";

bool has_code(const MeshFile& file, const std::string& code) {
  return std::any_of(file.findings.begin(), file.findings.end(), [&](const Finding& f) { return f.code == code; });
}

}  // namespace

TEST_CASE("polygons become closed triangles") {
  const MeshFile file = must_read(read("cube.obj", cube));
  CHECK(file.vertices == 8);
  CHECK(file.triangles == 12);
  CHECK(is_closed(only_mesh(file)));
  CHECK(enclosed_volume_m3(only_mesh(file)) == doctest::Approx(1.0));
  CHECK(only_mesh(file).normals.empty());
  CHECK(file.findings.empty());
}

TEST_CASE("numbers are read to the last bit, with plus signs, exponents and Windows' line ends") {
  const MeshFile file =
      must_read(read("a.obj", "v +0.1 1e-3 -2.5E+1\r\nv 1 0 0 1.0\r\nv 0 1 0 0.5 0.5 0.5\r\nf 1 2 3\r\n"));
  CHECK(only_mesh(file).positions_m[0] == glm::dvec3(0.1, 1e-3, -25.0));
}

TEST_CASE("corners with texture coordinates and normals split where they differ and are shared where not") {
  const MeshFile file = must_read(read("a.obj",
                                       "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
                                       "vt 0 0\nvt 1 0\nvt 1 1\nvt 0.25 0.75\nvn 0 0 2\n"
                                       "f 1/1/1 2/2/1 3/3/1\nf 1/1/1 3/3/1 4/4/1\nf 1/2/1 3/3/1 4/4/1\n"));
  const Mesh& mesh = only_mesh(file);
  CHECK(mesh.positions_m.size() == 5);  // vertex 1 stands with two coordinates
  CHECK(mesh.triangles.size() == 3);
  CHECK(mesh.uvs[3] == glm::dvec2(0.25, 0.75));
  CHECK(mesh.normals[0] == glm::dvec3(0, 0, 1));
}

TEST_CASE("negative indices count back from where they stand") {
  const MeshFile file =
      must_read(read("a.obj", "v 9 9 9\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nf -3//-1 -2//-1 -1//-1\nv 5 5 5\n"));
  CHECK(only_mesh(file).positions_m[0] == glm::dvec3(0, 0, 0));
  CHECK(only_mesh(file).positions_m[2] == glm::dvec3(0, 1, 0));
}

TEST_CASE("a line continues after a backslash") {
  const MeshFile file = must_read(read("a.obj", "v 0 0 0\nv 1 0 \\\n 0\nv 0 1 0\nf 1 2\\\r\n 3\n"));
  CHECK(file.triangles == 1);
}

TEST_CASE("materials split the mesh; colours and plain textures are read") {
  const std::vector<std::uint8_t> pixels{10, 20, 30, 40, 50, 60};
  const std::map<std::string, Bytes> companions{
      {"lib/a.mtl", bytes_of("newmtl red\nKd 1 0 0.5\nNs 20\nnewmtl tiles\nKd 1 1 1\nmap_Kd tiles one.png\n"
                             "newmtl gray\nKd 0.25\nd 0.5\n")},
      {"lib/tiles one.png", *encode_png(2, 1, 3, pixels)}};
  const MeshFile file = must_read(read("a.obj",
                                       "mtllib lib/a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\n"
                                       "usemtl red\nf 1 2 3\nusemtl tiles\nf 1/1 2/2 3/3\nusemtl gray\nf 3 2 1\n",
                                       companions));
  REQUIRE(file.model.nodes[0].parts.size() == 3);
  REQUIRE(file.model.materials.size() == 3);
  for (const ModelPart& part : file.model.nodes[0].parts) {
    const Material& material = file.model.materials[static_cast<std::size_t>(part.material)];
    if (material.name == "red") CHECK(material.base_color == glm::dvec3(1, 0, 0.5));
    if (material.name == "gray") CHECK(material.base_color == glm::dvec3(0.25));
    CHECK((material.name == "tiles") == (material.texture != nullptr));
    CHECK((material.name == "tiles") == !part.mesh->uvs.empty());
    if (material.texture) CHECK(material.texture->rgba == std::vector<std::uint8_t>{10, 20, 30, 255, 40, 50, 60, 255});
  }
  CHECK(has_code(file, "asset.drawn-opaque"));
}

TEST_CASE("missing libraries, textures and materials are found, not fatal; what cannot be reached is") {
  const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 3\n";
  MeshFile file = must_read(read("a.obj", "mtllib none.mtl\n" + triangle));
  CHECK(has_code(file, "asset.material-missing"));
  CHECK(file.model.nodes[0].parts[0].material == -1);
  file = must_read(read("a.obj", "mtllib a.mtl\n" + triangle, {{"a.mtl", bytes_of("newmtl red\nmap_Kd none.png\n")}}));
  CHECK(has_code(file, "asset.texture-missing"));
  file =
      must_read(read("a.obj", "mtllib a.mtl\n" + triangle, {{"a.mtl", bytes_of("newmtl red\nmap_Kd -s 2 2 a.png\n")}}));
  CHECK(has_code(file, "asset.material-left-out"));

  const Companions outside = [](const std::string& uri) -> Result<std::span<const std::byte>> {
    return Fault{"path.outside", uri, "", ""};
  };
  const Bytes bytes = bytes_of("mtllib ../../etc/passwd\n" + triangle);
  CHECK(refusal(read_mesh_file({"a.obj", bytes, outside})) == "path.outside");
  CHECK(refusal(read("a.obj", "mtllib a.mtl\n" + triangle,
                     {{"a.mtl", bytes_of("newmtl red\nmap_Kd a.png\n")}, {"a.png", bytes_of("no picture")}})) ==
        "image.unsupported");
}

TEST_CASE("what is not exactly an OBJ is refused at its line") {
  const std::string start = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\n";
  for (const std::string line : {"f 1 2 4", "f 0 1 2", "f 1 2 -4", "f 1 2", "f 1/1 2/1 3", "f 1 2 x", "f 1/2 2/2 3/2",
                                 "f 1 2 99999999999999999999", "v 1 2", "v 1 2 nan", "v 1 2 inf", "v 1 2 1e999",
                                 "v 1 2 3x", "vn 1 2", "v 1 2 3 4 5 6 7 8", "hello world", "vt"}) {
    const Result<MeshFile> file = read("a.obj", start + line + "\nf 1 2 3\n");
    CAPTURE(line);
    REQUIRE(refusal(file) == "asset.invalid");
    CHECK(file.fault().where == "a.obj: line 5");
  }
  CHECK(refusal(read("a.obj", start + "cstype bezier\n")) == "asset.unsupported");
  CHECK(refusal(read("a.obj", start)) == "asset.invalid");
  CHECK(refusal(read("a.obj", "")) == "asset.invalid");
}

TEST_CASE("a normal without length leaves the faces flat") {
  const MeshFile file = must_read(read("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 0\nvn 0 0 1\nf 1//1 2//2 3//2\n"));
  CHECK(only_mesh(file).normals.empty());
  CHECK(has_code(file, "asset.normals"));
}
