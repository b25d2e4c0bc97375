#include "io/assets/assets.h"

#include <filesystem>
#include <fstream>

#include <unistd.h>

#include "io/files/files.h"
#include "tests/io/assets/gltf_writer.h"

using namespace focalstage;
using namespace focalstage::test;

namespace {

namespace fs = std::filesystem;

/// A folder of its own, gone afterwards.
class Folder {
 public:
  Folder() {
    std::string name = (fs::temp_directory_path() / "focalstage-assets-XXXXXX").string();
    REQUIRE(mkdtemp(name.data()) != nullptr);
    path_ = name;
  }
  ~Folder() { fs::remove_all(path_); }

  void put(const std::string& name, const Bytes& bytes) const {
    fs::create_directories((path_ / name).parent_path());
    std::ofstream file(path_ / name, std::ios::binary);
    file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  }

  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

Object object_of(const std::string& file) {
  Object object;
  object.name = file;
  object.mesh.shape = FileMesh{file};
  return object;
}

const std::string triangle = "mtllib lib/a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl m\nf 1/1 2/1 3/1\n";

/// An OBJ with library and texture in folders, and a glTF with a buffer beside it.
void fill(const Folder& folder) {
  const std::vector<std::uint8_t> pixel{1, 2, 3};
  folder.put("assets/a.obj", bytes_of(triangle));
  folder.put("assets/lib/a.mtl", bytes_of("newmtl m\nmap_Kd ../../textures/t.png\n"));
  folder.put("textures/t.png", *encode_png(1, 1, 3, pixel));
  Gltf gltf = square_gltf();
  gltf.json["buffers"][0]["uri"] = "b.bin";
  folder.put("assets/b.gltf", bytes_of(gltf.json.dump()));
  folder.put("assets/b.bin", gltf.buffer);
}

}  // namespace

TEST_CASE("every file a project refers to is read once and listed with its hash") {
  const Folder folder;
  fill(folder);
  Project project;
  project.surfaces.emplace_back();
  project.surfaces[0].mesh.shape = FileMesh{"assets/a.obj"};
  project.objects = {object_of("assets/a.obj"), object_of("assets/b.gltf")};
  project.objects[0].hidden = true;
  const Result<LoadedAssets> loaded = load_assets(project, folder.path());
  if (!loaded) FAIL(describe(loaded.fault()));
  std::vector<std::string> paths;
  for (const AssetFile& file : loaded->files) {
    paths.push_back(file.path);
    CHECK(file.sha256 == sha256_hex(file.bytes));
    CHECK(file.bytes == *read_file(folder.path() / file.path, 1 << 20));
  }
  CHECK(paths == std::vector<std::string>{"assets/a.obj", "assets/b.bin", "assets/b.gltf", "assets/lib/a.mtl",
                                          "textures/t.png"});
  CHECK(loaded->assets.models.size() == 2);
  CHECK(loaded->assets.models.at("assets/a.obj")->materials[0].texture->rgba[2] == 3);

  SUBCASE("and the same comes from memory") {
    const Result<Assets> again = assets_from(project, loaded->files);
    if (!again) FAIL(describe(again.fault()));
    CHECK(*again->models.at("assets/b.gltf")->nodes[1].parts[0].mesh ==
          *loaded->assets.models.at("assets/b.gltf")->nodes[1].parts[0].mesh);
    std::vector<AssetFile> fewer = loaded->files;
    fewer.erase(fewer.begin() + 1);
    const Result<Assets> incomplete = assets_from(project, fewer);
    REQUIRE_FALSE(incomplete.ok());
    CHECK(incomplete.fault().code == "asset.missing");
  }
}

TEST_CASE("a missing file is named with its place in the project") {
  const Folder folder;
  fill(folder);
  Project project;
  project.objects = {object_of("assets/a.obj"), object_of("assets/none.ply")};
  Result<LoadedAssets> loaded = load_assets(project, folder.path());
  REQUIRE_FALSE(loaded.ok());
  CHECK(loaded.fault().code == "asset.missing");
  CHECK(loaded.fault().where == "/objects/1/mesh/file");
  CHECK(loaded.fault().message.find("assets/none.ply") != std::string::npos);
  fs::remove(folder.path() / "assets/b.bin");
  project.objects = {object_of("assets/b.gltf")};
  loaded = load_assets(project, folder.path());
  REQUIRE_FALSE(loaded.ok());
  CHECK(loaded.fault().code == "asset.missing");
  CHECK(loaded.fault().where == "/objects/0/mesh/file");
  CHECK(loaded.fault().message.find("assets/b.bin") != std::string::npos);
}

TEST_CASE("nothing outside the project's folder is read, by whatever way") {
  const Folder outside;
  outside.put("secret.obj", bytes_of(triangle));
  const Folder folder;
  fill(folder);
  fs::create_symlink(outside.path() / "secret.obj", folder.path() / "link.obj");
  const std::string up = "../" + outside.path().filename().string() + "/secret.obj";
  for (const std::string& path :
       {up, "assets/../" + up, (outside.path() / "secret.obj").string(), std::string("link.obj"), std::string()}) {
    CAPTURE(path);
    Project project;
    project.objects = {object_of(path)};
    const Result<LoadedAssets> loaded = load_assets(project, folder.path());
    REQUIRE_FALSE(loaded.ok());
    CHECK(loaded.fault().code.starts_with("path."));
    CHECK(loaded.fault().where == "/objects/0/mesh/file");
  }
  // Nor by a file that refers on.
  folder.put("assets/lib/a.mtl",
             bytes_of("newmtl m\nmap_Kd ../../../" + outside.path().filename().string() + "/x.png\n"));
  Project project;
  project.objects = {object_of("assets/a.obj")};
  CHECK(load_assets(project, folder.path()).fault().code == "path.outside");
  Gltf gltf = square_gltf();
  for (const std::string uri : {"/etc/passwd", "..%2f..%2fetc%2fpasswd", "../../x.bin"}) {
    gltf.json["buffers"][0]["uri"] = uri;
    folder.put("assets/b.gltf", bytes_of(gltf.json.dump()));
    project.objects = {object_of("assets/b.gltf")};
    const Result<LoadedAssets> loaded = load_assets(project, folder.path());
    REQUIRE_FALSE(loaded.ok());
    CHECK(loaded.fault().code.starts_with("path."));
  }
}

TEST_CASE("a fault inside a file keeps its place there") {
  const Folder folder;
  folder.put("a.obj", bytes_of("v 0 0 0\nv 1 0 nan\n"));
  Project project;
  project.objects = {object_of("a.obj")};
  const Result<LoadedAssets> loaded = load_assets(project, folder.path());
  REQUIRE_FALSE(loaded.ok());
  CHECK(loaded.fault().code == "asset.invalid");
  CHECK(loaded.fault().where == "a.obj: line 2");
}

TEST_CASE("a folder in place of a file is refused") {
  const Folder folder;
  fs::create_directory(folder.path() / "folder.obj");
  for (const char* path : {"folder.obj", "folder.obj/a.obj"}) {
    Project project;
    project.objects = {object_of(path)};
    const Result<LoadedAssets> loaded = load_assets(project, folder.path());
    REQUIRE_FALSE(loaded.ok());
    CHECK(loaded.fault().where == "/objects/0/mesh/file");
  }
}

TEST_CASE("what a file holds is counted") {
  const Folder folder;
  fill(folder);
  Result<ImportReport> report = inspect_asset(folder.path() / "assets/b.gltf");
  REQUIRE(report.ok());
  CHECK(report->vertices == 4);
  CHECK(report->triangles == 2);
  CHECK(report->model->nodes.size() == 2);
  CHECK(report->model->animations.size() == 1);
  // Alone, an OBJ's texture above its folder cannot be reached.
  report = inspect_asset(folder.path() / "assets/a.obj");
  REQUIRE_FALSE(report.ok());
  CHECK(report.fault().code == "path.outside");
  CHECK(inspect_asset(folder.path() / "none.obj").fault().code == "asset.missing");
  const Result<ImportReport> torus =
      inspect_asset(fs::path(FOCALSTAGE_SOURCE_DIR) / "tests/io/assets/fixture/torus.obj");
  REQUIRE(torus.ok());
  CHECK(torus->vertices == 63);
  CHECK(torus->triangles == 96);
}

TEST_CASE("pictures of surfaces are read with the meshes, and missed at their place") {
  const Folder folder;
  fill(folder);
  Project project;
  project.surfaces.resize(2);
  project.surfaces[0].albedo = FileAlbedo{"textures/t.png", {}};
  project.surfaces[1].albedo = FileAlbedo{"textures/t.png", {}};
  CHECK(asset_files(project) == std::set<std::string>{"textures/t.png"});
  const Result<LoadedAssets> loaded = load_assets(project, folder.path());
  REQUIRE(loaded);
  REQUIRE(loaded->files.size() == 1);
  REQUIRE(loaded->assets.pictures.size() == 1);
  CHECK(has_all(loaded->assets, project));
  CHECK_FALSE(has_all({}, project));
  const Result<Assets> from_memory = assets_from(project, loaded->files);
  REQUIRE(from_memory);
  CHECK(from_memory->pictures.contains("textures/t.png"));
  project.surfaces[1].albedo = FileAlbedo{"textures/none.png", {}};
  const Result<LoadedAssets> missing = load_assets(project, folder.path());
  REQUIRE_FALSE(missing.ok());
  CHECK(missing.fault().code == "asset.missing");
  CHECK(missing.fault().where == "/surfaces/1/albedo/file");
  project.surfaces[1].albedo = FileAlbedo{"assets/b.bin", {}};
  CHECK_FALSE(load_assets(project, folder.path()).ok());
}
