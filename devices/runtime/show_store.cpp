#include "devices/runtime/show_store.h"

#include <algorithm>
#include <cerrno>
#include <span>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include "devices/runtime/asset_store.h"
#include "devices/runtime/disk_file.h"
#include "io/files/files.h"
#include "io/protocol/limits.h"
#include "io/show/reader.h"

namespace focalstage {

namespace {

Fault bad_request(const std::string& where, const std::string& message) {
  return {"rig.request", where, message, "begin the push again"};
}

std::string chunk_name(std::uint64_t chunk, std::uint64_t count) {
  return "chunk " + std::to_string(chunk) + " of " + std::to_string(count) + " (bytes from " +
         std::to_string(chunk * push_chunk_bytes) + ")";
}

std::uint64_t chunk_length(std::uint64_t chunk, std::uint64_t size_bytes) {
  return std::min<std::uint64_t>(push_chunk_bytes, size_bytes - chunk * push_chunk_bytes);
}

}  // namespace

Result<std::unique_ptr<ShowStore>> ShowStore::open(const std::filesystem::path& folder) {
  std::error_code error;
  for (const char* name : {"partial", "shows"}) {
    std::filesystem::create_directories(folder / name, error);
    if (error) return disk_fault(folder / name, error.value());
  }
  const std::filesystem::path lock_path = folder / "lock";
  const int lock = ::open(lock_path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
  if (lock < 0) return disk_fault(lock_path, errno);
  if (::flock(lock, LOCK_EX | LOCK_NB) != 0) {
    ::close(lock);
    return Fault{"store.in-use", folder.string(), "another runtime uses this store",
                 "stop it, or give this one another --store"};
  }
  return std::unique_ptr<ShowStore>(new ShowStore(folder, lock));
}

ShowStore::~ShowStore() { ::close(lock_); }

std::filesystem::path ShowStore::partial_path(const std::string& sha256) const {
  return folder_ / "partial" / (sha256 + ".part");
}

std::filesystem::path ShowStore::show_path(const std::string& sha256) const {
  return folder_ / "shows" / (sha256 + ".h5");
}

/// How much of what lies on disk is as the client has it: a crash may have left a torn chunk, or anything.
std::uint64_t ShowStore::sound_bytes(const std::string& sha256, const Upload& upload) const {
  const Result<DiskSlot> file = DiskSlot::open(partial_path(sha256));
  if (!file) return 0;
  std::uint64_t sound = 0;
  for (std::size_t chunk = 0; chunk < upload.chunk_sha256.size(); ++chunk) {
    const std::uint64_t length = chunk_length(chunk, upload.size_bytes);
    if (sound + length > file->size_bytes()) break;
    if (sha256_of(std::string_view(file->read(sound, length))) != upload.chunk_sha256[chunk]) break;
    sound += length;
  }
  return sound;
}

Status ShowStore::check_space(const std::string& sha256, const Upload& upload) const {
  std::error_code error;
  const std::filesystem::space_info space = std::filesystem::space(folder_, error);
  if (error || space.available >= upload.size_bytes - upload.received_bytes) return {};
  return disk_fault(partial_path(sha256), ENOSPC);
}

Result<UploadProgress> ShowStore::begin(const std::string& sha256, std::uint64_t size_bytes,
                                        std::vector<Sha256Value> chunk_sha256) {
  if (!is_sha256_hex(sha256)) return bad_request("sha256", "it is not 64 lower-case hexadecimal digits");
  if (size_bytes == 0 || size_bytes > show_limit_bytes) return bad_request("size_bytes", "no show has this size");
  if (chunk_sha256.size() != chunks_of(size_bytes)) {
    return bad_request("chunk_sha256", "a show of this size has " + std::to_string(chunks_of(size_bytes)) + " chunks");
  }
  const std::lock_guard lock(mutex_);
  std::error_code error;
  if (std::filesystem::exists(show_path(sha256), error)) return UploadProgress{size_bytes, true};
  Upload upload{size_bytes, 0, std::move(chunk_sha256)};
  upload.received_bytes = sound_bytes(sha256, upload);
  if (Status space = check_space(sha256, upload); !space) return space.fault();
  Result<DiskSlot> file = DiskSlot::open(partial_path(sha256));
  if (!file) return file.fault();
  if (Status cut = file->truncate(upload.received_bytes); !cut) return cut.fault();
  const std::uint64_t received_bytes = upload.received_bytes;
  uploads_[sha256] = std::move(upload);
  return UploadProgress{received_bytes, false};
}

Result<UploadProgress> ShowStore::add(const std::string& sha256, std::uint64_t offset_bytes, std::string_view data) {
  const std::lock_guard lock(mutex_);
  const auto found = uploads_.find(sha256);
  if (found == uploads_.end()) return bad_request("sha256", "no push of this show was begun");
  Upload& upload = found->second;
  // A chunk that came before, or too early, changes nothing: the answer says where to go on.
  if (offset_bytes != upload.received_bytes) return UploadProgress{upload.received_bytes, false};
  if (upload.received_bytes == upload.size_bytes) return bad_request("offset_bytes", "the show is here whole");
  const std::uint64_t chunk = offset_bytes / push_chunk_bytes;
  const std::string where = chunk_name(chunk, upload.chunk_sha256.size());
  if (data.size() != chunk_length(chunk, upload.size_bytes)) return bad_request(where, "it has another length");
  if (sha256_of(data) != upload.chunk_sha256[chunk]) {
    return Fault{"rig.damaged", where, "its bytes are not those that were announced", "push the show again"};
  }
  Result<DiskSlot> file = DiskSlot::open(partial_path(sha256));
  if (!file) return file.fault();
  if (Status written = file->write(offset_bytes, data); !written) return written.fault();
  upload.received_bytes += data.size();
  return UploadProgress{upload.received_bytes, false};
}

Result<VerifiedShow> ShowStore::check_whole(const std::filesystem::path& path, const std::string& sha256) const {
  Result<DiskSlot> file = DiskSlot::open(path);
  if (!file) return file.fault();
  Sha256 whole;
  for (std::uint64_t offset = 0; offset < file->size_bytes(); offset += push_chunk_bytes) {
    whole.add(file->read(offset, push_chunk_bytes));
  }
  if (hex(whole.value()) != sha256) {
    return Fault{"rig.damaged", "show " + sha256, "the whole has another hash than was announced", "push it again"};
  }
  if (Status synced = file->sync(); !synced) return synced.fault();
  const Result<ShowReader> show = ShowReader::open(path);
  if (show) return VerifiedShow{show->header().frames, static_cast<int>(show->header().images.size())};
  return Fault{"rig.damaged", show.fault().where, show.fault().message, show.fault().remedy};
}

Result<VerifiedShow> ShowStore::finish(const std::string& sha256) {
  const std::lock_guard lock(mutex_);
  const auto found = uploads_.find(sha256);
  if (found == uploads_.end()) return bad_request("sha256", "no push of this show was begun");
  if (found->second.received_bytes != found->second.size_bytes) {
    const std::uint64_t chunk = found->second.received_bytes / push_chunk_bytes;
    return bad_request(chunk_name(chunk, found->second.chunk_sha256.size()), "it has not come yet");
  }
  const std::filesystem::path partial = partial_path(sha256);
  uploads_.erase(found);
  std::error_code error;
  const Result<VerifiedShow> whole = check_whole(partial, sha256);
  if (!whole) {
    if (whole.fault().code == "rig.damaged") std::filesystem::remove(partial, error);
    return whole;
  }
  std::filesystem::rename(partial, show_path(sha256), error);
  if (error) return disk_fault(show_path(sha256), error.value());
  if (Status synced = sync_folder(folder_ / "shows"); !synced) return synced.fault();
  return whole;
}

Result<std::filesystem::path> ShowStore::find(const std::string& sha256) const {
  std::error_code error;
  if (is_sha256_hex(sha256) && std::filesystem::exists(show_path(sha256), error)) return show_path(sha256);
  return Fault{"rig.refused", "show " + sha256, "it is not here", "push it first"};
}

}  // namespace focalstage
