#include <doctest/doctest.h>
#include <fcntl.h>
#include <hdf5.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <random>
#include <string>
#include <type_traits>
#include <vector>

#include "io/files/digest.h"
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

/// What `path` is refused for.
std::string message(const fs::path& path) {
  const Result<ShowReader> show = ShowReader::open(path);
  return show.ok() ? "" : show.fault().message;
}

TEST_CASE("damage is named by the chunk it lies in") {
  const sample::Folder folder;
  const fs::path path = folder / "long.h5";
  ShowHeader header = sample::header(1, 20, 10, 1);
  // An asset of 2.5 MiB that nothing compresses: the show has three chunks of a MiB, the last not full.
  std::mt19937_64 random(1);
  AssetFile asset;
  asset.path = "noise";
  std::vector<std::byte> bytes(5 << 19);
  for (auto& byte : bytes) byte = static_cast<std::byte>(random());
  asset.bytes = std::move(bytes);
  asset.sha256 = hex(sha256_of(asset.bytes));
  header.assets.push_back(asset);
  write_show(path, header);
  const std::uint64_t length = fs::file_size(path);
  REQUIRE(length > (5 << 19));
  REQUIRE(length < (3 << 20));
  REQUIRE(message(path) == "");
  const DiskFile file = open_file(path, O_RDWR);
  const auto with_a_bit_flipped = [&](std::uint64_t at) {
    std::byte byte[1];
    REQUIRE(file.read_at(at, byte));
    byte[0] ^= std::byte{4};
    REQUIRE(file.write_at(at, byte));
    const std::string told = message(path);
    byte[0] ^= std::byte{4};
    REQUIRE(file.write_at(at, byte));
    return told;
  };
  constexpr std::uint64_t mib = 1 << 20;
  const std::string end = std::to_string(length - 3 * 32);  // the table has 32 bytes for each chunk
  CHECK(with_a_bit_flipped(511) == "its seal, the first 512 bytes, was changed");
  CHECK(with_a_bit_flipped(512) == "chunk 0 of 3 (bytes 512 to 1048576) was changed");
  CHECK(with_a_bit_flipped(mib - 1) == "chunk 0 of 3 (bytes 512 to 1048576) was changed");
  CHECK(with_a_bit_flipped(mib) == "chunk 1 of 3 (bytes 1048576 to 2097152) was changed");
  CHECK(with_a_bit_flipped(length - 3 * 32 - 1) == "chunk 2 of 3 (bytes 2097152 to " + end + ") was changed");
  CHECK(with_a_bit_flipped(length - 3 * 32) ==
        "its last 96 bytes, the hashes of its chunks, are not those that its seal names");
  CHECK(with_a_bit_flipped(length - 1).find("its last 96 bytes") == 0);
  REQUIRE(::truncate(path.c_str(), 1500000) == 0);
  CHECK(message(path) == "it has 1500000 bytes, its seal says " + std::to_string(length));
}

TEST_CASE("a show of any length around a chunk's end can be sealed and checked") {
  const sample::Folder folder;
  const fs::path path = folder / "bytes";
  for (const std::uint64_t chunks : {1, 2, 3}) {
    for (const int off : {-33, -32, -31, -1, 0, 1, 31, 32, 33}) {
      const std::uint64_t length = (chunks << 20) + static_cast<std::uint64_t>(off);
      CAPTURE(length);
      fs::remove(path);
      const DiskFile file = open_file(path, O_RDWR | O_CREAT);
      REQUIRE(::ftruncate(file.descriptor(), static_cast<off_t>(length)) == 0);
      REQUIRE(write_seal(file));
      CHECK(file.size() == length + 32 * (off > 0 ? chunks + 1 : chunks));
      CHECK(check_seal(path).ok());
      const std::byte more[1] = {};
      REQUIRE(file.write_at(length - 1, std::span(more)));
      CHECK(check_seal(path).ok());  // it was zero before
      const std::byte other[1] = {std::byte{1}};
      REQUIRE(file.write_at(length - 1, std::span(other)));
      CHECK_FALSE(check_seal(path).ok());
    }
  }
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
  bytes[16] = '3';
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
