#include "devices/uno/light_words.h"

#include <array>
#include <charconv>

namespace focalstage::uno {

namespace {

constexpr double tick_s = 0.5e-6;
constexpr unsigned full_code = 1023;
constexpr unsigned most_samples = 240;

}  // namespace

std::optional<LightLine> decode_light(std::string_view words) {
  std::array<unsigned, 3> numbers{};
  const char* at = words.data();
  const char* const end = at + words.size();
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (i > 0 && (at == end || *at++ != ' ')) return std::nullopt;
    const auto [next, error] = std::from_chars(at, end, numbers[i]);
    if (error != std::errc()) return std::nullopt;
    at = next;
  }
  if (at != end || numbers[0] > 3 || numbers[1] > 65535 || numbers[2] > most_samples) return std::nullopt;
  return LightLine{static_cast<LightLine::State>(numbers[0]), numbers[1] * tick_s, numbers[2]};
}

std::optional<std::vector<double>> decode_samples(std::string_view words) {
  if (words.empty() || words.size() % 3 != 0) return std::nullopt;
  std::vector<double> samples;
  for (std::size_t i = 0; i < words.size(); i += 3) {
    unsigned code = 0;
    const char* const end = words.data() + i + 3;
    const auto [next, error] = std::from_chars(words.data() + i, end, code, 16);
    if (error != std::errc() || next != end || code > full_code) return std::nullopt;
    samples.push_back(static_cast<double>(code) / full_code);
  }
  return samples;
}

}  // namespace focalstage::uno
