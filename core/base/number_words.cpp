#include "core/base/number_words.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <system_error>

namespace focalstage {
namespace {

constexpr std::size_t longest = 340;  // as long as the largest double is, with some decimals

std::string written(double number, std::chars_format format, int digits) {
  std::array<char, longest> text;
  const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), number, format, digits);
  std::string words(text.data(), error == std::errc() ? end : text.data());
  if (words.starts_with('-') && words.find_first_not_of("-0.") == std::string::npos) words.erase(0, 1);
  return words;
}

}  // namespace

std::string fixed_text(double number, int decimals) {
  if (!std::isfinite(number)) return number > 0.0 ? "\u221e" : number < 0.0 ? "-\u221e" : "?";
  return written(number, std::chars_format::fixed, decimals);
}

std::string signed_text(double number, int decimals) {
  const std::string text = fixed_text(number, decimals);
  const bool zero = text.find_first_not_of("0.") == std::string::npos;
  return zero || text.starts_with('-') ? text : "+" + text;
}

std::string short_text(double number, int digits) { return written(number, std::chars_format::general, digits); }

}  // namespace focalstage
