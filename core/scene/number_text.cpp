#include "core/scene/number_text.h"

#include <array>
#include <charconv>

namespace focalstage {

std::string number_text(double number) {
  std::array<char, 32> text{};  // the longest shortest double has 24 characters
  const auto end = std::to_chars(text.data(), text.data() + text.size(), number).ptr;
  return {text.data(), end};
}

}  // namespace focalstage
