#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace focalstage {

/// Plays a period at any length and phase on scans that come at a fixed rate: the current is the period's where it is
/// at each scan, between its samples too; the sync edge comes with the first scan of a period, up to one scan late.
/// Counts in scans. Pure.
class Mcc1208Steered {
 public:
  Mcc1208Steered() = default;
  /// `codes` of channel 0 over one period; channel 1 is high for the first `pulse` of as many. At a period's start.
  Mcc1208Steered(std::vector<int> codes, int pulse);

  /// Periods last `period` scans from now on, and once come so much later, a hundredth of each scan at a time.
  void steer(double period, double later);
  /// Others from the next period's start on.
  void replace(std::vector<int> codes) { next_codes_ = std::move(codes); }

  /// Appends so many scans.
  void play(int scans, std::vector<std::uint8_t>& bytes);

  /// Periods so far, and the part of the one that is played.
  double periods() const { return static_cast<double>(begun_) + phase_; }
  double period() const { return period_; }
  /// By how much the newest edges came later than their periods, in the mean.
  double edges_late() const;

 private:
  void begin_period();

  std::vector<int> codes_;
  std::vector<int> next_codes_;
  int pulse_ = 1;
  double period_ = 1.0;
  double later_ = 0.0;
  double phase_ = 0.0;  ///< of the period that is played
  std::uint64_t begun_ = 0;
  std::uint64_t edges_ = 0;
  std::array<double, 64> late_{};
};

}  // namespace focalstage
