#pragma once

#include <cstddef>
#include <cstdint>

namespace focalstage {

/// The pieces in which a show travels.
inline constexpr std::size_t push_chunk_bytes = std::size_t{1} << 20;

/// No message may be larger: a chunk and what goes with it, or the hashes of the longest show's chunks.
inline constexpr int message_limit_bytes = 2 << 20;

/// The longest show: its chunks' hashes (34 bytes each on the wire) fit into one message.
inline constexpr std::uint64_t show_limit_bytes = std::uint64_t{48} << 30;

constexpr std::uint64_t chunks_of(std::uint64_t size_bytes) {
  return (size_bytes + push_chunk_bytes - 1) / push_chunk_bytes;
}

/// gRPC writes to stderr what its callers hear anyway: keeps it silent.
void silence_grpc();

}  // namespace focalstage
