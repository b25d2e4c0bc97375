#pragma once

#include <vector>

#include "devices/rig/period_pictures.h"
#include "devices/rig/score.h"
#include "devices/roles/projector.h"
#include "devices/roles/trigger_board.h"

namespace focalstage {

/// What the projector shows in every period of a score.
Exposures exposures_of(const Score& score, const std::vector<TableTrigger>& triggers, double latency_s);

/// What the board gives out after each sync edge: triggers and shutters.
BoardTable board_table(const Score& score, const std::vector<TableTrigger>& triggers, double pulse_s);

/// The same after the edges of a projector that needs no triggers, so long after each period's start.
BoardTable shutter_table(const Score& score, double edge_s);

}  // namespace focalstage
