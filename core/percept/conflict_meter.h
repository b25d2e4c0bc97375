#pragma once

#include <stop_token>
#include <vector>

#include "core/compile/frame.h"
#include "core/percept/seen_frame.h"
#include "core/retina/retinas.h"
#include "core/schedule/schedule.h"
#include "core/stage/stage.h"

namespace focalstage {

/// How far vergence and accommodation part over one object, by its light, both eyes and all frames looked at.
struct ObjectConflict {
  std::size_t index = 0;        ///< in the project's list
  double mean_d = 0.0;          ///< positive: the show lets the eyes focus further away than they converge
  double worst_d = 0.0;         ///< what 95 % of the light of one look stays below, in size
  double beyond_comfort = 0.0;  ///< share of its light beyond half a dioptre
};

/// Which of `frames` frames are looked at for conflict: all of a few, else so many spread evenly, first and last among
/// them. A look takes two retinas; a show of minutes would take longer to look at than to compile.
bool looked_at_for_conflict(int frame, int frames);

/// Measures, over frames and both eyes, where vergence and accommodation part: object by object, by its light.
class ConflictMeter {
 public:
  ConflictMeter(const Project& project, CompileSettings settings, Schedule schedule);
  /// Of several projectors, each with its own settings and schedule.
  ConflictMeter(const Project& project, std::vector<CompileSettings> settings, std::vector<Schedule> schedules);

  /// Faults: those of Retina.
  Status add(const Stage& stage, const FrameImages& images, std::stop_token stop);
  Status add(const Stage& stage, const std::vector<const FrameImages*>& images, std::stop_token stop);

  /// Objects of which something was lit, in the project's order.
  std::vector<ObjectConflict> conflicts() const;

 private:
  /// Sums over eyes and frames of one object.
  struct Sum {
    double light = 0.0;
    double mean_d = 0.0;  ///< times light
    double beyond = 0.0;  ///< times light
    double worst_d = 0.0;
  };

  std::vector<CompileSettings> settings_;  ///< of each projector
  std::vector<Schedule> schedules_;
  WornGlasses glasses_;
  PerEye<Retinas> retinas_;
  std::vector<Sum> sums_;  ///< by the object's index in the project
};

}  // namespace focalstage
