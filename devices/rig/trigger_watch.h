#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "devices/rig/period_pictures.h"

namespace focalstage {

/// Finds a trigger that came to nothing, from the projector's count alone: the longest pauses between triggers are
/// where the count must stand at a whole number of periods (or at the half of one, where the other eye's turn begins).
/// After a lost one every later picture would come a trigger late. Pure.
class TriggerWatch {
 public:
  TriggerWatch() = default;
  TriggerWatch(const std::vector<TableTrigger>& triggers, double period_s);

  /// The count as it stood at `time_s`, asked for every millisecond or so. False: in two pauses on end it stood at the
  /// same wrong place. Once is no proof: a count that is told late stands anywhere for a while.
  bool sample(double time_s, std::uint64_t exposures);

 private:
  std::uint64_t per_period_ = 0;
  double pause_s_ = 0.0;                 ///< to stand for longer than this is to stand in one of the longest pauses
  std::vector<std::uint64_t> standing_;  ///< counts, of a period, at which it may then stand
  double since_s_ = 0.0;
  double last_s_ = -1e300;
  std::optional<std::uint64_t> count_;
  std::optional<std::uint64_t> wrong_;  ///< where it stood wrong first, since the last pause in which it stood well
};

}  // namespace focalstage
