#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/result.h"

namespace focalstage {

/// What goes into each video frame.
struct PackPlan {
  int width_px = 0;
  int height_px = 0;
  int pictures = 1;
  int channels = 1;   ///< of each picture: 3 take three patterns, red, green, blue
  int code_bits = 8;  ///< of the codes, 1..8
  int bits = 8;       ///< of the patterns, at most as many

  int patterns() const { return pictures * channels; }
  bool operator==(const PackPlan&) const = default;
};

/// Packs the pictures of one period into the bit planes of a video frame: pattern k is picture k / channels, channel
/// k % channels. Codes deeper than the patterns are rounded to the nearest level or, where those have fewer than 4
/// bits, dithered, so that the mean over a neighbourhood is kept. Pictures dither by turns with the mask and its
/// negative: two codes of neighbours that add up to white add up to white in every pixel. One packer is for one thread
/// at a time.
class FramePacker {
 public:
  /// "planes.plan": depths, sizes or counts that do not fit a frame.
  static Result<FramePacker> make(const PackPlan& plan);

  const PackPlan& plan() const { return plan_; }

  /// `pictures`: the codes of each, rows from the top, channels interleaved, none above 2^code_bits - 1 (what is above
  /// counts as that). `pixels`: 0x00RRGGBB, rows from the top. "planes.picture": their number or sizes differ from the
  /// plan.
  Status pack(std::span<const std::span<const std::uint8_t>> pictures, std::span<std::uint32_t> pixels);

 private:
  explicit FramePacker(const PackPlan& plan);
  void make_levels();
  void make_thresholds();
  void pack_row(std::span<const std::span<const std::uint8_t>> pictures, std::size_t y, std::uint32_t* out);
  void level_row(const std::uint8_t* codes, std::size_t y, int picture);

  PackPlan plan_;
  bool dithered_ = false;
  std::array<std::uint8_t, 256> level_of_{};  ///< where not dithered
  /// Where dithered: least code of each level above 0, by phase (mask or its negative), mask row, level, pixel.
  std::vector<std::uint8_t> threshold_rows_;
  std::array<std::vector<std::uint8_t>, 3> channel_rows_;
  std::vector<std::uint8_t> levels_, green_, red_, blue_;
};

}  // namespace focalstage
