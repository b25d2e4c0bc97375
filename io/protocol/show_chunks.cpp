#include "io/protocol/show_chunks.h"

#include <algorithm>
#include <fstream>
#include <string_view>
#include <system_error>

#include "io/protocol/limits.h"

namespace focalstage {

namespace {

Fault unreadable(const std::filesystem::path& path, const std::string& why) {
  return {"file.unreadable", path.string(), why, "see that the file is there whole and may be read"};
}

}  // namespace

Result<ShowChunks> ShowChunks::open(const std::filesystem::path& path, const std::stop_token& stop) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) {
    return Fault{"file.missing", path.string(), "there is no such file", "name a show that was compiled"};
  }
  ShowChunks show;
  show.path_ = path;
  show.size_bytes_ = std::filesystem::file_size(path, error);
  if (error) return unreadable(path, error.message());
  if (show.size_bytes_ == 0) return unreadable(path, "the file is empty");
  if (show.size_bytes_ > show_limit_bytes) {
    return Fault{"file.too-large", path.string(), "a rig takes shows of up to 48 GiB", "compile fewer frames"};
  }
  Sha256 whole;
  for (std::uint64_t chunk = 0; chunk < chunks_of(show.size_bytes_); ++chunk) {
    if (stop.stop_requested()) return Fault{"rig.cancelled", path.string(), "the push was stopped", ""};
    const Result<std::string> data = show.read(chunk);
    if (!data) return data.fault();
    whole.add(*data);
    show.chunk_sha256_.push_back(sha256_of(std::string_view(*data)));
  }
  show.sha256_ = hex(whole.value());
  return show;
}

Result<std::string> ShowChunks::read(std::uint64_t chunk) const {
  const std::uint64_t from = chunk * push_chunk_bytes;
  std::string data(std::min<std::uint64_t>(push_chunk_bytes, size_bytes_ - from), '\0');
  std::ifstream file(path_, std::ios::binary);
  file.seekg(static_cast<std::streamoff>(from));
  file.read(data.data(), static_cast<std::streamsize>(data.size()));
  if (!file) return unreadable(path_, "it ends before byte " + std::to_string(from + data.size()));
  return data;
}

}  // namespace focalstage
