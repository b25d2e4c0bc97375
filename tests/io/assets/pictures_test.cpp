#include <filesystem>
#include <fstream>

#include <unistd.h>

#include "core/stage/stage.h"
#include "io/assets/assets.h"
#include "io/files/files.h"
#include "io/image/png.h"
#include "tests/io/assets/gltf_writer.h"

using namespace focalstage;
using namespace focalstage::test;

namespace {

namespace fs = std::filesystem;

/// A folder of its own, gone afterwards.
class Folder {
 public:
  Folder() {
    std::string name = (fs::temp_directory_path() / "focalstage-pictures-XXXXXX").string();
    REQUIRE(mkdtemp(name.data()) != nullptr);
    path_ = name;
    fs::create_directory(path_ / "frames");
  }
  ~Folder() { fs::remove_all(path_); }

  void put(const std::string& name, const Bytes& bytes) const {
    std::ofstream file(path_ / name, std::ios::binary | std::ios::trunc);
    file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  }

  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

Bytes gray_picture(int width_px, int height_px, int code) {
  const std::vector<std::uint8_t> codes(static_cast<std::size_t>(width_px * height_px),
                                        static_cast<std::uint8_t>(code));
  return *encode_png(width_px, height_px, 1, codes);
}

/// One object with a picture each.
Project showing(const std::vector<ImageAppearance>& images) {
  Project project;
  for (const ImageAppearance& image : images) {
    Object& object = project.objects.emplace_back();
    object.name = "object " + std::to_string(project.objects.size());
    object.appearance = image;
  }
  return project;
}

ImageAppearance sequence(int count) {
  ImageAppearance image;
  image.file = "frames/fire_##.png";
  image.count = count;
  image.rate_hz = 24.0;
  return image;
}

ImageAppearance picture(const std::string& file) {
  ImageAppearance image;
  image.file = file;
  return image;
}

/// fire_01 to fire_04, of gray 10, 20, 30, 40.
void fill(const Folder& folder) {
  for (int k = 1; k <= 4; ++k) folder.put("frames/fire_0" + std::to_string(k) + ".png", gray_picture(3, 2, 10 * k));
}

Fault fault_of(const Project& project, const Folder& folder) {
  const Result<LoadedAssets> loaded = load_assets(project, folder.path());
  return loaded ? Fault{} : loaded.fault();
}

std::shared_ptr<const Texture> shown(const Project& project, const Assets& assets, double time_s) {
  const Result<Stage> stood = stage(project, assets, time_s);
  if (!stood) FAIL(describe(stood.fault()));
  return stood->objects[0].drawables[0].finish.texture;
}

}  // namespace

TEST_CASE("a sequence's pictures are listed with their hashes, and each comes when the clock asks for it") {
  const Folder folder;
  fill(folder);
  const Project project = showing({sequence(4)});
  const Result<LoadedAssets> loaded = load_assets(project, folder.path());
  if (!loaded) FAIL(describe(loaded.fault()));
  REQUIRE(loaded->files.size() == 4);
  for (std::size_t i = 0; i < 4; ++i) {
    CHECK(loaded->files[i].path == "frames/fire_0" + std::to_string(i + 1) + ".png");
    CHECK(loaded->files[i].sha256 == sha256_hex(*read_file(folder.path() / loaded->files[i].path, 10000)));
  }
  CHECK(asset_files(project).size() == 4);
  CHECK(has_all(loaded->assets, project));
  CHECK_FALSE(has_all(loaded->assets, showing({sequence(5)})));
  // From memory, as a show brings them: the files are not asked for again.
  fs::remove_all(folder.path() / "frames");
  const Result<Assets> again = assets_from(project, loaded->files);
  REQUIRE(again.ok());
  for (int k = 0; k < 10; ++k) CHECK(shown(project, *again, k / 24.0)->rgba[0] == 10 * (1 + k % 4));
}

TEST_CASE("a picture is one texture as long as somebody has it, and another for another use") {
  const Folder folder;
  fill(folder);
  folder.put("copy.png", gray_picture(3, 2, 10));
  ImageAppearance tiled = picture("copy.png");
  tiled.wrap = Wrap::repeat;
  const Project project = showing({sequence(4), picture("copy.png"), tiled});
  const Result<LoadedAssets> loaded = load_assets(project, folder.path());
  REQUIRE(loaded.ok());
  const Result<Stage> first = stage(project, loaded->assets, 0.0);
  const Result<Stage> later = stage(project, loaded->assets, 4 / 24.0);
  REQUIRE(first.ok());
  REQUIRE(later.ok());
  const auto texture = [](const Stage& stood, std::size_t i) { return stood.objects[i].drawables[0].finish.texture; };
  CHECK(texture(*first, 0) == texture(*later, 0));  // round once
  CHECK(texture(*first, 0) == texture(*first, 1));  // the same bytes under another name
  CHECK(texture(*first, 1) != texture(*first, 2));
  CHECK(texture(*first, 2)->wrap_u == Wrap::repeat);
}

TEST_CASE("textures keep the 16 bits of their file, and how they are to be understood") {
  const Folder folder;
  folder.put("deep.png", *read_file(fs::path(FOCALSTAGE_SOURCE_DIR) / "tests/io/image/fixture/ramp16.png", 10000));
  ImageAppearance image = picture("deep.png");
  image.color_space = ColorSpace::linear;
  image.filter = Magnify::nearest;
  const Project project = showing({image});
  const Result<LoadedAssets> loaded = load_assets(project, folder.path());
  REQUIRE(loaded.ok());
  const std::shared_ptr<const Texture> texture = shown(project, loaded->assets, 0.0);
  REQUIRE(texture->is_deep());
  CHECK(texture->rgba16[4 * 513] == 64 * 513);
  CHECK(texture->color_space == ColorSpace::linear);
  CHECK(texture->magnify == Magnify::nearest);
}

TEST_CASE("a missing picture is named, with its place in the sequence and in the project") {
  const Folder folder;
  fill(folder);
  fs::remove(folder.path() / "frames/fire_03.png");
  const Fault fault = fault_of(showing({picture("frames/fire_01.png"), sequence(4)}), folder);
  CHECK(fault.code == "asset.missing");
  CHECK(fault.where == "/objects/1/appearance/image/file");
  CHECK(fault.message.find("frames/fire_03.png") != std::string::npos);
  CHECK(fault.message.find("picture 3 of 4") != std::string::npos);
}

TEST_CASE("pictures of different sizes are no sequence") {
  const Folder folder;
  fill(folder);
  folder.put("frames/fire_04.png", gray_picture(3, 3, 1));
  const Fault fault = fault_of(showing({sequence(4)}), folder);
  CHECK(fault.code == "asset.sequence");
  CHECK(fault.where == "/objects/0/appearance/image/file");
  CHECK(fault.message.find("frames/fire_04.png has 3 x 3") != std::string::npos);
  CHECK(fault_of(showing({sequence(3)}), folder).code.empty());
}

TEST_CASE("what is no picture is refused when it is read, what is damaged inside when it is shown") {
  const Folder folder;
  const Bytes whole = gray_picture(40, 30, 9);
  const auto refused = [&](const Bytes& bytes) {
    folder.put("a.png", bytes);
    const Fault fault = fault_of(showing({picture("a.png")}), folder);
    CHECK(fault.where == "/objects/0/appearance/image/file");
    CHECK(fault.message.find("a.png") != std::string::npos);
    return fault.code;
  };
  CHECK(refused(bytes_of("not a picture")) == "image.unsupported");
  CHECK(refused({}) == "image.unsupported");
  CHECK(refused(Bytes(whole.begin(), whole.end() - 20)) == "image.invalid");
  // 60000 x 60000 in 100 bytes: a header that promises what no file of this length holds.
  Bytes huge = whole;
  huge[18] = huge[22] = std::byte{0xEA};
  CHECK(refused(huge).starts_with("image."));
  Bytes damaged = whole;
  damaged[damaged.size() - 20] ^= std::byte{0x55};  // among the pixels
  folder.put("a.png", damaged);
  const Project project = showing({picture("a.png")});
  const Result<LoadedAssets> loaded = load_assets(project, folder.path());
  REQUIRE(loaded.ok());
  const Result<Stage> stood = stage(project, loaded->assets, 0.0);
  REQUIRE_FALSE(stood.ok());
  CHECK(stood.fault().code == "image.invalid");
  CHECK(stood.fault().where == "/objects/0/appearance/image/file");
  CHECK(stood.fault().message.find("a.png") != std::string::npos);
}

TEST_CASE("pictures cannot be fetched from outside the project's folder") {
  const Folder outside;
  outside.put("secret.png", gray_picture(1, 1, 1));
  const Folder folder;
  const std::string up = "../" + outside.path().filename().string() + "/secret.png";
  for (const std::string& path : {up, "frames/../" + up, (outside.path() / "secret.png").string()}) {
    CHECK(fault_of(showing({picture(path)}), folder).code.starts_with("path."));
  }
}

TEST_CASE("a long sequence is read and played with little in memory") {
  // 400 pictures of 1 MiB each when decoded, 1 kB on disk: decoded together they would be 400 MiB.
  const Folder folder;
  for (int k = 1; k <= 400; ++k) {
    folder.put("frames/fire_" + std::string(k < 10 ? "0" : "") + std::to_string(k) + ".png",
               gray_picture(512, 512, k % 256));
  }
  const Project project = showing({sequence(400)});
  const Result<LoadedAssets> loaded = load_assets(project, folder.path());
  REQUIRE(loaded.ok());
  const auto resident_bytes = [] {
    std::size_t whole = 0, resident = 0;
    std::ifstream("/proc/self/statm") >> whole >> resident;
    return resident * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  };
  const std::size_t before = resident_bytes();
  int wrong = 0;
  for (int k = 0; k < 400; ++k) wrong += shown(project, loaded->assets, k / 24.0)->rgba[0] == (k + 1) % 256 ? 0 : 1;
  CHECK(wrong == 0);
  CHECK(resident_bytes() < before + (std::size_t{320} << 20));  // 256 MiB of pictures not in use, and some air
}
