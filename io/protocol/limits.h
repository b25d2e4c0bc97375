#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>

namespace focalstage {

/// The pieces in which a show travels.
inline constexpr std::size_t push_chunk_bytes = std::size_t{1} << 20;

/// No message may be larger: a chunk and what goes with it, or the hashes of the longest show's chunks.
inline constexpr int message_limit_bytes = 2 << 20;

/// The longest show: its chunks' hashes (34 bytes each on the wire) fit into one message.
inline constexpr std::uint64_t show_limit_bytes = std::uint64_t{48} << 30;

/// The live link: an editor is heard of at least so often, and so is the rig.
inline constexpr std::chrono::milliseconds live_keepalive{40};
inline constexpr std::chrono::milliseconds live_state_interval{100};

/// A rig that says nothing for so long is gone.
inline constexpr std::chrono::milliseconds live_rig_silence{800};

/// The largest project text or asset that travels by hash.
inline constexpr std::uint64_t live_blob_limit_bytes = std::uint64_t{512} << 20;

constexpr std::uint64_t chunks_of(std::uint64_t size_bytes) {
  return (size_bytes + push_chunk_bytes - 1) / push_chunk_bytes;
}

/// gRPC writes to stderr what its callers hear anyway: keeps it silent.
void silence_grpc();

}  // namespace focalstage
