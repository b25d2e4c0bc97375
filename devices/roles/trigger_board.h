#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/base/sides.h"
#include "devices/roles/device.h"

namespace focalstage {

/// When a shutter opens and closes, from the period's start; it may close in the next period.
struct ShutterWindow {
  double open_s = 0.0;
  double close_s = 0.0;

  bool operator==(const ShutterWindow&) const = default;
};

/// What the board gives out after every sync edge.
struct BoardTable {
  double period_s = 0.0;  ///< that the times are meant for; the board scales them to the one it measures
  double pulse_s = 100e-6;
  std::vector<double> trigger_s;                 ///< in time order
  PerEye<std::optional<ShutterWindow>> shutter;  ///< none: stays closed

  bool operator==(const BoardTable&) const = default;
};

/// The lens drive's edge as the board sees it against the sync edge, where that comes from a projector.
struct LensEdge {
  std::uint64_t edges = 0;  ///< seen since it was opened
  double after_s = 0.0;     ///< the newest, since the newest sync edge, by the board's own clock: 0 to a period
  double told_s = 0.0;      ///< when this was asked, on the monotonic clock

  bool operator==(const LensEdge&) const = default;
};

struct BoardReport {
  bool armed = false;
  std::optional<double> period_s;  ///< as measured by the board's own clock; none without sync
  std::uint64_t edges = 0;         ///< seen since it was opened
  double told_s = 0.0;             ///< when these two were asked, on the monotonic clock
  std::uint64_t bad_lines = 0;     ///< either way
  std::optional<LensEdge> lens;    ///< none before the first, and from a board that has no input for it
};

/// What gives triggers and moves shutters, in step with the sync edge. Dark by itself (no triggers, shutters closed),
/// and latched until armed again: without an edge for 25 ms, without a host for 500 ms, and if its program hangs.
class TriggerBoard : public Device {
 public:
  /// Checked by the board and taken, whole, at the edge after next at the latest: "board.table" names what it refused.
  virtual Status load(const BoardTable& table) = 0;

  /// Triggers and shutters from the next edge on. "board.unsynced" without edges of the table's period.
  virtual Status arm() = 0;

  /// No more triggers and shutters closed, within 50 ms; safe to call from a watchdog. False: it could not be told (and
  /// its own watch will do it).
  virtual bool dark() noexcept = 0;

  virtual BoardReport report() const = 0;
};

}  // namespace focalstage
