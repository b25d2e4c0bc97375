#include "core/check/words.h"

#include <array>
#include <charconv>

namespace focalstage {

std::string words(double number) {
  std::array<char, 64> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), number, std::chars_format::general, 4).ptr;
  return {text.data(), end};
}

std::string percent(double share) { return words(share * 100.0) + " %"; }

std::string slice_pointer(std::size_t slice) { return "/slices/powers_d/" + std::to_string(slice); }

std::string item_pointer(const std::string& list, std::size_t index) {
  return "/" + list + "/" + std::to_string(index);
}

std::string waveform_pointer(const Sweep& sweep, Side eye) {
  if (sweep.waveform.left == sweep.waveform.right) return "/sweep/waveform";
  return eye == Side::left ? "/sweep/waveform/left" : "/sweep/waveform/right";
}

}  // namespace focalstage
