#pragma once

#include <cstddef>
#include <vector>

#include "core/scene/project.h"
#include "core/schedule/shutter.h"

namespace focalstage {

/// A periodic curve of few harmonics: mean, then cosine and sine of harmonics 1, 2, ... about the period's start.
using HarmonicCurve = std::vector<double>;

/// `count` uniform samples from the period's start.
std::vector<double> samples_of(const HarmonicCurve& curve, std::size_t count);

/// What one eye's curve has to do, in the frame of the left eye: shown while it rises, from the period's start to its
/// middle.
struct ShapeTask {
  double period_s = 1.0 / 60.0;
  std::size_t samples = 512;  ///< even; what is timed is the straight lines between these
  int highest_harmonic = 1;
  std::vector<double> powers_d;  ///< rising, none twice
  double exposure_s = 0.0;
  double pitch_s = 0.0;  ///< between the starts of two exposures
  TimeSpan clear;        ///< what the shutters leave of the half
  double lowest_d = -10.0;
  double highest_d = 10.0;
};

/// What a drive may ask of one lens.
struct DriveTask {
  LensResponse response;
  bool falling = false;  ///< the curve is played backwards: the right eye
  double max_current_a = 0.0;
  double max_rms_current_a = 0.0;
};

}  // namespace focalstage
