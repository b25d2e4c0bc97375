#include "devices/camera/recorded_camera.h"

#include <unistd.h>

#include <filesystem>
#include <fstream>

#include <doctest/doctest.h>

namespace focalstage {
namespace {

struct Folder {
  std::filesystem::path path;
  Folder() {
    std::string name = (std::filesystem::temp_directory_path() / "focalstage-camera-XXXXXX").string();
    path = ::mkdtemp(name.data());
  }
  ~Folder() { std::filesystem::remove_all(path); }
  std::string file(const std::string& name) const { return (path / name).string(); }
  void write(const std::string& name, const std::string& bytes) const {
    std::ofstream(file(name), std::ios::binary) << bytes;
  }
};

GrayImage image_of(std::uint8_t code) { return {3, 2, {code, 1, 2, 3, 4, 255}}; }

TEST_CASE("pictures come back as they were written; comments are read over") {
  const Folder folder;
  REQUIRE(write_pgm(folder.file("a.pgm"), image_of(9)).ok());
  CHECK(*read_pgm(folder.file("a.pgm")) == image_of(9));
  folder.write("b.pgm",
               std::string("P5 # by hand\n#two\n3 2\n# white\n255\n") + std::string("\x09\x01\x02\x03\x04\xff", 6));
  CHECK(*read_pgm(folder.file("b.pgm")) == image_of(9));
  CHECK(write_pgm("/nowhere/a.pgm", image_of(1)).fault().code == "camera.unwritable");
}

TEST_CASE("bad pictures are refused with their file") {
  const Folder folder;
  for (const char* bytes :
       {"", "P", "P6 3 2 255\n123456", "P5", "P5 3", "P5 3 2 255\n12345", "P5 0 2 255\n", "P5 3 2 65535\n123456",
        "P5 3 x 255\n123456", "P5 99999 99999 255\n", "P5 9999999 2 255\n"}) {
    folder.write("bad.pgm", bytes);
    const auto image = read_pgm(folder.file("bad.pgm"));
    REQUIRE_FALSE(image);
    CHECK(image.fault().code == "camera.picture");
    CHECK(image.fault().where == folder.file("bad.pgm"));
  }
  CHECK(read_pgm(folder.file("none.pgm")).fault().code == "camera.picture");
}

TEST_CASE("a folder is shown in order, at its rate, and is lost at its end") {
  const Folder folder;
  for (std::uint8_t n = 0; n < 3; ++n) {
    REQUIRE(write_pgm(folder.file("p" + std::to_string(n) + ".pgm"), image_of(n)).ok());
  }
  folder.write("notes.txt", "not a picture");
  double now = 50.0;
  RecordedCamera camera({folder.path.string(), 10.0, false, [&] { return now; }});
  CHECK(camera.state().phase == DevicePhase::off);
  CHECK(camera.newest() == nullptr);
  REQUIRE(camera.open().ok());
  for (std::uint8_t n = 0; n < 3; ++n) {
    now = 50.05 + 0.1 * n;
    const auto frame = camera.newest();
    REQUIRE(frame);
    CHECK(frame->gray[0] == n);
    CHECK(frame->number == n);
    CHECK(frame->time_s == doctest::Approx(50.0 + 0.1 * n));
    CHECK(camera.newest() == frame);
    CHECK(camera.state().phase == DevicePhase::running);
  }
  now = 50.31;
  CHECK(camera.newest() == nullptr);
  CHECK(camera.state().phase == DevicePhase::lost);
  CHECK(camera.state().fault->code == "camera.ended");
  camera.close();
  REQUIRE(camera.open().ok());
  CHECK(camera.newest()->gray[0] == 0);
}

TEST_CASE("in a loop it goes on; a picture that can't be read is a loss when its turn comes") {
  const Folder folder;
  REQUIRE(write_pgm(folder.file("a.pgm"), image_of(1)).ok());
  REQUIRE(write_pgm(folder.file("b.pgm"), image_of(2)).ok());
  double now = 0.0;
  RecordedCamera camera({folder.path.string(), 10.0, true, [&] { return now; }});
  REQUIRE(camera.open().ok());
  now = 0.75;
  CHECK(camera.newest()->number == 7);
  CHECK(camera.newest()->gray[0] == 2);
  folder.write("a.pgm", "P5 damaged");
  now = 0.85;
  CHECK(camera.newest() == nullptr);
  CHECK(camera.state().fault->code == "camera.picture");
}

TEST_CASE("no folder, or an empty one, is refused") {
  const Folder folder;
  CHECK(RecordedCamera({folder.path.string()}).open().fault().code == "camera.folder");
  CHECK(RecordedCamera({"/nowhere"}).open().fault().code == "camera.folder");
  CHECK_FALSE(RecordedCamera({"/nowhere"}).identify().ok());
}

}  // namespace
}  // namespace focalstage
