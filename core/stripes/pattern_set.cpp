#include "core/stripes/pattern_set.h"

#include <cmath>
#include <numbers>

namespace focalstage {

namespace {

constexpr int largest_px = 16384;
constexpr double middle = 0.5;  // of the sine, as light
constexpr double swing = 0.4;   // away from black, where gammas bend most

void add_axis(const PatternSet& set, PatternAxis axis, std::vector<Pattern>& patterns) {
  for (int bit = 0; bit < code_bits(set, axis); ++bit) {
    patterns.push_back({PatternKind::code, axis, bit, false});
    patterns.push_back({PatternKind::code, axis, bit, true});
  }
  for (int step = 0; step < set.steps; ++step) patterns.push_back({PatternKind::sine, axis, step, false});
}

std::uint8_t code_of(const PatternSet& set, double light) {
  return static_cast<std::uint8_t>(std::lround(255.0 * std::pow(light, 1.0 / set.gamma)));
}

/// The code at each place along the axis.
std::vector<std::uint8_t> line_of(const PatternSet& set, const Pattern& pattern, int length) {
  std::vector<std::uint8_t> line;
  const int bits = code_bits(set, pattern.axis);
  for (int i = 0; i < length; ++i) {
    if (pattern.kind == PatternKind::code) {
      const int stripe = i / set.stripe_px;
      const bool lit = ((stripe ^ (stripe >> 1)) >> (bits - 1 - pattern.index)) & 1;
      line.push_back(lit != pattern.inverse ? 255 : 0);
    } else if (pattern.kind == PatternKind::sine) {
      const double turn = (i + 0.5) / set.period_px - static_cast<double>(pattern.index) / set.steps;
      line.push_back(code_of(set, middle + swing * std::cos(2.0 * std::numbers::pi * turn)));
    } else {
      line.push_back(pattern.kind == PatternKind::white ? 255 : 0);
    }
  }
  return line;
}

Fault wrong(const std::string& where, const std::string& message) { return {"stripes.set", where, message, ""}; }

}  // namespace

Status check_set(const PatternSet& set) {
  const auto size = [](int length_px) { return length_px >= 16 && length_px <= largest_px; };
  if (!size(set.width_px) || !size(set.height_px)) return wrong("size", "is not between 16 and 16384 pixels a side");
  if (!(set.gamma >= 0.1 && set.gamma <= 10.0)) return wrong("gamma", "is not between 0.1 and 10");
  if (set.stripe_px < 1 || set.stripe_px > 64) return wrong("stripe_px", "is not between 1 and 64 pixels");
  if (set.period_px < 4 * set.stripe_px || set.period_px > 1024) {
    return wrong("period_px", "is not between four stripes and 1024 pixels");
  }
  if (set.steps < 4 || set.steps > 32) return wrong("steps", "is not between 4 and 32");
  return {};
}

int code_bits(const PatternSet& set, PatternAxis axis) {
  const int length = axis == PatternAxis::columns ? set.width_px : set.height_px;
  const int stripes = (length + set.stripe_px - 1) / set.stripe_px;
  int bits = 1;
  while ((1 << bits) < stripes) ++bits;
  return bits;
}

std::vector<Pattern> patterns_of(const PatternSet& set) {
  std::vector<Pattern> patterns{{PatternKind::white}, {PatternKind::black}};
  add_axis(set, PatternAxis::columns, patterns);
  add_axis(set, PatternAxis::rows, patterns);
  patterns.push_back({PatternKind::white, PatternAxis::columns, 1, false});
  patterns.push_back({PatternKind::black, PatternAxis::columns, 1, false});
  return patterns;
}

std::string name_of(const Pattern& pattern) {
  const std::string again = pattern.index > 0 ? "-again" : "";
  if (pattern.kind == PatternKind::white) return "white" + again;
  if (pattern.kind == PatternKind::black) return "black" + again;
  const std::string axis = pattern.axis == PatternAxis::columns ? "columns" : "rows";
  const std::string number = std::to_string(pattern.index);
  if (pattern.kind == PatternKind::sine) return axis + "-sine-" + number;
  return axis + "-code-" + number + (pattern.inverse ? "-inverse" : "");
}

std::vector<std::uint8_t> picture_of(const PatternSet& set, const Pattern& pattern) {
  const bool columns = pattern.axis == PatternAxis::columns;
  const std::vector<std::uint8_t> line = line_of(set, pattern, columns ? set.width_px : set.height_px);
  std::vector<std::uint8_t> codes;
  codes.reserve(static_cast<std::size_t>(set.width_px) * static_cast<std::size_t>(set.height_px));
  for (int y = 0; y < set.height_px; ++y) {
    if (columns) {
      codes.insert(codes.end(), line.begin(), line.end());
    } else {
      codes.insert(codes.end(), static_cast<std::size_t>(set.width_px), line[static_cast<std::size_t>(y)]);
    }
  }
  return codes;
}

}  // namespace focalstage
