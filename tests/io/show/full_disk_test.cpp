#include <doctest/doctest.h>
#include <sys/mount.h>
#include <sys/resource.h>

#include <cerrno>
#include <csignal>
#include <filesystem>
#include <string>
#include <vector>

#include "io/show/reader.h"
#include "io/show/writer.h"
#include "tests/io/show/child.h"
#include "tests/io/show/sample.h"

namespace focalstage {
namespace {

namespace fs = std::filesystem;

constexpr int frames = 8;

/// A file system of `kib` KiB, unmounted with the value.
class SmallDisk {
 public:
  SmallDisk(const fs::path& where, int kib) : where_(where) {
    fs::create_directory(where);
    mounted_ = ::mount("none", where.c_str(), "tmpfs", 0, size(kib).c_str()) == 0;
  }
  ~SmallDisk() {
    if (mounted_) ::umount2(where_.c_str(), MNT_DETACH);
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;

  bool mounted() const { return mounted_; }
  bool grow(int kib) const { return ::mount("none", where_.c_str(), "tmpfs", MS_REMOUNT, size(kib).c_str()) == 0; }

 private:
  static std::string size(int kib) { return "size=" + std::to_string(kib) + "k"; }

  fs::path where_;
  bool mounted_ = false;
};

enum class Stopped { at_start, at_frame, at_finish, done };

/// One run until it is done or the disk is full, which must be said as such.
Stopped run(const fs::path& path, const ShowHeader& header) {
  Result<ShowWriter> writer = ShowWriter::start(path, header, true, 1);
  const auto full = [&](const Fault& fault, Stopped where) {
    CHECK(fault.code == "show.disk-full");
    CHECK(fault.where.rfind(path.string(), 0) == 0);
    CHECK(fault.remedy != "");
    CHECK_FALSE(fs::exists(path));
    CHECK_FALSE(fs::exists(path.string() + ".tmp"));
    return where;
  };
  if (!writer) return full(writer.fault(), Stopped::at_start);
  for (int k = 0; k < frames; ++k) {
    if (writer->has_frame(k)) continue;
    const Status added = writer->add_frame(k, sample::images(header, k), sample::measure(k));
    if (!added) return full(added.fault(), Stopped::at_frame);
  }
  const Status finished = writer->finish();
  return finished ? Stopped::done : full(finished.fault(), Stopped::at_finish);
}

std::string expected_bytes(const sample::Folder& folder, const ShowHeader& header) {
  REQUIRE(run(folder / "whole.h5", header) == Stopped::done);
  return sample::bytes_of(folder / "whole.h5");
}

TEST_CASE("a full disk stops a compile, loses nothing, and more room ends it in the same bytes") {
  const sample::Folder folder;
  const ShowHeader header = sample::header(frames, 300, 130, 1);
  const std::string bytes = expected_bytes(folder, header);
  int kib = 4;
  const SmallDisk disk(folder / "disk", kib);
  if (!disk.mounted()) {
    MESSAGE("no right to mount a tmpfs: the limit on file size below stands in for it");
    return;
  }
  std::vector<int> times(4, 0);
  for (; times[static_cast<int>(Stopped::done)] == 0; kib += 36) {
    REQUIRE(kib < 16 * 1024);
    REQUIRE(disk.grow(kib));
    ++times[static_cast<int>(run(folder / "disk/a.h5", header))];
  }
  CHECK(times[static_cast<int>(Stopped::at_frame)] > 0);
  CHECK(times[static_cast<int>(Stopped::at_finish)] > 0);
  CHECK(sample::bytes_of(folder / "disk/a.h5") == bytes);
}

TEST_CASE("a file that may grow no further stops a compile the same way") {
  const sample::Folder folder;
  const ShowHeader header = sample::header(frames, 300, 130, 1);
  const std::string bytes = expected_bytes(folder, header);
  rlimit before{};
  REQUIRE(::getrlimit(RLIMIT_FSIZE, &before) == 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  int stops = 0;
  Stopped stopped = Stopped::at_start;
  for (rlim_t limit = 50; stopped != Stopped::done; limit += 12000) {
    REQUIRE(limit < bytes.size() * 20);
    const rlimit tight{limit, before.rlim_max};
    REQUIRE(::setrlimit(RLIMIT_FSIZE, &tight) == 0);
    stopped = run(folder / "a.h5", header);
    if (stopped != Stopped::done) ++stops;
  }
  ::setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  CHECK(stops > 3);
  CHECK(sample::bytes_of(folder / "a.h5") == bytes);
}

TEST_CASE("a place that cannot be written says so") {
  const sample::Folder folder;
  const ShowHeader header = sample::header(1, 20, 10, 1);
  CHECK(ShowWriter::start(folder / "no/such/a.h5", header, false, 1).fault().code == "show.unwritable");
  fs::create_directory(folder / "taken.h5");
  CHECK(ShowWriter::start(folder / "taken.h5", header, false, 1).fault().code == "show.unwritable");
  sample::put(folder / "b.h5.part", "a file where the part belongs");
  CHECK(ShowWriter::start(folder / "b.h5", header, false, 1).fault().code == "show.unwritable");
  CHECK(sample::bytes_of(folder / "b.h5.part") == "a file where the part belongs");
}

}  // namespace
}  // namespace focalstage
