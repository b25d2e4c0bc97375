#pragma once

#include <vector>

#include "core/base/result.h"
#include "core/stripes/capture.h"

namespace focalstage {

/// Which place of the projector's picture lights each pixel of the camera. NaN where none does, or none can be told.
struct DecodedCapture {
  int width_px = 0;  ///< of the camera
  int height_px = 0;
  std::vector<float> u;  ///< projector pixels, pixel i covers [i, i + 1)
  std::vector<float> v;
  std::vector<float> confidence;  ///< 0 to 1: the sine swings by 40 codes of the camera or more; places are as unsure
                                  ///< as its inverse
  double share = 0.0;             ///< of the camera's picture that has a place
};

/// Checks the capture (check_capture) and decodes it. Beyond that it refuses
///
/// "capture.order"    sines out of step, or patterns exchanged whole with their inverses: by name
/// "capture.undecoded" the patterns are seen, but hardly a place is told: out of focus, too noisy
Result<DecodedCapture> decode_capture(const PatternSet& set, const Capture& capture);

}  // namespace focalstage
