#include "io/files/files.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>

#include "tests/io/files/small_disk.h"
#include "tests/support/temporary_folder.h"

using namespace focalstage;
namespace fs = std::filesystem;

namespace {

std::string text_of(const fs::path& path) {
  const auto bytes = read_file(path, 1 << 20);
  REQUIRE_MESSAGE(bytes.ok(), path.string());
  return {reinterpret_cast<const char*>(bytes->data()), bytes->size()};
}

mode_t mode_of(const fs::path& path) {
  struct stat status {};
  REQUIRE(::stat(path.c_str(), &status) == 0);
  return status.st_mode & 07777;
}

}  // namespace

TEST_CASE("a file is read whole, up to the limit and not a byte more") {
  const TemporaryFolder folder;
  std::ofstream(folder / "f") << "12345";
  CHECK(read_file(folder / "f", 5)->size() == 5);
  CHECK(read_file(folder / "f", 4).fault().code == "file.too-large");
  std::ofstream(folder / "empty");
  CHECK(read_file(folder / "empty", 0)->empty());
}

TEST_CASE("a file of one GiB is refused by its size") {
  const TemporaryFolder folder;
  std::ofstream(folder / "big") << "x";
  fs::resize_file(folder / "big", 1u << 30);
  const auto read = read_file(folder / "big", 64u << 20);
  REQUIRE_FALSE(read.ok());
  CHECK(read.fault().code == "file.too-large");
  CHECK(read.fault().message.find("1073741824") != std::string::npos);
}

TEST_CASE("what is no ordinary file is refused, without waiting for it") {
  const TemporaryFolder folder;
  CHECK(read_file(folder / "none", 10).fault().code == "file.missing");
  CHECK(read_file(folder / "none" / "deeper", 10).fault().code == "file.missing");
  CHECK(read_file(folder.path(), 10).fault().code == "file.unreadable");
  CHECK(read_file("/dev/zero", 10).fault().code == "file.unreadable");
  REQUIRE(::mkfifo((folder / "pipe").c_str(), 0600) == 0);
  CHECK(read_file(folder / "pipe", 10).fault().code == "file.unreadable");
}

TEST_CASE("a file whose size says nothing is still read within the limit") {
  // Files of /proc have size 0.
  CHECK(read_file("/proc/self/status", 1 << 20)->size() > 100);
  CHECK(read_file("/proc/self/status", 100).fault().code == "file.too-large");
}

TEST_CASE("writing replaces a file, keeps its permissions, and leaves nothing beside it") {
  const TemporaryFolder folder;
  const fs::path path = folder / "f";
  REQUIRE(write_file_atomically(path, std::string_view("one")).ok());
  const mode_t mask = ::umask(0);
  ::umask(mask);
  CHECK(mode_of(path) == (0666 & ~mask));
  REQUIRE(::chmod(path.c_str(), 0640) == 0);
  REQUIRE(write_file_atomically(path, std::string_view("two")).ok());
  CHECK(text_of(path) == "two");
  CHECK(mode_of(path) == 0640);
  CHECK(folder.count() == 1);
}

TEST_CASE("writing through a symbolic link replaces what it means and keeps the link") {
  const TemporaryFolder folder;
  fs::create_directory(folder / "real");
  std::ofstream(folder / "real/f") << "old";
  fs::create_symlink("real/f", folder / "link");
  REQUIRE(write_file_atomically(folder / "link", std::string_view("new")).ok());
  CHECK(fs::is_symlink(folder / "link"));
  CHECK(text_of(folder / "real/f") == "new");
}

TEST_CASE("a file being read while it is replaced stays the old one") {
  const TemporaryFolder folder;
  std::ofstream(folder / "f") << "old";
  const int reader = ::open((folder / "f").c_str(), O_RDONLY);
  REQUIRE(write_file_atomically(folder / "f", std::string_view("newer")).ok());
  char buffer[8] = {};
  CHECK(::read(reader, buffer, sizeof buffer) == 3);
  CHECK(std::string(buffer) == "old");
  ::close(reader);
}

TEST_CASE("what cannot be written says why, and nothing is left behind") {
  const TemporaryFolder folder;
  const Status missing = write_file_atomically(folder / "no/such/f", std::string_view("x"));
  REQUIRE_FALSE(missing.ok());
  CHECK(missing.fault().code == "file.unwritable");
  fs::create_directory(folder / "taken");
  std::ofstream(folder / "taken/inside") << "x";
  const Status onto_folder = write_file_atomically(folder / "taken", std::string_view("x"));
  REQUIRE_FALSE(onto_folder.ok());
  CHECK(onto_folder.fault().code == "file.unwritable");
  CHECK(folder.count() == 1);
}

TEST_CASE("on a full disk the old file stays whole and nothing is left behind") {
  const SmallDisk disk(256 << 10);
  const std::string old(100 << 10, 'o');
  REQUIRE(write_file_atomically(disk / "f", old).ok());
  const std::string bigger(400 << 10, 'n');
  const Status full = write_file_atomically(disk / "f", bigger);
  REQUIRE_FALSE(full.ok());
  CHECK(full.fault().code == "file.unwritable");
  if (disk.is_mounted()) CHECK(full.fault().message.find("No space left") != std::string::npos);
  CHECK(text_of(disk / "f") == old);
  CHECK(disk.count() == 1);
  const std::string smaller(50 << 10, 's');
  REQUIRE(write_file_atomically(disk / "f", smaller).ok());
  CHECK(text_of(disk / "f") == smaller);
}

TEST_CASE("a path stays inside its folder, links followed") {
  const TemporaryFolder outer;
  const fs::path root = outer / "project";
  fs::create_directories(root / "assets");
  std::ofstream(root / "assets/a.obj") << "a";
  std::ofstream(outer / "secret") << "s";
  fs::create_symlink("../../secret", root / "assets/out");
  fs::create_symlink("..", root / "up");
  fs::create_symlink("a.obj", root / "assets/in");
  fs::create_symlink("loop", root / "loop");

  CHECK(*path_inside(root, "assets/a.obj") == fs::canonical(root) / "assets/a.obj");
  CHECK(*path_inside(root, "assets/../assets/./a.obj") == fs::canonical(root) / "assets/a.obj");
  CHECK(*path_inside(root, "assets/in") == fs::canonical(root) / "assets/a.obj");
  CHECK(*path_inside(root, "assets/not-yet") == fs::canonical(root) / "assets/not-yet");
  for (const char* bad : {"../secret", "assets/../../secret", "assets/out", "up/secret", "..", ".", "", "assets/..",
                          "../project-2/x", "loop"}) {
    INFO(bad);
    const auto path = path_inside(root, bad);
    REQUIRE_FALSE(path.ok());
    CHECK(path.fault().code == "path.outside");
  }
  CHECK(path_inside(root, std::string("assets/a.obj\0x", 14)).fault().code == "path.outside");
  CHECK(path_inside(root, "/etc/passwd").fault().code == "path.absolute");
  CHECK(path_inside(root, (root / "assets/a.obj").string()).fault().code == "path.absolute");
  CHECK(path_inside(outer / "none", "a").fault().code == "file.missing");
}

TEST_CASE("SHA-256 of the standard's examples") {
  // FIPS 180-2, B.1; the empty message.
  CHECK(sha256_hex("abc") == "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  CHECK(sha256_hex("") == "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
}
