#include "editor/window/base/number_text.h"

#include <array>
#include <charconv>
#include <cmath>

#include "core/base/number_words.h"

namespace focalstage {
namespace {

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
  return text;
}

struct Length {
  std::string_view unit;
  double in_m;
};
constexpr std::array lengths = {Length{"m", 1.0}, Length{"cm", 0.01}, Length{"mm", 0.001}};

std::optional<double> metres_of(std::string_view unit) {
  for (const Length& length : lengths) {
    if (length.unit == unit) return length.in_m;
  }
  return std::nullopt;
}

/// What a number typed with the unit `typed` is worth in `unit`.
std::optional<double> factor(std::string_view typed, std::string_view unit) {
  if (typed.empty() || typed == unit) return 1.0;
  if (unit == "°" && typed == "deg") return 1.0;
  const auto from = metres_of(typed);
  const auto to = metres_of(unit);
  if (from && to) return *from / *to;
  return std::nullopt;
}

}  // namespace

std::string number_text(double value, int digits, std::string_view unit) {
  std::string text = fixed_text(value, digits);
  if (!unit.empty() && unit != "°" && unit != "%") text += ' ';
  return text += unit;
}

std::optional<double> typed_number(std::string_view text, std::string_view unit) {
  std::string plain(trimmed(text));
  if (!plain.empty() && plain.front() == '+') plain.erase(0, 1);
  if (const auto comma = plain.find(','); comma != std::string::npos) plain[comma] = '.';
  double value = 0.0;
  const auto [rest, problem] = std::from_chars(plain.data(), plain.data() + plain.size(), value);
  if (problem != std::errc{} || !std::isfinite(value)) return std::nullopt;
  const auto scale = factor(trimmed({rest, static_cast<std::size_t>(plain.data() + plain.size() - rest)}), unit);
  if (!scale) return std::nullopt;
  return value * *scale;
}

}  // namespace focalstage
