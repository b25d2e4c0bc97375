#pragma once

#include <array>
#include <cstdint>
#include <optional>

namespace focalstage {

/// When periods began, as far as the host can tell. The pacer says how long each lasts; when the device took their
/// bytes says how its clock goes against ours. A transfer comes back when the bytes before it were played, less what
/// the device keeps in its memory, whose size is not known but stays: so the least lateness of the last quarter of a
/// second, against that of the first, is the drift.
class Mcc1208Pace {
 public:
  Mcc1208Pace() = default;
  Mcc1208Pace(double first_period_s, double period_s) : first_s_(first_period_s), period_s_(period_s) {}

  /// The device took one more period.
  void taken(double time_s);

  /// Begun at `now_s`: no more and no fewer than what it took allows.
  std::uint64_t begun(double now_s) const;
  /// When period `number` began, counted from 1.
  double began_s(std::uint64_t number) const;

 private:
  double start_s() const;
  double least_late_s() const;

  double first_s_ = 0.0;
  double period_s_ = 0.0;
  std::uint64_t taken_ = 0;
  std::array<double, 16> late_s_{};  ///< of the newest: time taken less periods taken
  std::optional<double> first_late_s_;
};

}  // namespace focalstage
