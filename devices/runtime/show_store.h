#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "io/files/digest.h"

namespace focalstage {

struct UploadProgress {
  std::uint64_t received_bytes = 0;
  bool complete = false;
};

struct VerifiedShow {
  int frames = 0;
  int images = 0;  ///< of each frame
};

/// The shows that were pushed, by the hash of their bytes, and those on their way.
///
///     DIR/lock                 held by the runtime that uses the folder
///     DIR/partial/SHA.part     chunks as they came; checked again when a push goes on
///     DIR/shows/SHA.h5         whole and verified: a file gets this name only then, by a rename
class ShowStore {
 public:
  /// Makes the folder where it is missing. "store.in-use", "file.unwritable".
  static Result<std::unique_ptr<ShowStore>> open(const std::filesystem::path& folder);
  ~ShowStore();

  /// Says where to go on. "rig.request", "rig.disk-full".
  Result<UploadProgress> begin(const std::string& sha256, std::uint64_t size_bytes,
                               std::vector<Sha256Value> chunk_sha256);

  /// Takes one chunk. "rig.damaged" names it; "rig.request", "rig.disk-full".
  Result<UploadProgress> add(const std::string& sha256, std::uint64_t offset_bytes, std::string_view data);

  /// Checks the whole and gives it its name. "rig.damaged", "rig.request". What can't be a show is removed.
  Result<VerifiedShow> finish(const std::string& sha256);

  /// The file of a verified show; "rig.refused" where it is not here.
  Result<std::filesystem::path> find(const std::string& sha256) const;

 private:
  struct Upload {
    std::uint64_t size_bytes = 0;
    std::uint64_t received_bytes = 0;
    std::vector<Sha256Value> chunk_sha256;
  };

  ShowStore(std::filesystem::path folder, int lock) : folder_(std::move(folder)), lock_(lock) {}
  std::filesystem::path partial_path(const std::string& sha256) const;
  std::filesystem::path show_path(const std::string& sha256) const;
  std::uint64_t sound_bytes(const std::string& sha256, const Upload& upload) const;
  Result<VerifiedShow> check_whole(const std::filesystem::path& path, const std::string& sha256) const;
  Status check_space(const std::string& sha256, const Upload& upload) const;

  std::filesystem::path folder_;
  int lock_;
  std::mutex mutex_;
  std::map<std::string, Upload> uploads_;
};

}  // namespace focalstage
