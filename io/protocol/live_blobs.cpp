#include "io/protocol/live_blobs.h"

#include <algorithm>
#include <utility>

#include "io/protocol/limits.h"

namespace focalstage {

void LiveBlobs::offer(const std::string& sha256, SharedBytes bytes) {
  offered_.insert_or_assign(sha256, std::move(bytes));
}

void LiveBlobs::withdraw(const std::string& sha256) {
  if (!asked_.empty() && asked_.front() == sha256) sent_bytes_ = 0;
  std::erase(asked_, sha256);
  offered_.erase(sha256);
}

void LiveBlobs::ask(const std::string& sha256) {
  const bool known = offered_.contains(sha256);
  if (known && std::ranges::find(asked_, sha256) == asked_.end()) asked_.push_back(sha256);
}

v1::LiveChunk LiveBlobs::next_chunk() {
  v1::LiveChunk chunk;
  const SharedBytes& bytes = offered_.at(asked_.front());
  const std::size_t length = std::min(push_chunk_bytes, bytes.size() - sent_bytes_);
  chunk.set_sha256(asked_.front());
  chunk.set_offset_bytes(sent_bytes_);
  chunk.set_data(reinterpret_cast<const char*>(bytes.data()) + sent_bytes_, length);
  sent_bytes_ += length;
  if (sent_bytes_ >= bytes.size()) {
    asked_.pop_front();
    sent_bytes_ = 0;
  }
  return chunk;
}

}  // namespace focalstage
