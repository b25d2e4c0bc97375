#pragma once

#include <vector>

#include "core/rig_measure/light_trace.h"

namespace focalstage {

/// Light that crosses a level. Near a known power the line is sharp and the light high: so it rises on the way to that
/// power and falls on the way from it.
struct Crossing {
  double time_s = 0.0;
  double spread_s = 0.0;
  bool rises = false;
};

/// Least and greatest light of what was seen, without its outliers and at the fineness of one step.
struct LightRange {
  double low = 0.0;
  double high = 0.0;
};
LightRange light_range(const std::vector<LightPoint>& points, double step_s);

/// All crossings of `level` by light that moves on by a tenth of `height` either side. Each is where a parabola
/// through the points around it crosses; its spread comes from how the traces differ there, so that what all samples of
/// a trace share (hum) counts once.
std::vector<Crossing> crossings(const std::vector<LightPoint>& points, double level, double height, double step_s);

}  // namespace focalstage
