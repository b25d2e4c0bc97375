#pragma once

#include <array>
#include <cstdint>
#include <mutex>
#include <optional>
#include <vector>

#include "devices/mcc1208/pace.h"
#include "devices/mcc1208/steered.h"
#include "devices/mcc1208/wave.h"
#include "devices/roles/lens_drive.h"

namespace focalstage {

/// What is played and what was: one filling of the queue is one period, so that a new one begins at a period's start;
/// where it is steered, as many scans as that.
/// Any thread; no call waits.
class Mcc1208Stream {
 public:
  void begin(Mcc1208Wave wave, std::vector<std::uint8_t> lead_in);
  void started(double now_s);  ///< the device has the first bytes and plays
  /// From which period on the wave is played, counted as `DriveReport::periods` counts. None: it would need another
  /// pacer.
  std::optional<std::uint64_t> replace(Mcc1208Wave wave);

  /// False: no period of that length can be made of this one.
  bool steer(double period_s, double later_s);

  void fill(std::vector<std::uint8_t>& bytes);
  void taken(double now_s);  ///< one filling
  void ended(double now_s);  ///< nothing more is begun
  void underrun();

  double taken_s() const;  ///< when the device last took something
  DriveReport report(double now_s) const;

 private:
  mutable std::mutex mutex_;
  Mcc1208Wave playing_;
  std::optional<Mcc1208Wave> next_;
  std::vector<std::uint8_t> lead_in_;
  bool lead_in_filled_ = false;
  bool lead_in_taken_ = false;
  std::uint64_t filled_ = 0;  ///< periods
  Mcc1208Pace pace_;
  double taken_s_ = 0.0;
  std::optional<double> ended_s_ = 0.0;
  std::optional<Mcc1208Steered> steered_;
  double steered_from_ = 0.0;          ///< periods that were played before
  std::array<double, 64> periods_at_;  ///< where fillings begin, by their number: periods before
  DriveReport counts_;                 ///< underruns and clamped
};

}  // namespace focalstage
