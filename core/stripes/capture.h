#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/stripes/pattern_set.h"

namespace focalstage {

/// One picture of the camera, 8-bit gray from the top.
struct CameraPicture {
  std::string name;  ///< for faults
  int width_px = 0;
  int height_px = 0;
  std::vector<std::uint8_t> gray;

  bool operator==(const CameraPicture&) const = default;
};

/// One picture per pattern, in their order, from a camera that stands still.
using Capture = std::vector<CameraPicture>;

/// The parts of a capture, by what was shown.
class CaptureView {
 public:
  CaptureView(const PatternSet& set, const Capture& capture) : set_(set), capture_(capture) {}

  const PatternSet& set() const { return set_; }
  int bits(PatternAxis axis) const { return code_bits(set_, axis); }
  int width_px() const { return capture_[0].width_px; }
  int height_px() const { return capture_[0].height_px; }
  std::size_t size() const { return capture_[0].gray.size(); }

  const CameraPicture& white(bool again = false) const { return capture_[again ? capture_.size() - 2 : 0]; }
  const CameraPicture& black(bool again = false) const { return capture_[again ? capture_.size() - 1 : 1]; }
  const CameraPicture& code(PatternAxis axis, int bit, bool inverse) const {
    return capture_[first(axis) + static_cast<std::size_t>(2 * bit + (inverse ? 1 : 0))];
  }
  const CameraPicture& sine(PatternAxis axis, int step) const {
    return capture_[first(axis) + static_cast<std::size_t>(2 * bits(axis) + step)];
  }

 private:
  std::size_t first(PatternAxis axis) const {
    return axis == PatternAxis::columns ? 2 : static_cast<std::size_t>(2 + 2 * bits(PatternAxis::columns) + set_.steps);
  }

  const PatternSet& set_;
  const Capture& capture_;
};

/// Refuses what cannot be decoded, or would be decoded to a lie, with the picture to blame:
///
/// "capture.missing"       not one picture per pattern
/// "capture.size"          a picture of another size than the first: turned, or from elsewhere
/// "capture.over-exposed"  of what the projector lights, more than a twentieth is as bright as can be
/// "capture.dark"          the projector's light is hardly seen anywhere
/// "capture.order"         white and black exchanged, or a pattern without its own inverse beside it
/// "capture.turned"        a picture that is upside down
/// "capture.moved"         from this picture on the camera or what it sees lies elsewhere
/// "capture.light"         the room's or the projector's light changed meanwhile
Status check_capture(const PatternSet& set, const Capture& capture);

}  // namespace focalstage
