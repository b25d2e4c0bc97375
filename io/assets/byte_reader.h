#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>

namespace focalstage {

/// A number of type T from `bytes`, which hold at least that many, in the given order.
template <class T>
T number_at(const std::byte* bytes, std::endian order = std::endian::little) {
  std::byte raw[sizeof(T)];
  for (std::size_t i = 0; i < sizeof(T); ++i) {
    raw[i] = bytes[order == std::endian::native ? i : sizeof(T) - 1 - i];
  }
  T value;
  std::memcpy(&value, raw, sizeof(T));
  return value;
}

}  // namespace focalstage
