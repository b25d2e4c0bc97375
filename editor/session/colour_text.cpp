#include "editor/session/colour_text.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>

#include <glm/common.hpp>

namespace focalstage {
namespace {

double coded(double linear) {
  const double clamped = std::fmin(std::fmax(linear, 0.0), 1.0);
  return clamped <= 0.0031308 ? 12.92 * clamped : 1.055 * std::pow(clamped, 1.0 / 2.4) - 0.055;
}

double linear(double coded) { return coded <= 0.04045 ? coded / 12.92 : std::pow((coded + 0.055) / 1.055, 2.4); }

}  // namespace

glm::dvec3 coded_from_linear(const glm::dvec3& color) { return {coded(color.r), coded(color.g), coded(color.b)}; }
glm::dvec3 linear_from_coded(const glm::dvec3& color) { return {linear(color.r), linear(color.g), linear(color.b)}; }

std::string colour_text(const glm::dvec3& color) {
  const glm::ivec3 bytes(glm::round(coded_from_linear(color) * 255.0));
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
  return linear_from_coded(bytes / 255.0);
}

}  // namespace focalstage
