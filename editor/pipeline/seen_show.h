#pragma once

#include "core/base/result.h"
#include "core/base/sides.h"
#include "core/compile/frame.h"
#include "core/retina/retina.h"
#include "core/stage/stage.h"
#include "io/show/reader.h"

namespace focalstage {

/// One frame of a show as one eye gets it: every exposure of the period that is this eye's, at the power that the lens
/// has then. Held together, because the input refers to stage and images.
class SeenShow {
 public:
  /// From the show alone; things stand where its poses say. `name` is the show's, for faults.
  static Result<SeenShow> of(const ShowReader& show, const std::string& name, int frame, Side eye);

  /// Valid while this stays where it is.
  RetinaInput input() const;

 private:
  Stage stage_;
  CompileSettings settings_;
  FrameImages images_;
  std::vector<Slot> slots_;
  double lens_aperture_m_ = 0.0;
};

}  // namespace focalstage
