#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "core/base/result.h"
#include "devices/runtime/live_thread.h"

namespace focalstage {

/// The blobs of a live link on their way, chunk after chunk.
class LiveArrivals {
 public:
  /// From now on its chunks are taken, from the first on. "rig.request".
  Status expect(const std::string& sha256, std::uint64_t size_bytes);

  /// The blob once it is whole; chunks of one that nobody waits for any more are passed over. "rig.request".
  Result<std::optional<LiveBlob>> add(const std::string& sha256, std::uint64_t offset_bytes, std::string_view data);

 private:
  struct Arrival {
    std::uint64_t size_bytes = 0;
    std::string bytes;
  };
  std::map<std::string, Arrival> arriving_;
};

}  // namespace focalstage
