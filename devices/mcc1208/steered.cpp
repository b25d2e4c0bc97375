#include "devices/mcc1208/steered.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "devices/mcc1208/packets.h"

namespace focalstage {

namespace {

constexpr double most_slower = 0.01;

/// Between the codes of a ring.
int between(const std::vector<int>& codes, double place) {
  const auto i = static_cast<std::size_t>(place) % codes.size();
  const double part = place - std::floor(place);
  return static_cast<int>(std::lround(std::lerp(codes[i], codes[(i + 1) % codes.size()], part)));
}

}  // namespace

Mcc1208Steered::Mcc1208Steered(std::vector<int> codes, int pulse)
    : codes_(std::move(codes)), pulse_(pulse), period_(static_cast<double>(codes_.size())) {
  begin_period();
}

void Mcc1208Steered::steer(double period, double later) {
  period_ = period;
  later_ += later;
}

void Mcc1208Steered::begin_period() {
  if (!next_codes_.empty()) codes_ = std::exchange(next_codes_, {});
  late_[edges_++ % late_.size()] = phase_ * period_;
}

void Mcc1208Steered::play(int scans, std::vector<std::uint8_t>& bytes) {
  const auto size = static_cast<double>(codes_.size());
  for (int i = 0; i < scans; ++i) {
    const double place = phase_ * size;
    append_mcc_scan(bytes, between(codes_, place), place < pulse_ ? mcc_top_code : 0);
    const double slower = std::clamp(later_, -most_slower, most_slower);
    later_ -= slower;
    phase_ += (1.0 - slower) / period_;
    // Rounding must not make one scan more of a period that ends with this one.
    if (phase_ < 1.0 - 1e-9) continue;
    phase_ = std::max(phase_ - 1.0, 0.0);
    ++begun_;
    begin_period();
  }
}

double Mcc1208Steered::edges_late() const {
  const std::size_t known = std::min<std::uint64_t>(edges_, late_.size());
  double sum = 0.0;
  for (std::size_t i = 0; i < known; ++i) sum += late_[i];
  return known == 0 ? 0.0 : sum / static_cast<double>(known);
}

}  // namespace focalstage
