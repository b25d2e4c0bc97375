#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace focalstage {

/// Reads little-endian values from bytes and never past their end: what is not there reads as zero, and `ok` is false
/// from then on.
class ByteReader {
 public:
  explicit ByteReader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  bool ok() const { return ok_; }
  std::size_t at() const { return at_; }
  std::size_t left() const { return bytes_.size() - at_; }
  void fail() { ok_ = false; }

  void skip(std::size_t count) {
    if (take(count)) at_ += count;
  }

  /// `each * count` bytes, whatever that product is.
  void skip_each(std::size_t count, std::size_t each) {
    if (each != 0 && count > left() / each) return fail();
    skip(count * each);
  }

  std::uint8_t u8() { return static_cast<std::uint8_t>(little_endian(1)); }
  std::uint16_t u16() { return static_cast<std::uint16_t>(little_endian(2)); }
  std::uint32_t u32() { return static_cast<std::uint32_t>(little_endian(4)); }
  std::uint64_t u64() { return little_endian(8); }
  std::int32_t i32() { return static_cast<std::int32_t>(u32()); }
  float f32() { return std::bit_cast<float>(u32()); }
  double f64() { return std::bit_cast<double>(u64()); }

  /// A count or size: never negative, and no more than the bytes left can hold at `least` bytes each.
  std::size_t count(std::size_t least) {
    const std::int32_t n = i32();
    if (n >= 0 && static_cast<std::size_t>(n) <= left() / least) return static_cast<std::size_t>(n);
    fail();
    return 0;
  }

  /// Text up to its NUL.
  std::string text() {
    const auto rest = bytes_.subspan(at_);
    const auto end = std::find(rest.begin(), rest.end(), std::uint8_t{0});
    if (!ok_ || end == rest.end()) {
      fail();
      return {};
    }
    at_ += static_cast<std::size_t>(end - rest.begin()) + 1;
    return {rest.begin(), end};
  }

 private:
  bool take(std::size_t count) {
    if (count > left()) ok_ = false;
    return ok_;
  }

  std::uint64_t little_endian(std::size_t size) {
    if (!take(size)) return 0;
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < size; ++i) value |= std::uint64_t{bytes_[at_ + i]} << (8 * i);
    at_ += size;
    return value;
  }

  std::span<const std::uint8_t> bytes_;
  std::size_t at_ = 0;
  bool ok_ = true;
};

}  // namespace focalstage
