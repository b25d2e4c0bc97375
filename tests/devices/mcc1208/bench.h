#pragma once

#include <atomic>
#include <cmath>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include <doctest/doctest.h>

#include "devices/mcc1208/mcc1208.h"
#include "devices/roles/clock.h"
#include "tests/devices/mcc1208/emulator/emulator.h"
#include "tests/devices/mcc1208/emulator/real_time.h"

namespace focalstage {

namespace emulated = mcc1208_emulator;

/// An emulated device that plays in real time, and what it put out.
class Bench {
 public:
  explicit Bench(const emulated::Options& options = {}) : emulator_(emulated::Emulator::create(options)) {
    REQUIRE_MESSAGE(emulator_, "these tests run under umockdev-wrapper, as ctest does it");
    emulator_->on_output([this](const emulated::Output& output) {
      const std::lock_guard lock(mutex_);
      outputs_.push_back(output);
      if (output.scan) ++scan_count_;
    });
    emulator_->plug_in();
    clock_ = std::make_unique<emulated::RealTime>(*emulator_);
  }
  ~Bench() { clock_.reset(); }
  Bench(const Bench&) = delete;
  Bench& operator=(const Bench&) = delete;

  emulated::Emulator& device() { return *emulator_; }
  void stop_time() { clock_.reset(); }

  std::vector<emulated::Output> outputs() const {
    const std::lock_guard lock(mutex_);
    return outputs_;
  }
  std::vector<emulated::Output> scans() const {
    std::vector<emulated::Output> scans;
    for (const auto& output : outputs()) {
      if (output.scan) scans.push_back(output);
    }
    return scans;
  }
  std::size_t scan_count() const { return scan_count_; }
  void forget_outputs() {
    const std::lock_guard lock(mutex_);
    outputs_.clear();
    scan_count_ = 0;
  }

 private:
  std::unique_ptr<emulated::Emulator> emulator_;
  mutable std::mutex mutex_;
  std::vector<emulated::Output> outputs_;
  std::atomic<std::size_t> scan_count_ = 0;
  std::unique_ptr<emulated::RealTime> clock_;
};

inline Mcc1208Settings bench_settings() {
  Mcc1208Settings settings;
  settings.amperes_per_volt = 0.12;
  settings.enable_bit = 3;
  return settings;
}

/// A sine of 60 Hz whose samples fall on the device's own.
inline DrivePeriod sine(double amplitude_a, double phase = 0.0) {
  DrivePeriod period{1.0 / 60.0, {}};
  for (int i = 0; i < 400; ++i) {
    period.drive_a.left.push_back(amplitude_a * std::sin(2.0 * std::acos(-1.0) * i / 400.0 + phase));
  }
  period.drive_a.right = period.drive_a.left;
  return period;
}

/// The codes that a period must become, without the driver's help: bench_settings() by the sheet's formula.
inline std::vector<int> codes_of(const DrivePeriod& period) {
  std::vector<int> codes;
  for (const double a : period.drive_a.left) codes.push_back(2048 + static_cast<int>(std::lround(a / 0.12 * 4096 / 5)));
  return codes;
}

inline void wait_s(double seconds) { sleep_until(monotonic_s() + seconds); }

/// Seconds until it is so; none after `longest_s`.
inline std::optional<double> until(const std::function<bool()>& so, double longest_s) {
  const double start_s = monotonic_s();
  while (!so()) {
    if (monotonic_s() - start_s > longest_s) return std::nullopt;
    wait_s(0.001);
  }
  return monotonic_s() - start_s;
}

inline bool at_rest(Bench& bench) { return bench.device().codes() == std::array<int, 2>{2048, 0}; }
inline bool enabled(Bench& bench) { return bench.device().pins(0) == 8; }

inline std::vector<emulated::Request> sent(Bench& bench, std::uint8_t request) {
  std::vector<emulated::Request> found;
  for (const auto& one : bench.device().requests()) {
    if (one.setup.request == request && one.setup.type == 0x40) found.push_back(one);
  }
  return found;
}

}  // namespace focalstage
