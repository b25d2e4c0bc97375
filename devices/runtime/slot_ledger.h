#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <vector>

#include "devices/player/player.h"
#include "devices/roles/rig.h"
#include "io/protocol/rig_values.h"

namespace focalstage {

/// What counts as delivered (design section 8).
struct DeliveryTolerance {
  double power_d = 0.02;
  double time_s = 20e-6;
  double transmission = 1e-3;  ///< this close to clear is open, this close to nothing is closed
};

/// Holds what was asked against what was delivered, slot by slot, the worst over all sweeps since the show began.
class SlotLedger {
 public:
  /// `sees_light`: a rig that cannot see its light says nothing of it, so that what was asked counts as neither
  /// delivered nor missed, and its slots as unmeasured.
  explicit SlotLedger(bool sees_light = true, const DeliveryTolerance& tolerance = {})
      : sees_light_(sees_light), tolerance_(tolerance) {}

  void ask(AskedSweep sweep);
  void deliver(std::vector<DeliveredExposure> exposures);

  /// Settles all sweeps that ended by `time_s`; everything delivered until then was handed in.
  void settle_until(double time_s);

  /// What was asked for after `time_s` was called off.
  void call_off_after(double time_s);

  /// What was asked by a show that is gone and was none of anybody's.
  void forget();

  const std::vector<SlotReport>& slots() const { return slots_; }
  std::uint64_t missed() const { return missed_; }

  /// How many of the sweeps settled since the last call missed light.
  std::uint64_t take_faulty_sweeps();

 private:
  void begin_show(const std::shared_ptr<const LoadedShow>& show);
  bool settle(const AskedSweep& sweep, std::size_t slot);
  void settle(const AskedSweep& sweep);
  const DeliveredExposure* find(double start_s, double within_s) const;

  bool sees_light_;
  DeliveryTolerance tolerance_;
  std::shared_ptr<const LoadedShow> show_;
  bool seen_whole_ = false;  ///< a sweep of it whose light all came
  std::deque<AskedSweep> asked_;
  std::deque<DeliveredExposure> delivered_;
  std::vector<SlotReport> slots_;
  std::uint64_t faulty_ = 0;
  std::uint64_t missed_ = 0;
};

}  // namespace focalstage
