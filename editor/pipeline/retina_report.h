#pragma once

#include <span>
#include <stop_token>
#include <vector>

#include "core/percept/conflict.h"
#include "core/percept/thing_look.h"
#include "core/percept/things.h"
#include "core/retina/retinas.h"

namespace focalstage {

/// All that can be said of one eye's look at a frame.
struct RetinaReport {
  RetinaImage picture;
  ThingMap things;
  std::vector<ThingLook> looks;          ///< one per thing
  std::vector<ThingConflict> conflicts;  ///< one per thing
  std::vector<float> conflict_d;         ///< [row][column]; not a number where there is none
  double leaked = 0.0;                   ///< share of the picture's light that was meant for the other eye
};

/// The same look through a pinhole of an ideal eye: what sharp would be.
RetinaView pinhole_of(const RetinaView& view);

/// Looks once as `view` says, once through a pinhole pupil to know what sharp would be. `retinas` keep what does not
/// change from one look to the next. Faults: those of Retina.
Result<RetinaReport> report_on(Retinas& retinas, std::span<const RetinaInput> inputs, const RetinaView& view,
                               const ProjectorFlux& flux, std::stop_token stop);

}  // namespace focalstage
