#include <doctest/doctest.h>
#include <fcntl.h>
#include <hdf5.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmath>

#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include "io/show/disk.h"
#include "io/show/hdf5.h"
#include "io/show/reader.h"
#include "io/show/seal.h"
#include "io/show/writer.h"
#include "tests/io/show/sample.h"

namespace focalstage {
namespace {

namespace fs = std::filesystem;

void write_show(const fs::path& path, const ShowHeader& header) {
  Result<ShowWriter> writer = ShowWriter::start(path, header, false, 1);
  REQUIRE(writer.ok());
  for (int k = 0; k < header.frames; ++k) REQUIRE(writer->add_frame(k, sample::images(header, k), sample::measure(k)));
  REQUIRE(writer->finish().ok());
}

/// The code of the fault with which `path` is refused, and "" where it is not or the fault does not name it.
std::string refusal(const fs::path& path) {
  const Result<ShowReader> show = ShowReader::open(path);
  if (show.ok() || show.fault().where.rfind(path.string(), 0) != 0 || show.fault().message.empty()) return "";
  return show.fault().code;
}

void reseal(const fs::path& path) { REQUIRE(write_seal(open_file(path, O_RDWR))); }

TEST_CASE("a show cut at any byte is refused") {
  const sample::Folder folder;
  const fs::path path = folder / "cut.h5";
  write_show(path, sample::header(1, 20, 10, 1));
  std::uint64_t refused = 0;
  const std::uint64_t length = fs::file_size(path);
  for (std::uint64_t cut = length; cut-- > 0;) {
    REQUIRE(::truncate(path.c_str(), static_cast<off_t>(cut)) == 0);
    // Shorter than its first word, it is anybody's file.
    if (refusal(path) == (cut < 16 ? "show.not-a-show" : "show.damaged")) ++refused;
  }
  CHECK(refused == length);
}

TEST_CASE("a show with any bit flipped, or with more behind it, is refused") {
  const sample::Folder folder;
  const fs::path path = folder / "flip.h5";
  write_show(path, sample::header(1, 20, 10, 1));
  const DiskFile file = open_file(path, O_RDWR);
  const std::uint64_t length = file.size();
  const auto flip = [&](std::uint64_t bit) {
    std::byte byte[1];
    REQUIRE(file.read_at(bit / 8, byte));
    byte[0] ^= static_cast<std::byte>(1u << (bit % 8));
    REQUIRE(file.write_at(bit / 8, byte));
  };
  std::vector<std::uint64_t> bits;
  for (std::uint64_t bit = 0; bit < 512 * 8; ++bit) bits.push_back(bit);
  std::mt19937_64 random(3);
  for (int i = 0; i < 4000; ++i) bits.push_back(512 * 8 + random() % ((length - 512) * 8));
  for (const std::uint64_t bit : bits) {
    CAPTURE(bit);
    flip(bit);
    REQUIRE(refusal(path) != "");
    flip(bit);
  }
  REQUIRE(refusal(path) == "");
  const std::byte more[1] = {};
  REQUIRE(file.write_at(length, more));
  CHECK(refusal(path) == "show.damaged");
}

TEST_CASE("what is no show is refused by what it is") {
  const sample::Folder folder;
  const fs::path path = folder / "other.h5";
  CHECK(refusal(path) == "show.missing");
  CHECK(refusal(folder / "other.h5/deeper.h5") == "show.missing");
  CHECK(refusal(folder.path()) == "show.unreadable");
  REQUIRE(::mkfifo(path.c_str(), 0600) == 0);
  CHECK(refusal(path) == "show.unreadable");
  fs::remove(path);
  for (const std::string& bytes :
       {std::string(), std::string("f"), std::string(4096, '\0'), std::string("{\"focalstage\":1}")}) {
    sample::put(path, bytes);
    CHECK(refusal(path) == "show.not-a-show");
  }
  write_show(path, sample::header(1, 20, 10, 1));
  std::string bytes = sample::bytes_of(path);
  sample::put(path, bytes.substr(512));
  CHECK(refusal(path) == "show.not-a-show");
  bytes[16] = '2';
  sample::put(path, bytes);
  CHECK(refusal(path) == "show.version");
}

/// Changes the file with HDF5 and seals it again: damage that only the reader's own checks can find.
template <class Change>
void change(const fs::path& path, Change&& with) {
  {
    const Hdf5Session session;
    const Hdf5Id file(H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose);
    REQUIRE(file.ok());
    with(static_cast<hid_t>(file));
  }
  reseal(path);
}

TEST_CASE("a sealed show that lacks a dataset, or has another in its place, is refused by the dataset's name") {
  const sample::Folder folder;
  const fs::path whole = folder / "whole.h5";
  const fs::path path = folder / "changed.h5";
  write_show(whole, sample::header(2, 20, 10, 1));
  for (const std::string name : {"/project",
                                 "/asset",
                                 "/projector/0/images",
                                 "/projector/0/image/eye",
                                 "/projector/0/image/kind",
                                 "/projector/0/image/power_d",
                                 "/projector/0/image/slice",
                                 "/projector/0/slot/image",
                                 "/projector/0/slot/eye",
                                 "/projector/0/slot/start_s",
                                 "/projector/0/slot/exposure_s",
                                 "/projector/0/slot/trigger_s",
                                 "/projector/0/slot/power_d",
                                 "/projector/0/slot/smear_d",
                                 "/lens/power_d",
                                 "/lens/drive_a",
                                 "/shutter/left_s",
                                 "/shutter/right_s",
                                 "/pose/viewer",
                                 "/pose/surfaces",
                                 "/pose/objects",
                                 "/cue/name",
                                 "/cue/frame",
                                 "/measure/lit_pixels",
                                 "/measure/object_worst_beyond_d"}) {
    CAPTURE(name);
    for (const bool replaced : {false, true}) {
      fs::copy_file(whole, path, fs::copy_options::overwrite_existing);
      change(path, [&](hid_t file) {
        REQUIRE(H5Ldelete(file, name.c_str(), H5P_DEFAULT) >= 0);
        if (!replaced) return;
        // A huge one that is not stored: nothing may allocate what it claims.
        const hsize_t shape[] = {std::uint64_t{1} << 40, 7};
        const Hdf5Id space(H5Screate_simple(2, shape, nullptr), H5Sclose);
        const Hdf5Id dataset(
            H5Dcreate2(file, name.c_str(), H5T_IEEE_F64LE, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Dclose);
        REQUIRE(dataset.ok());
      });
      const Result<ShowReader> show = ShowReader::open(path);
      REQUIRE_FALSE(show.ok());
      CHECK(show.fault().code == "show.invalid");
      CHECK(show.fault().where == path.string() + ": " + name);
    }
  }
}

TEST_CASE("a sealed show with a wrong value in it is refused") {
  const sample::Folder folder;
  const fs::path path = folder / "changed.h5";
  write_show(path, sample::header(2, 20, 10, 1));
  std::string name;
  std::vector<double> numbers;
  std::vector<std::int32_t> integers;
  SUBCASE("NaN") { name = "/projector/0/slot/start_s", numbers = {NAN, 1, 2, 3, 4}; }
  SUBCASE("order") { name = "/projector/0/slot/start_s", numbers = {4, 3, 2, 1, 0}; }
  SUBCASE("exposure") { name = "/projector/0/slot/exposure_s", numbers = {0, 0, 0, 0, 0}; }
  SUBCASE("shutter") { name = "/shutter/left_s", numbers = {0, INFINITY}; }
  SUBCASE("image") { name = "/projector/0/slot/image", integers = {0, 1, 2, 3, 5}; }
  SUBCASE("negative image") { name = "/projector/0/slot/image", integers = {0, 1, 2, 3, -1}; }
  SUBCASE("cue") { name = "/cue/frame", integers = {0, 2}; }
  change(path, [&](hid_t file) {
    const Hdf5Id dataset(H5Dopen2(file, name.c_str(), H5P_DEFAULT), H5Dclose);
    const void* data = numbers.empty() ? static_cast<const void*>(integers.data()) : numbers.data();
    const hid_t type = numbers.empty() ? H5T_NATIVE_INT32 : H5T_NATIVE_DOUBLE;
    REQUIRE(H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data) >= 0);
  });
  const Result<ShowReader> show = ShowReader::open(path);
  REQUIRE_FALSE(show.ok());
  CHECK(show.fault().code == "show.invalid");
  CHECK(show.fault().where == path.string() + ": " + name);
}

TEST_CASE("a damaged chunk behind a right seal is a fault of its frame") {
  const sample::Folder folder;
  const fs::path path = folder / "chunk.h5";
  const ShowHeader header = sample::header(2, 20, 10, 1);
  write_show(path, header);
  change(path, [&](hid_t file) {
    const Hdf5Id dataset(H5Dopen2(file, "/projector/0/images", H5P_DEFAULT), H5Dclose);
    const hsize_t offset[] = {1, 0, 0, 0};
    const std::string garbage = "no zlib stream";
    REQUIRE(H5Dwrite_chunk(dataset, H5P_DEFAULT, 0, offset, garbage.size(), garbage.data()) >= 0);
  });
  const Result<ShowReader> show = ShowReader::open(path);
  REQUIRE(show.ok());
  CHECK(show->frame(0)->codes == sample::images(header, 0).codes);
  CHECK(show->frame(1).fault().code == "show.damaged");
  CHECK(show->image(1, 1).ok());
}

}  // namespace
}  // namespace focalstage
