#include "devices/runtime/live_arrivals.h"

#include <utility>

#include "devices/runtime/asset_store.h"
#include "io/protocol/limits.h"

namespace focalstage {

namespace {

Fault bad_blob(const std::string& sha256, const std::string& message) {
  return {"rig.request", "blob " + sha256.substr(0, 64), message, "begin the live link again"};
}

}  // namespace

Status LiveArrivals::expect(const std::string& sha256, std::uint64_t size_bytes) {
  if (!is_sha256_hex(sha256)) return bad_blob(sha256, "its name is not 64 lower-case hexadecimal digits");
  if (size_bytes > live_blob_limit_bytes) return bad_blob(sha256, "it is larger than any asset may be");
  arriving_[sha256] = {size_bytes, {}};
  return {};
}

Result<std::optional<LiveBlob>> LiveArrivals::add(const std::string& sha256, std::uint64_t offset_bytes,
                                                  std::string_view data) {
  const auto found = arriving_.find(sha256);
  if (found == arriving_.end()) return std::optional<LiveBlob>();
  Arrival& arrival = found->second;
  if (offset_bytes == 0) arrival.bytes.clear();
  const std::uint64_t lacking = arrival.size_bytes - arrival.bytes.size();
  if (offset_bytes != arrival.bytes.size() || data.size() > lacking) {
    return bad_blob(sha256, "its chunks do not follow each other");
  }
  arrival.bytes += data;
  if (arrival.bytes.size() < arrival.size_bytes) return std::optional<LiveBlob>();
  LiveBlob blob{sha256, std::move(arrival.bytes)};
  arriving_.erase(found);
  return std::optional<LiveBlob>(std::move(blob));
}

}  // namespace focalstage
