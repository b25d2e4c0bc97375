#pragma once

#include <string>

#include "core/retina/retina.h"
#include "core/scene/value.h"
#include "editor/pipeline/focal_sweep.h"
#include "io/plot/plot.h"

namespace focalstage {

/// What a run of `focalstage retina --sweep` was asked for, as far as its words repeat it.
struct SweepRun {
  std::string show;
  std::string folder;
  int frame = 0;
  double pupil_mm = 4.0;
  FocusRange range;
};

/// "focus-003-2.1000D.png": sorted as the sweep goes, and its focus to 0.1 mD.
std::string sweep_picture_name(const FocusRange& range, int i);

/// One row per focus: focus_d, focus_m, then of each thing NAME.sharpness, NAME.light and NAME.blur_radius_arcmin;
/// empty where there is no such number.
std::string contrast_csv(const FocalSweep& sweep);

std::string sweep_title(const SweepRun& run, const RetinaView& view);

/// Sharpness over focus, a line for each thing that has contrast; metres along the top.
LinePlot contrast_plot(const std::string& title, const FocalSweep& sweep);

/// The object that `--json` prints.
Value sweep_value(const SweepRun& run, const RetinaView& view, const FocalSweep& sweep);

/// The same for people: a line, and a table of where each thing is sharpest.
std::string sweep_text(const SweepRun& run, const RetinaView& view, const FocalSweep& sweep);

}  // namespace focalstage
