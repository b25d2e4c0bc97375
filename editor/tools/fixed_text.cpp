#include "editor/tools/fixed_text.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <system_error>

namespace focalstage {

std::string fixed_text(double number, int decimals) {
  if (!std::isfinite(number)) return number > 0.0 ? "\u221e" : number < 0.0 ? "-\u221e" : "?";
  std::array<char, 340> text;  // as long as the largest double is
  const auto [end, error] =
      std::to_chars(text.data(), text.data() + text.size(), number, std::chars_format::fixed, decimals);
  std::string written(text.data(), error == std::errc() ? end : text.data());
  if (written.starts_with('-') && written.find_first_not_of("-0.") == std::string::npos) written.erase(0, 1);
  return written;
}

std::string signed_text(double number, int decimals) {
  const std::string text = fixed_text(number, decimals);
  const bool zero = text.find_first_not_of("0.") == std::string::npos;
  return zero || text.starts_with('-') ? text : "+" + text;
}

}  // namespace focalstage
