#include "editor/tools/typed_numbers.h"

#include <charconv>
#include <cstddef>
#include <string_view>
#include <system_error>

namespace focalstage {
namespace {

constexpr std::size_t most_characters = 40;

std::string_view last_number(std::string_view text) {
  const std::size_t space = text.rfind(' ');
  return space == std::string_view::npos ? text : text.substr(space + 1);
}

double number_from(std::string_view text) {
  double number = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() ? number : 0.0;
}

}  // namespace

bool TypedNumbers::type(char character) {
  if (text_.size() >= most_characters) return false;
  const std::string_view last = last_number(text_);
  if (character == ',') character = '.';
  const bool digit = character >= '0' && character <= '9';
  const bool point = character == '.' && last.find('.') == std::string_view::npos;
  const bool minus = character == '-' && last.empty();
  const bool space = character == ' ' && !last.empty();
  if (!digit && !point && !minus && !space) return false;
  text_ += character;
  return true;
}

void TypedNumbers::backspace() {
  if (!text_.empty()) text_.pop_back();
}

std::vector<double> TypedNumbers::numbers() const {
  std::vector<double> numbers;
  std::string_view rest = text_;
  while (!rest.empty()) {
    const std::size_t space = rest.find(' ');
    const std::string_view word = rest.substr(0, space);
    if (!word.empty()) numbers.push_back(number_from(word));
    rest = space == std::string_view::npos ? std::string_view{} : rest.substr(space + 1);
  }
  return numbers;
}

}  // namespace focalstage
