#include "editor/tools/srgb.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace focalstage {
namespace {

constexpr int steps = 4096;

std::array<std::uint8_t, steps + 1> code_table() {
  std::array<std::uint8_t, steps + 1> table{};
  for (int i = 0; i <= steps; ++i) {
    table[static_cast<std::size_t>(i)] =
        static_cast<std::uint8_t>(255.0 * srgb_from_linear(static_cast<double>(i) / steps) + 0.5);
  }
  return table;
}

}  // namespace

double srgb_from_linear(double linear) {
  const double clamped = std::clamp(linear, 0.0, 1.0);
  return clamped <= 0.0031308 ? 12.92 * clamped : 1.055 * std::pow(clamped, 1.0 / 2.4) - 0.055;
}

double linear_from_srgb(double coded) {
  return coded <= 0.04045 ? coded / 12.92 : std::pow((coded + 0.055) / 1.055, 2.4);
}

glm::dvec3 srgb_from_linear(const glm::dvec3& linear) {
  return {srgb_from_linear(linear.r), srgb_from_linear(linear.g), srgb_from_linear(linear.b)};
}

glm::dvec3 linear_from_srgb(const glm::dvec3& coded) {
  return {linear_from_srgb(coded.r), linear_from_srgb(coded.g), linear_from_srgb(coded.b)};
}

std::uint8_t srgb_code(double linear) {
  static const std::array<std::uint8_t, steps + 1> table = code_table();
  return table[static_cast<std::size_t>(std::clamp(linear, 0.0, 1.0) * steps + 0.5)];
}

}  // namespace focalstage
