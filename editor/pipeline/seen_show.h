#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/base/sides.h"
#include "core/compile/frame.h"
#include "core/percept/seen_frame.h"
#include "core/percept/things.h"
#include "core/stage/stage.h"
#include "io/show/reader.h"

namespace focalstage {

/// One frame of a show as one eye gets it: every exposure of the period that reaches it. Held together, because the
/// input refers to stage and images.
class SeenShow {
 public:
  /// From the show alone; things stand where its poses say. `name` is the show's, for faults.
  /// `glasses`: worn instead of the show's.
  static Result<SeenShow> of(const ShowReader& show, const std::string& name, int frame, Side eye,
                             const std::optional<WornGlasses>& glasses = {});

  /// Of each projector; the first carries the room's light. Valid while this stays where it is.
  std::vector<RetinaInput> inputs() const;

  const ProjectorFlux& flux() const { return room_.flux; }

 private:
  Stage stage_;
  std::vector<CompileSettings> settings_;  ///< of each projector
  std::vector<FrameImages> images_;
  std::vector<Schedule> schedules_;
  WornGlasses glasses_;
  RoomLight room_;
  Side eye_ = Side::left;
};

}  // namespace focalstage
