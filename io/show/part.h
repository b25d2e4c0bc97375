#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "core/base/result.h"
#include "core/compile/frame.h"
#include "io/files/digest.h"
#include "io/show/chunks.h"
#include "io/show/disk.h"

namespace focalstage {

inline constexpr std::uint32_t part_version = 3;

/// Whose frames a part holds, and how many of what.
struct PartKey {
  Sha256Value project{};      ///< of the project's text
  Sha256Value fingerprint{};  ///< of the whole header (fingerprint.h)
  std::size_t frames = 0;
  std::size_t chunks_per_frame = 0;
  std::size_t chunk_bytes = 0;
  std::size_t objects = 0;
  std::size_t surfaces = 0;
};

/// The append-only log of finished frames of one projector in `SHOW.h5.part/`. One record per frame:
///
///   u32 "FRAM", u32 frame, u64 body bytes, u32 CRC-32 of the body, u32 CRC-32 of these first 20 bytes
///   body: what was measured; u32 size of every chunk; the chunks
///
/// behind a preamble with the key. A record counts only whole, with both sums right; what follows the last whole one is
/// cut off. Numbers are little-endian.
class PartLog {
 public:
  /// Opens or makes the log in `folder` and holds it against other writers ("show.busy"). With `resume`, keeps the
  /// frames of a log with the same key; anything else is started over.
  /// Each projector of a show has a log of its own.
  static Result<PartLog> open(const std::filesystem::path& folder, const PartKey& key, bool resume,
                              std::size_t projector = 0);

  bool has(std::size_t frame) const { return records_[frame].bytes != 0; }
  const std::vector<FrameMeasure>& measures() const { return measures_; }
  std::uint64_t bytes() const { return end_; }

  Status append(std::size_t frame, const FrameMeasure& measure, const PackedFrame& packed);
  Result<PackedFrame> read(std::size_t frame) const;
  Status sync();

  /// Deletes the log and its folder; what else lies in the folder stays.
  void remove();

 private:
  struct Record {
    std::uint64_t at = 0;
    std::uint64_t bytes = 0;  ///< 0: not there
  };

  PartLog() = default;
  bool preamble_fits() const;
  void take_over();
  bool take_record();
  Status start_over();
  Fault failed(int error);

  std::filesystem::path folder_;
  std::filesystem::path path_;
  PartKey key_;
  DiskFile file_;
  std::uint64_t end_ = 0;
  std::vector<Record> records_;
  std::vector<FrameMeasure> measures_;
  std::chrono::steady_clock::time_point synced_{};
};

}  // namespace focalstage
