#pragma once

#include <filesystem>
#include <string>

#include <sys/mount.h>
#include <sys/resource.h>
#include <csignal>

#include "tests/support/temporary_folder.h"

namespace focalstage {

/// A folder in which no file can grow beyond about `bytes`: a file system of that size, or, where this process may not
/// mount one, a limit on the size of files, which fails the same write calls.
class SmallDisk {
 public:
  explicit SmallDisk(std::size_t bytes) {
    const std::string size = "size=" + std::to_string(bytes);
    mounted_ = ::mount("tmpfs", folder_.path().c_str(), "tmpfs", 0, size.c_str()) == 0;
    if (mounted_) return;
    MESSAGE("may not mount a small tmpfs here; a limit on the size of files stands in for the full disk");
    REQUIRE(::getrlimit(RLIMIT_FSIZE, &before_) == 0);
    on_signal_ = std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{bytes, before_.rlim_max};
    REQUIRE(::setrlimit(RLIMIT_FSIZE, &limit) == 0);
  }
  ~SmallDisk() {
    if (mounted_) {
      ::umount2(folder_.path().c_str(), MNT_DETACH);
    } else {
      ::setrlimit(RLIMIT_FSIZE, &before_);
      std::signal(SIGXFSZ, on_signal_);
    }
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;

  bool is_mounted() const { return mounted_; }
  std::filesystem::path operator/(const std::string& name) const { return folder_ / name; }
  const std::filesystem::path& path() const { return folder_.path(); }
  std::size_t count() const { return folder_.count(); }

 private:
  TemporaryFolder folder_;
  bool mounted_ = false;
  rlimit before_{};
  void (*on_signal_)(int) = nullptr;
};

}  // namespace focalstage
