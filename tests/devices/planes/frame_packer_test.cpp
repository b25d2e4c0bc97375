#include "devices/planes/frame_packer.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <utility>
#include <vector>

#include "devices/planes/plane_order.h"

namespace focalstage {
namespace {

using Codes = std::vector<std::uint8_t>;
using Pixels = std::vector<std::uint32_t>;

Pixels pack(const PackPlan& plan, const std::vector<Codes>& pictures) {
  auto packer = FramePacker::make(plan);
  REQUIRE(packer.ok());
  Pixels pixels(static_cast<std::size_t>(plan.width_px) * static_cast<std::size_t>(plan.height_px), 0xFFFFFFFFU);
  const std::vector<std::span<const std::uint8_t>> spans(pictures.begin(), pictures.end());
  const Status packed = packer->pack(spans, pixels);
  REQUIRE(packed.ok());
  return pixels;
}

/// What a pattern shows of a pixel, plane by plane.
int shown(std::uint32_t pixel, int bits, int pattern) {
  const PlaneSpan planes = planes_of(bits, pattern);
  return static_cast<int>(planes_in(pixel) >> planes.first & ((1U << planes.count) - 1U));
}

PackPlan plan_of(int width, int height, int pictures, int code_bits, int bits, int channels = 1) {
  return {width, height, pictures, channels, code_bits, bits};
}

TEST_CASE("golden frames") {
  // One pixel each; by hand from the published plane order.
  std::vector<Codes> one_bit(24, Codes{0});
  one_bit[3] = one_bit[8] = one_bit[23] = {1};
  CHECK(pack(plan_of(1, 1, 24, 1, 1), one_bit) == Pixels{0x010880});
  CHECK(pack(plan_of(1, 1, 12, 2, 2), std::vector<Codes>(12, Codes{2})) == Pixels{0xAAAAAA});
  CHECK(pack(plan_of(1, 1, 3, 3, 3), {{1}, {2}, {7}}) == Pixels{0x01D100});  // G0, G4, G6 G7 R0
  CHECK(pack(plan_of(1, 1, 6, 4, 4), {{0x1}, {0x2}, {0x3}, {0x4}, {0x5}, {0x6}}) == Pixels{0x432165});
  CHECK(pack(plan_of(1, 1, 2, 5, 5), {{31}, {31}}) == Pixels{0x0FBE00});  // G1-G5, G7 R0-R3
  CHECK(pack(plan_of(1, 1, 4, 6, 6), {{1}, {1}, {1}, {32}}) == Pixels{0x104180});
  CHECK(pack(plan_of(1, 1, 3, 7, 7), {{1}, {64}, {127}}) == Pixels{0x8002FE});
  CHECK(pack(plan_of(2, 1, 3, 8, 8), {{0x12, 0xFF}, {0x34, 0}, {0x56, 1}}) == Pixels{0x341256, 0x00FF01});
  CHECK(pack(plan_of(1, 1, 1, 8, 8, 3), {{0x12, 0x34, 0x56}}) == Pixels{0x341256});
  CHECK(pack(plan_of(1, 1, 0, 8, 8), {}) == Pixels{0});
}

TEST_CASE("every picture is found again in its planes") {
  for (int bits = 1; bits <= 8; ++bits) {
    for (const int channels : {1, 3}) {
      CAPTURE(bits);
      CAPTURE(channels);
      const int pictures = most_patterns(bits) / channels;
      std::vector<Codes> sent(static_cast<std::size_t>(pictures));
      std::uint32_t state = 7;
      for (Codes& codes : sent) {
        codes.resize(static_cast<std::size_t>(37 * 5 * channels));
        for (auto& code : codes)
          code = static_cast<std::uint8_t>((state = state * 1664525U + 1013904223U) >> (32 - bits));
      }
      const Pixels pixels = pack(plan_of(37, 5, pictures, bits, bits, channels), sent);
      bool same = true;
      for (int pattern = 0; pattern < pictures * channels; ++pattern) {
        const Codes& codes = sent[static_cast<std::size_t>(pattern / channels)];
        for (std::size_t i = 0; i < pixels.size(); ++i) {
          same &= shown(pixels[i], bits, pattern) ==
                  codes[i * static_cast<std::size_t>(channels) + static_cast<std::size_t>(pattern % channels)];
        }
      }
      CHECK(same);
    }
  }
}

TEST_CASE("four bits and more are rounded to the nearest level") {
  Codes ramp(256);
  for (std::size_t i = 0; i < 256; ++i) ramp[i] = static_cast<std::uint8_t>(i);
  for (int bits = 4; bits <= 7; ++bits) {
    const Pixels pixels = pack(plan_of(256, 1, 1, 8, bits), {ramp});
    for (int code = 0; code < 256; ++code) {
      const double wanted = code / 255.0 * ((1 << bits) - 1);
      CHECK(std::abs(shown(pixels[static_cast<std::size_t>(code)], bits, 0) - wanted) <= 0.5);
    }
  }
}

TEST_CASE("under four bits the mean of each neighbourhood is kept") {
  const int width = 256;
  const int height = 192;
  for (int bits = 1; bits <= 3; ++bits) {
    CAPTURE(bits);
    const int top = (1 << bits) - 1;
    double worst_flat = 0.0;
    for (const int code : {0, 1, 30, 77, 128, 200, 254, 255}) {
      const Pixels pixels =
          pack(plan_of(width, height, 1, 8, bits), {Codes(width * height, static_cast<std::uint8_t>(code))});
      // Windows of 16 x 16 at any place.
      for (int y0 = 0; y0 + 16 <= height; y0 += 7) {
        for (int x0 = 0; x0 + 16 <= width; x0 += 7) {
          double sum = 0.0;
          for (int i = 0; i < 256; ++i) {
            sum += shown(pixels[static_cast<std::size_t>((y0 + i / 16) * width + x0 + i % 16)], bits, 0);
          }
          worst_flat = std::max(worst_flat, std::abs(sum / 256.0 / top - code / 255.0));
        }
      }
      if (code == 0) CHECK(std::ranges::all_of(pixels, [](std::uint32_t p) { return p == 0; }));
      if (code == 255) CHECK(std::ranges::all_of(pixels, [&](std::uint32_t p) { return shown(p, bits, 0) == top; }));
    }
    MESSAGE(bits << " bits: worst mean error of a flat 16 x 16 window " << worst_flat);
    CHECK(worst_flat < 0.025);  // dots thrown at random: 0.1
    Codes ramp(width * height);
    for (int i = 0; i < width * height; ++i) ramp[static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(i % width);
    const Pixels pixels = pack(plan_of(width, height, 1, 8, bits), {ramp});
    double error = 0.0;
    for (std::size_t i = 0; i < ramp.size(); ++i) error += shown(pixels[i], bits, 0) / double(top) - ramp[i] / 255.0;
    CHECK(std::abs(error / double(ramp.size())) < 1e-3);
  }
}

TEST_CASE("weights of two slices that add up to white do so in every pixel") {
  for (int bits = 1; bits <= 3; ++bits) {
    std::vector<Codes> pictures(2, Codes(256 * 64));
    for (std::size_t i = 0; i < pictures[0].size(); ++i) {
      pictures[0][i] = static_cast<std::uint8_t>((i * 131 + i / 256) % 256);
      pictures[1][i] = static_cast<std::uint8_t>(255 - pictures[0][i]);
    }
    const Pixels pixels = pack(plan_of(256, 64, 2, 8, bits), pictures);
    CHECK(std::ranges::all_of(
        pixels, [&](std::uint32_t pixel) { return shown(pixel, bits, 0) + shown(pixel, bits, 1) == (1 << bits) - 1; }));
  }
}

TEST_CASE("bad plans and pictures are refused") {
  CHECK_FALSE(FramePacker::make(plan_of(0, 4, 1, 8, 8)).ok());
  CHECK_FALSE(FramePacker::make(plan_of(4, 4, 1, 9, 8)).ok());
  CHECK_FALSE(FramePacker::make(plan_of(4, 4, 1, 8, 0)).ok());
  CHECK_FALSE(FramePacker::make(plan_of(4, 4, 1, 4, 8)).ok());
  CHECK_FALSE(FramePacker::make(plan_of(4, 4, 4, 8, 8)).ok());
  CHECK_FALSE(FramePacker::make(plan_of(4, 4, 2, 8, 8, 3)).ok());
  CHECK_FALSE(FramePacker::make(plan_of(4, 4, 1, 8, 8, 2)).ok());
  const auto full = FramePacker::make(plan_of(4, 4, 25, 8, 1));
  REQUIRE_FALSE(full.ok());
  CHECK(full.fault().code == "planes.plan");

  auto packer = FramePacker::make(plan_of(4, 4, 1, 8, 8));
  REQUIRE(packer.ok());
  Pixels pixels(16);
  const Codes small(15);
  const std::vector<std::span<const std::uint8_t>> wrong{small};
  CHECK(packer->pack(wrong, pixels).fault().code == "planes.picture");
  CHECK(packer->pack({}, pixels).fault().code == "planes.picture");
}

/// Time that this thread had a core for.
double core_ms() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

TEST_CASE("a 4500's frame is packed in a fraction of a period") {
  for (const auto& [bits, channels] : {std::pair{1, 1}, {1, 3}, {2, 1}, {3, 1}, {4, 1}, {8, 1}}) {
    const int pictures = most_patterns(bits) / channels;
    const PackPlan plan = plan_of(912, 1140, pictures, 8, bits, channels);
    auto packer = FramePacker::make(plan);
    REQUIRE(packer.ok());
    std::vector<Codes> sent(static_cast<std::size_t>(pictures),
                            Codes(static_cast<std::size_t>(912 * 1140 * channels), std::uint8_t{99}));
    const std::vector<std::span<const std::uint8_t>> spans(sent.begin(), sent.end());
    Pixels pixels(912 * 1140);
    double best_ms = 1e9;
    for (int round = 0; round < 5; ++round) {
      const double begun_ms = core_ms();
      REQUIRE(packer->pack(spans, pixels).ok());
      best_ms = std::min(best_ms, core_ms() - begun_ms);
    }
    MESSAGE(pictures << " pictures of " << channels << " channels at " << bits << " bits: " << best_ms << " ms");
#ifdef NDEBUG
    CHECK(best_ms < 16.0);
#endif
  }
}

}  // namespace
}  // namespace focalstage
