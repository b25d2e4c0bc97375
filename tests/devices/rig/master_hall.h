#pragma once

#include <algorithm>
#include <cmath>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "devices/rig/leader.h"

namespace focalstage::test {

/// Devices without hardware in one time, the projector their clock: a crystal of its own for it, for the lens drive and
/// for the board, which sees the edges of both.
struct MasterHall {
  struct Shown {
    double at_s = 0.0;
    int code = 0;           ///< the first picture's first byte; 0: dark
    double lens_s = 0.0;    ///< from the drive's period to the projector's
    bool shutters = false;  ///< they moved
  };

  double projector_period_s = 1.0 / 59.94;
  double drive_ppm = 80.0;
  double board_ppm = -3000.0;
  double first_light_s = 0.002;  ///< as it was armed: the projector's edge comes so long after its period began

  std::recursive_mutex mutex;
  double now_s = 0.0;
  std::vector<Shown> shown;
  std::vector<BoardTable> tables;
  std::vector<Exposures> exposures;
  int arms = 0;
  bool lens_wired = true;
  static constexpr double scan_s = 1.0 / 24e3;

  bool projector_on = false;
  double projector_s = 0.0;  ///< its newest period
  double projector_next_s = 0.0;
  std::deque<std::vector<Picture>> queue;
  ProjectorReport projected;

  bool lens_on = false;
  double drive_period_s = 0.0;
  double drive_slew_s = 0.0;
  double drive_s = 0.0;  ///< its newest period
  std::uint64_t drive_periods = 0;
  std::deque<std::pair<double, std::pair<double, double>>> steers;

  bool board_armed = false;
  std::uint64_t edges = 0;
  std::uint64_t lens_edges = 0;
  double looked_s = -1.0;
  std::optional<LensEdge> told;
  std::uint64_t told_edges = 0;

  DeviceState lens_state{DevicePhase::ready, {}, 0.0, {}};
  DeviceState board_state{DevicePhase::ready, {}, 0.0, {}};
  DeviceState projector_state{DevicePhase::ready, {}, 0.0, {}};

  void run_until(double time_s) {
    const std::lock_guard lock(mutex);
    while (now_s < time_s) {
      now_s = std::min(now_s + 100e-6, time_s);
      if (projector_on && projector_next_s <= now_s) project();
      if (lens_on && drive_s + drive_length() <= now_s) drive();
      look();
    }
  }

  double drive_length() const {
    const double most_s = 0.01 * drive_period_s;
    return (drive_period_s + std::clamp(drive_slew_s, -most_s, most_s)) * (1.0 + 1e-6 * drive_ppm);
  }

 private:
  void project() {
    projector_s = std::exchange(projector_next_s, projector_next_s + projector_period_s);
    ++projected.periods;
    ++edges;
    const auto pictures = exposures.back().start_s.size();
    projected.exposures += pictures;
    int code = 0;
    if (queue.empty()) {
      projected.missed += pictures;
    } else {
      if (!queue.front().empty()) code = queue.front()[0].codes[0];
      queue.pop_front();
    }
    const double turns = (projector_s - drive_s) / projector_period_s;
    shown.push_back({projector_s, code, (turns - std::round(turns)) * projector_period_s, board_armed});
  }

  void drive() {
    const double most_s = 0.01 * drive_period_s;
    const double length_s = drive_length();
    drive_slew_s -= std::clamp(drive_slew_s, -most_s, most_s);
    drive_s += length_s;
    ++drive_periods;
    ++lens_edges;
    while (!steers.empty() && steers.front().first <= drive_s) {
      drive_period_s = steers.front().second.first;
      drive_slew_s += steers.front().second.second;
      steers.pop_front();
    }
  }

  /// As often as the board is asked. The drive's edges come with its scans.
  void look() {
    if (now_s - looked_s < 0.03) return;
    looked_s = now_s;
    if (!lens_wired || edges == 0 || lens_edges == told_edges) return;
    told_edges = lens_edges;
    const double edge_s = projector_s + first_light_s;
    double after_s = drive_s + scan_s * std::fmod(0.4 * static_cast<double>(drive_periods), 1.0) - edge_s;
    after_s -= projector_period_s * std::floor(after_s / projector_period_s);
    told = LensEdge{lens_edges, after_s * (1.0 + 1e-6 * board_ppm), now_s};
  }
};

class HallLens final : public LensDrive {
 public:
  explicit HallLens(MasterHall& hall, bool steers) : hall_(hall), steers_(steers) {}
  Status open() override { return {}; }
  void close() override {}
  DeviceId id() const override { return {"fake", "lens drive", "1", "here"}; }
  DeviceState state() const override {
    const std::lock_guard lock(hall_.mutex);
    return hall_.lens_state;
  }
  Status identify() override { return {}; }
  DriveAbilities abilities() const override { return {false, true, 0.29, {}, steers_}; }
  Status start(const DrivePeriod& period) override {
    const std::lock_guard lock(hall_.mutex);
    hall_.lens_on = true;
    hall_.drive_period_s = period.period_s;
    hall_.drive_s = hall_.now_s + 0.0043;
    return {};
  }
  Result<std::uint64_t> refill(const DrivePeriod&) override { return std::uint64_t{1}; }
  Status steer(double period_s, double later_s) override {
    const std::lock_guard lock(hall_.mutex);
    hall_.steers.push_back({hall_.now_s + 0.12, {period_s, later_s}});
    return {};
  }
  bool stop() noexcept override {
    const std::lock_guard lock(hall_.mutex);
    hall_.lens_on = false;
    hall_.steers.clear();
    hall_.drive_slew_s = 0.0;
    return true;
  }
  DriveReport report() const override {
    const std::lock_guard lock(hall_.mutex);
    DriveReport report;
    if (!hall_.lens_on) return report;
    report.periods = hall_.drive_periods;
    report.newest_period_s = hall_.drive_s + 0.0015;  // known to a millisecond or two
    report.period_s = hall_.drive_period_s;
    report.edge_late_s = 0.4 * MasterHall::scan_s;  // of 0, 0.4, 0.8, 0.2, 0.6
    return report;
  }

 private:
  MasterHall& hall_;
  bool steers_;
};

class HallBoard final : public TriggerBoard {
 public:
  explicit HallBoard(MasterHall& hall) : hall_(hall) {}
  Status open() override { return {}; }
  void close() override {}
  DeviceId id() const override { return {"fake", "trigger board", "2", "here"}; }
  DeviceState state() const override {
    const std::lock_guard lock(hall_.mutex);
    return hall_.board_state;
  }
  Status identify() override { return {}; }
  Status load(const BoardTable& table) override {
    const std::lock_guard lock(hall_.mutex);
    hall_.tables.push_back(table);
    return {};
  }
  Status arm() override {
    const std::lock_guard lock(hall_.mutex);
    hall_.board_armed = true;
    ++hall_.arms;
    return {};
  }
  bool dark() noexcept override {
    const std::lock_guard lock(hall_.mutex);
    hall_.board_armed = false;
    return true;
  }
  BoardReport report() const override {
    const std::lock_guard lock(hall_.mutex);
    BoardReport report;
    report.armed = hall_.board_armed;
    if (hall_.projector_on && hall_.edges > 16) {
      report.period_s = hall_.projector_period_s * (1.0 + 1e-6 * hall_.board_ppm);
    }
    report.edges = hall_.edges;
    report.lens = hall_.told;
    return report;
  }

 private:
  MasterHall& hall_;
};

class HallProjector final : public ProjectorDevice {
 public:
  explicit HallProjector(MasterHall& hall) : hall_(hall) {}
  Status open() override { return {}; }
  void close() override {}
  DeviceId id() const override { return {"fake", "projector", "3", "here"}; }
  DeviceState state() const override {
    const std::lock_guard lock(hall_.mutex);
    return hall_.projector_state;
  }
  Status identify() override { return {}; }
  ProjectorAbilities abilities() const override { return {8, 4, Pacing::master, 0.0, 2}; }
  Status arm(const Exposures& exposures) override {
    const std::lock_guard lock(hall_.mutex);
    hall_.exposures.push_back(exposures);
    hall_.first_light_s = exposures.start_s.front();
    hall_.projector_on = false;
    return {};
  }
  Status start() override {
    const std::lock_guard lock(hall_.mutex);
    hall_.projector_on = true;
    hall_.projector_next_s = hall_.now_s + 0.0077;
    hall_.projected = {};
    hall_.queue.clear();
    return {};
  }
  Status post(std::vector<Picture> pictures) override {
    const std::lock_guard lock(hall_.mutex);
    if (hall_.queue.size() >= 2) return Fault{"projector.full", "projector", "two periods wait", "wait"};
    hall_.queue.push_back(std::move(pictures));
    return {};
  }
  bool dark() noexcept override {
    const std::lock_guard lock(hall_.mutex);
    hall_.projector_on = false;
    hall_.queue.clear();
    return true;
  }
  ProjectorReport report() const override {
    const std::lock_guard lock(hall_.mutex);
    ProjectorReport report = hall_.projected;
    report.told_s = hall_.now_s;
    if (hall_.projector_on && report.periods > 0) report.newest_period_s = hall_.projector_s;
    return report;
  }

 private:
  MasterHall& hall_;
};

inline RigDevices devices_of(MasterHall& hall, bool lens_steers = true) {
  return {std::make_shared<HallProjector>(hall), std::make_shared<HallLens>(hall, lens_steers),
          std::make_shared<HallBoard>(hall)};
}

}  // namespace focalstage::test
