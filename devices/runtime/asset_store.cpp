#include "devices/runtime/asset_store.h"

#include <algorithm>
#include <cerrno>
#include <system_error>

#include "devices/runtime/disk_file.h"
#include "io/files/files.h"
#include "io/protocol/limits.h"

namespace focalstage {

bool is_sha256_hex(std::string_view text) {
  return text.size() == 64 &&
         std::ranges::all_of(text, [](char c) { return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f'); });
}

Result<std::unique_ptr<AssetStore>> AssetStore::open(const std::filesystem::path& folder) {
  const std::filesystem::path assets = folder / "assets";
  std::error_code error;
  std::filesystem::create_directories(assets, error);
  if (error) return disk_fault(assets, error.value());
  return std::unique_ptr<AssetStore>(new AssetStore(assets));
}

bool AssetStore::has(const std::string& sha256) const {
  std::error_code error;
  return is_sha256_hex(sha256) && std::filesystem::is_regular_file(path_of(sha256), error);
}

Result<std::vector<std::byte>> AssetStore::read(const std::string& sha256) const {
  const Fault gone{"live.asset", "asset " + sha256, "it is not here as it was sent", "begin the live link again"};
  if (!is_sha256_hex(sha256)) return gone;
  Result<std::vector<std::byte>> bytes = read_file(path_of(sha256), live_blob_limit_bytes);
  if (!bytes) return gone;
  if (sha256_hex(*bytes) == sha256) return bytes;
  std::error_code error;
  std::filesystem::remove(path_of(sha256), error);  // so that it is asked for again
  return gone;
}

Status AssetStore::add(const std::string& sha256, std::string_view bytes) {
  if (!is_sha256_hex(sha256) || sha256_hex(bytes) != sha256) {
    return Fault{"rig.damaged", "asset " + sha256, "its bytes are not those that were announced", "send it again"};
  }
  const Status written = write_file_atomically(path_of(sha256), bytes);
  if (written) return {};
  // The disk may be full or broken: which of the two decides what the editor is told.
  std::error_code error;
  const auto space = std::filesystem::space(folder_, error);
  if (!error && space.available < bytes.size()) return disk_fault(path_of(sha256), ENOSPC);
  return written;
}

}  // namespace focalstage
