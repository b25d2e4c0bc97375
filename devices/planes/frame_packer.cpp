#include "devices/planes/frame_packer.h"

#include <algorithm>
#include <string>

#include "devices/planes/blue_noise.h"
#include "devices/planes/plane_order.h"

namespace focalstage {

namespace {

constexpr int least_undithered_bits = 4;

int top_of(int bits) { return (1 << bits) - 1; }

Fault plan_fault(const std::string& what, const std::string& remedy) {
  return {"planes.plan", "video frame", what, remedy};
}

/// `code` of `top` as 256ths of a level of `levels`; that of `top - code` is exactly what is left.
int fine_level(int code, int top, int levels) { return (2 * code * levels * 256 + top) / (2 * top); }

/// The least code that reaches `level` with the help of a threshold; the top always does.
int least_code(int level, int threshold, int top, int levels) {
  for (int code = 0; code <= top; ++code) {
    if ((fine_level(code, top, levels) + threshold) / 256 >= level) return code;
  }
  return top;
}

void split_channels(const std::uint8_t* codes, std::size_t count, std::array<std::vector<std::uint8_t>, 3>& rows) {
  std::uint8_t* __restrict red = rows[0].data();
  std::uint8_t* __restrict green = rows[1].data();
  std::uint8_t* __restrict blue = rows[2].data();
  for (std::size_t x = 0; x < count; ++x) {
    red[x] = codes[3 * x];
    green[x] = codes[3 * x + 1];
    blue[x] = codes[3 * x + 2];
  }
}

void or_bits(std::uint8_t* to, const std::uint8_t* levels, std::size_t count, int shift) {
  if (shift >= 0) {
    for (std::size_t x = 0; x < count; ++x) to[x] = static_cast<std::uint8_t>(to[x] | levels[x] << shift);
  } else {
    for (std::size_t x = 0; x < count; ++x) to[x] = static_cast<std::uint8_t>(to[x] | levels[x] >> -shift);
  }
}

}  // namespace

Result<FramePacker> FramePacker::make(const PackPlan& plan) {
  if (plan.width_px < 1 || plan.height_px < 1 || plan.width_px > 8192 || plan.height_px > 8192) {
    return plan_fault("a frame of " + std::to_string(plan.width_px) + " x " + std::to_string(plan.height_px) +
                          " pixels cannot be packed",
                      "give both sizes in 1..8192");
  }
  if (plan.bits < 1 || plan.code_bits > 8 || plan.bits > plan.code_bits) {
    return plan_fault(
        "codes of " + std::to_string(plan.code_bits) + " bits cannot be shown with " + std::to_string(plan.bits),
        "give 1..8 bits, the patterns at most as many as the codes");
  }
  if ((plan.channels != 1 && plan.channels != 3) || plan.pictures < 0) {
    return plan_fault("pictures need one channel or three", "send gray or rgb pictures");
  }
  if (plan.pictures > 24 || plan.patterns() > most_patterns(plan.bits)) {
    return plan_fault(std::to_string(plan.pictures) + " pictures of " + std::to_string(plan.channels) +
                          " channels at " + std::to_string(plan.bits) + " bits need more than the " +
                          std::to_string(most_patterns(plan.bits)) + " patterns of a frame",
                      "show fewer pictures in a period or fewer bits");
  }
  return FramePacker(plan);
}

FramePacker::FramePacker(const PackPlan& plan)
    : plan_(plan), dithered_(plan.bits < plan.code_bits && plan.bits < least_undithered_bits) {
  const auto width = static_cast<std::size_t>(plan.width_px);
  for (auto* row : {&levels_, &green_, &red_, &blue_}) row->assign(width, 0);
  channel_rows_.fill(levels_);
  if (dithered_) {
    make_thresholds();
  } else {
    make_levels();
  }
}

void FramePacker::make_levels() {
  const int top = top_of(plan_.code_bits);
  const int levels = top_of(plan_.bits);
  for (int code = 0; code < 256; ++code) {
    level_of_[static_cast<std::size_t>(code)] =
        static_cast<std::uint8_t>((2 * std::min(code, top) * levels + top) / (2 * top));
  }
}

void FramePacker::make_thresholds() {
  const auto levels = static_cast<std::size_t>(top_of(plan_.bits));
  std::vector<std::uint8_t> least(256 * levels);
  for (std::size_t threshold = 0; threshold < 256; ++threshold) {
    for (std::size_t k = 0; k < levels; ++k) {
      least[threshold * levels + k] = static_cast<std::uint8_t>(least_code(
          static_cast<int>(k) + 1, static_cast<int>(threshold), top_of(plan_.code_bits), static_cast<int>(levels)));
    }
  }
  const auto width = static_cast<std::size_t>(plan_.width_px);
  const BlueNoise& noise = blue_noise();
  threshold_rows_.resize(2 * BlueNoise::size * levels * width);
  std::uint8_t* out = threshold_rows_.data();
  for (std::size_t phase = 0; phase < 2; ++phase) {
    for (std::size_t row = 0; row < BlueNoise::size; ++row) {
      for (std::size_t k = 0; k < levels; ++k) {
        for (std::size_t x = 0; x < width; ++x) {
          const std::size_t mask = noise.thresholds[row * BlueNoise::size + x % BlueNoise::size];
          *out++ = least[(phase == 0 ? mask : 255 - mask) * levels + k];
        }
      }
    }
  }
}

Status FramePacker::pack(std::span<const std::span<const std::uint8_t>> pictures, std::span<std::uint32_t> pixels) {
  const auto width = static_cast<std::size_t>(plan_.width_px);
  const auto area = width * static_cast<std::size_t>(plan_.height_px);
  const auto size = area * static_cast<std::size_t>(plan_.channels);
  const bool sized = std::ranges::all_of(pictures, [&](const auto& picture) { return picture.size() == size; });
  if (pictures.size() != static_cast<std::size_t>(plan_.pictures) || !sized || pixels.size() != area) {
    return Fault{"planes.picture", "video frame",
                 std::to_string(plan_.pictures) + " pictures of " + std::to_string(size) +
                     " codes were agreed on, and others came",
                 "send the pictures that the projector was armed for"};
  }
  for (std::size_t y = 0; y < static_cast<std::size_t>(plan_.height_px); ++y) pack_row(pictures, y, &pixels[y * width]);
  return {};
}

void FramePacker::level_row(const std::uint8_t* codes, std::size_t y, int picture) {
  const std::size_t width = levels_.size();
  if (!dithered_) {
    for (std::size_t x = 0; x < width; ++x) levels_[x] = level_of_[codes[x]];
    return;
  }
  const auto levels = static_cast<std::size_t>(top_of(plan_.bits));
  const std::size_t phase = static_cast<std::size_t>(picture) % 2;
  const std::uint8_t* least = &threshold_rows_[(phase * BlueNoise::size + y % BlueNoise::size) * levels * width];
  std::uint8_t* out = levels_.data();
  for (std::size_t x = 0; x < width; ++x) out[x] = codes[x] >= least[x] ? 1 : 0;
  for (std::size_t k = 1; k < levels; ++k) {
    least += width;
    for (std::size_t x = 0; x < width; ++x) out[x] = static_cast<std::uint8_t>(out[x] + (codes[x] >= least[x] ? 1 : 0));
  }
}

void FramePacker::pack_row(std::span<const std::span<const std::uint8_t>> pictures, std::size_t y, std::uint32_t* out) {
  const std::size_t width = levels_.size();
  for (auto* row : {&green_, &red_, &blue_}) std::ranges::fill(*row, std::uint8_t{0});
  const std::array<std::uint8_t*, 3> bytes{green_.data(), red_.data(), blue_.data()};
  const auto channels = static_cast<std::size_t>(plan_.channels);
  for (int pattern = 0; pattern < plan_.patterns(); ++pattern) {
    const int picture = pattern / plan_.channels;
    const std::uint8_t* codes = &pictures[static_cast<std::size_t>(picture)][y * width * channels];
    if (channels == 3) {
      if (pattern % 3 == 0) split_channels(codes, width, channel_rows_);
      codes = channel_rows_[static_cast<std::size_t>(pattern % 3)].data();
    }
    level_row(codes, y, picture);
    const PlaneSpan planes = planes_of(plan_.bits, pattern);
    const auto byte = static_cast<std::size_t>(planes.first / 8);
    const int shift = planes.first % 8;
    or_bits(bytes[byte], levels_.data(), width, shift);
    if (shift + planes.count > 8) or_bits(bytes[byte + 1], levels_.data(), width, shift - 8);
  }
  for (std::size_t x = 0; x < width; ++x) {
    out[x] = static_cast<std::uint32_t>(red_[x]) << 16 | static_cast<std::uint32_t>(green_[x]) << 8 | blue_[x];
  }
}

}  // namespace focalstage
