#include "core/schedule/shape_words.h"

#include <array>
#include <cstdio>

namespace focalstage {

std::string shape_number(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.4g", value);
  return text.data();
}

std::string name_of(ShapeLimit limit) {
  switch (limit) {
    case ShapeLimit::response:
      return "response";
    case ShapeLimit::frequency:
      return "frequency";
    case ShapeLimit::asked:
      return "asked";
    case ShapeLimit::harmonics:
      return "harmonics";
    case ShapeLimit::current:
      return "current";
    case ShapeLimit::rms_current:
      return "rms-current";
    case ShapeLimit::range:
      return "range";
  }
  return {};
}

std::string unit_of(ShapeLimit limit) {
  if (limit == ShapeLimit::current || limit == ShapeLimit::rms_current) return "A";
  return limit == ShapeLimit::range ? "D" : "harmonic";
}

std::string describe(const ShapeBound& bound) {
  const std::string allowed = shape_number(bound.allowed);
  const std::string needed = shape_number(bound.needed);
  switch (bound.limit) {
    case ShapeLimit::response:
      return "the lens response is measured up to harmonic " + allowed + " of " + needed +
             " that a shape can use; adopt-rig brings what the rig measured";
    case ShapeLimit::frequency:
      return "lens_limits.max_frequency_hz ends at harmonic " + allowed + " of " + needed + " that a shape can use";
    case ShapeLimit::asked:
      return "harmonics were asked for up to " + allowed + " of " + needed + " that a shape can use";
    case ShapeLimit::harmonics:
      return "all " + allowed + " harmonics that a shape can use are measured";
    case ShapeLimit::current:
      return "the drive takes " + needed + " A at its peak; a lens may get " + allowed + " A";
    case ShapeLimit::rms_current:
      return "the drive takes " + needed + " A in the root mean square; a lens may get " + allowed + " A";
    case ShapeLimit::range:
      return "the power reaches the sweep's extreme at " + allowed + " D";
  }
  return {};
}

}  // namespace focalstage
