#include "core/schedule/shape_words.h"

#include "core/base/number_words.h"

namespace focalstage {

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
  const std::string allowed = short_text(bound.allowed, 4);
  const std::string needed = short_text(bound.needed, 4);
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
