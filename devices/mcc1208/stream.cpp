#include "devices/mcc1208/stream.h"

#include <cmath>
#include <utility>

#include "devices/mcc1208/packets.h"

namespace focalstage {

void Mcc1208Stream::begin(Mcc1208Wave wave, std::vector<std::uint8_t> lead_in) {
  const std::lock_guard lock(mutex_);
  counts_ = {};
  counts_.clamped = wave.clamped;
  playing_ = std::move(wave);
  next_.reset();
  lead_in_ = std::move(lead_in);
  lead_in_filled_ = lead_in_taken_ = lead_in_.empty();
  filled_ = 0;
  pace_ = {};
  ended_s_.reset();
  steered_.reset();
}

void Mcc1208Stream::started(double now_s) {
  const std::lock_guard lock(mutex_);
  const double lead_in_s = static_cast<double>(lead_in_.size() / 4) / mcc_scans_per_s(playing_.pacer);
  pace_ = Mcc1208Pace(now_s + lead_in_s, playing_.period_s);
  taken_s_ = now_s;
}

std::optional<std::uint64_t> Mcc1208Stream::replace(Mcc1208Wave wave) {
  const std::lock_guard lock(mutex_);
  if (wave.pacer != playing_.pacer) return std::nullopt;
  counts_.clamped += wave.clamped;
  next_ = std::move(wave);
  return filled_ + 1;
}

bool Mcc1208Stream::steer(double period_s, double later_s) {
  constexpr double most_off = 0.01;
  const std::lock_guard lock(mutex_);
  if (!(std::abs(period_s / playing_.period_s - 1.0) <= most_off) || !std::isfinite(later_s)) return false;
  if (!steered_) {
    steered_.emplace(playing_.codes, playing_.pulse_scans);
    for (std::size_t i = 0; i < periods_at_.size(); ++i) {  // so far each filling was one
      const std::uint64_t newest = filled_ - filled_ % periods_at_.size() + i;
      periods_at_[i] = static_cast<double>(newest > filled_ ? newest - periods_at_.size() : newest);
    }
    steered_from_ = static_cast<double>(filled_);
  }
  const double scans_per_s = mcc_scans_per_s(playing_.pacer);
  steered_->steer(period_s * scans_per_s, later_s * scans_per_s);
  return true;
}

void Mcc1208Stream::fill(std::vector<std::uint8_t>& bytes) {
  const std::lock_guard lock(mutex_);
  if (!std::exchange(lead_in_filled_, true)) {
    bytes = lead_in_;
    return;
  }
  if (next_) {
    playing_ = *std::exchange(next_, std::nullopt);
    if (steered_) steered_->replace(playing_.codes);
  }
  if (steered_) {
    periods_at_[filled_ % periods_at_.size()] = steered_from_ + steered_->periods();
    bytes.clear();
    steered_->play(static_cast<int>(playing_.codes.size()), bytes);
  } else {
    bytes = playing_.bytes;
  }
  ++filled_;
}

void Mcc1208Stream::taken(double now_s) {
  const std::lock_guard lock(mutex_);
  taken_s_ = now_s;
  if (std::exchange(lead_in_taken_, true)) pace_.taken(now_s);
}

void Mcc1208Stream::ended(double now_s) {
  const std::lock_guard lock(mutex_);
  if (!ended_s_) ended_s_ = now_s;
}

void Mcc1208Stream::underrun() {
  const std::lock_guard lock(mutex_);
  ++counts_.underruns;
}

double Mcc1208Stream::taken_s() const {
  const std::lock_guard lock(mutex_);
  return taken_s_;
}

DriveReport Mcc1208Stream::report(double now_s) const {
  const std::lock_guard lock(mutex_);
  DriveReport report = counts_;
  report.periods = pace_.begun(ended_s_.value_or(now_s));
  report.newest_period_s = pace_.began_s(report.periods);
  report.period_s = playing_.period_s;
  if (!steered_ || report.periods == 0) return report;
  // As many fillings began: the newest of them began so far into a period.
  const double scans_per_s = mcc_scans_per_s(playing_.pacer);
  const double begun = periods_at_[(report.periods - 1) % periods_at_.size()];
  report.period_s = steered_->period() / scans_per_s;
  report.edge_late_s = steered_->edges_late() / scans_per_s;
  report.periods = static_cast<std::uint64_t>(begun) + 1;
  report.newest_period_s -= (begun - std::floor(begun)) * report.period_s;
  return report;
}

}  // namespace focalstage
