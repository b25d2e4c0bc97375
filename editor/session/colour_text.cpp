#include "editor/session/colour_text.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>

#include <glm/common.hpp>

#include "editor/tools/srgb.h"

namespace focalstage {

std::string colour_text(const glm::dvec3& color) {
  const glm::ivec3 bytes(glm::round(srgb_from_linear(color) * 255.0));
  std::array<char, 16> text{};
  std::snprintf(text.data(), text.size(), "#%02x%02x%02x", static_cast<unsigned>(bytes.r) & 0xFFu,
                static_cast<unsigned>(bytes.g) & 0xFFu, static_cast<unsigned>(bytes.b) & 0xFFu);
  return text.data();
}

std::optional<glm::dvec3> typed_colour(std::string_view text) {
  if (text.starts_with('#')) text.remove_prefix(1);
  unsigned code = 0;
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), code, 16);
  if (problem != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  glm::dvec3 bytes;
  if (text.size() == 6) {
    bytes = {code >> 16, (code >> 8) & 0xFFu, code & 0xFFu};
  } else if (text.size() == 3) {
    bytes = 17.0 * glm::dvec3(code >> 8, (code >> 4) & 0xFu, code & 0xFu);
  } else {
    return std::nullopt;
  }
  return linear_from_srgb(bytes / 255.0);
}

}  // namespace focalstage
