#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/compile/frame.h"
#include "io/show/part.h"

namespace focalstage {

/// The first 24 bytes of a record.
struct RecordHead {
  std::uint32_t magic = 0;
  std::uint32_t frame = 0;
  std::uint64_t body_bytes = 0;
  std::uint32_t body_crc = 0;
  std::uint32_t head_crc = 0;
};
static_assert(sizeof(RecordHead) == 24);

/// The first bytes of a log.
std::vector<std::byte> preamble_bytes(const PartKey& key);

/// A whole record, head and body.
std::vector<std::byte> record_bytes(std::size_t frame, const FrameMeasure& measure, const PackedFrame& packed,
                                    const PartKey& key);

/// The head in `bytes` if its sum is right and frame and size can be true of `key`.
std::optional<RecordHead> head_from(std::span<const std::byte> bytes, const PartKey& key);

struct RecordBody {
  FrameMeasure measure;
  PackedFrame packed;
};

/// The body of `head`, or nothing where its sum or its sizes are wrong.
std::optional<RecordBody> body_from(std::span<const std::byte> bytes, const RecordHead& head, const PartKey& key);

/// `measure` with one entry per object of the project, in its order, and one per surface.
FrameMeasure spread(const FrameMeasure& measure, std::size_t objects, std::size_t surfaces);

}  // namespace focalstage
