#pragma once

#include <bit>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/base/result.h"

namespace focalstage {

enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

std::size_t size_of(PlyType type);
inline bool is_integer(PlyType type) { return type != PlyType::float32 && type != PlyType::float64; }

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::float32;
  std::optional<PlyType> count_type;  ///< of a list
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;
};

struct PlyHeader {
  enum class Format { ascii, binary_little, binary_big };

  Format format = Format::ascii;
  std::vector<PlyElement> elements;
  std::size_t size_bytes = 0;  ///< where the data begins
  std::size_t lines = 0;
};

/// The header up to and with `end_header`. `where` in faults is "path: line N".
Result<PlyHeader> read_ply_header(std::span<const std::byte> bytes, const std::string& path);

}  // namespace focalstage
