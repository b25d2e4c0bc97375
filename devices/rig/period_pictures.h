#pragma once

#include <deque>
#include <optional>
#include <vector>

#include "core/base/result.h"
#include "devices/rig/score.h"

namespace focalstage {

/// One trigger of the board's table, which runs from sync edge to sync edge.
struct TableTrigger {
  double at_s = 0.0;     ///< from the edge, 0 to the period
  std::size_t slot = 0;  ///< of the sweep
  int sweeps_later = 0;  ///< which sweep's: 1 the next one's, whose trigger comes before its own edge
};

/// The triggers of a score between two sync edges, in time order.
std::vector<TableTrigger> table_triggers(const Score& score);

/// The pictures that the projector shows between the sync edge of `sweeps[0]` and the next: one per trigger, black
/// where their sweep is dark; empty if all are. None while a sweep that is needed has not been handed over.
std::optional<std::vector<Picture>> period_pictures(const std::vector<TableTrigger>& triggers,
                                                    const std::deque<HandedSweep>& sweeps);

/// Pictures were not there when their sweep began: a doubt.
Fault late_pictures();

/// Drops what was to begin before `before_s`. Sweeps in the dark may go by while nothing is lit; of light that may not,
/// the fault is `late_pictures`.
Status drop_past(std::deque<HandedSweep>& sweeps, double before_s);

}  // namespace focalstage
