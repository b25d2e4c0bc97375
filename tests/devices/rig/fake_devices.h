#pragma once

#include <atomic>
#include <chrono>
#include <cmath>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include "devices/rig/conductor.h"

namespace focalstage::test {

/// Devices without hardware that share one time, moved on by `run_until`: the lens drive gives edges, the board gives
/// triggers after them, the projector shows a picture for each and notes which.
struct Stagehands {
  struct Shown {
    double at_s = 0.0;
    int code = 0;  ///< the picture's first byte; 0 where it was dark
  };
  static constexpr double period_s = 1.0 / 60.0;
  static constexpr double told_each_s = 0.1;

  std::recursive_mutex mutex;
  double now_s = 0.0;
  std::vector<Shown> shown;
  std::vector<BoardTable> tables;
  std::vector<Exposures> exposures;
  int lens_starts = 0;
  int lens_refills = 0;
  int lens_stops_in_light = 0;
  std::atomic<int> projector_darkens_ms = 0;
  std::optional<std::uint64_t> lose_trigger;  ///< the one after this many
  bool lens_on = false;
  bool board_armed = false;
  BoardReport board_told;  ///< as a host asks for it: every so often
  bool projector_on = false;
  Pacing pacing = Pacing::triggered;

  DeviceState lens_state{DevicePhase::ready, {}, 0.0, {}};
  DeviceState board_state{DevicePhase::ready, {}, 0.0, {}};
  DeviceState projector_state{DevicePhase::ready, {}, 0.0, {}};

  double first_edge_s = 0.0;
  std::uint64_t edges = 0;
  std::optional<BoardTable> table;
  std::deque<std::pair<double, std::size_t>> due;  ///< triggers to come
  std::deque<std::vector<Picture>> queue;
  std::size_t in_period = 0;
  ProjectorReport report;
  std::uint64_t triggers = 0;

  void run_until(double time_s) {
    const std::lock_guard lock(mutex);
    while (now_s < time_s) {
      now_s = std::min(now_s + 50e-6, time_s);
      tick();
    }
  }

  bool has_beat() const { return lens_on && edges > 16; }

 private:
  void tick() {
    if (now_s >= board_told.told_s + told_each_s) {
      board_told.told_s = now_s;
      board_told.edges = edges;
      board_told.period_s = has_beat() ? std::optional(period_s) : std::nullopt;
    }
    if (lens_on && now_s >= first_edge_s + static_cast<double>(edges) * period_s) {
      const double edge_s = first_edge_s + static_cast<double>(edges++) * period_s;
      if (board_armed && table) {
        for (std::size_t i = 0; i < table->trigger_s.size(); ++i) due.emplace_back(edge_s + table->trigger_s[i], i);
      }
    }
    while (!due.empty() && due.front().first <= now_s) {
      const double at_s = due.front().first;
      due.pop_front();
      if (!board_armed || !projector_on || triggers++ == lose_trigger) continue;
      show(at_s);
    }
  }

  void show(double at_s) {
    const std::size_t per_period = exposures.back().start_s.size();
    ++report.exposures;
    int code = 0;
    if (queue.empty()) {
      ++report.missed;
    } else if (!queue.front().empty()) {
      code = queue.front()[in_period].codes[0];
    }
    shown.push_back({at_s, code});
    if (++in_period < per_period) return;
    in_period = 0;
    ++report.periods;
    if (!queue.empty()) queue.pop_front();
  }
};

class FakeLens final : public LensDrive {
 public:
  explicit FakeLens(Stagehands& all) : all_(all) {}
  Status open() override { return {}; }
  void close() override {}
  DeviceId id() const override { return {"fake", "lens drive", "1", "here"}; }
  DeviceState state() const override {
    const std::lock_guard lock(all_.mutex);
    return all_.lens_state;
  }
  Status identify() override { return {}; }
  DriveAbilities abilities() const override { return {}; }
  Status start(const DrivePeriod&) override {
    const std::lock_guard lock(all_.mutex);
    ++all_.lens_starts;
    all_.lens_on = true;
    all_.edges = 0;
    all_.first_edge_s = all_.now_s + 0.004;
    return {};
  }
  Result<std::uint64_t> refill(const DrivePeriod&) override {
    const std::lock_guard lock(all_.mutex);
    ++all_.lens_refills;
    return all_.edges + 3;
  }
  bool stop() noexcept override {
    const std::lock_guard lock(all_.mutex);
    all_.lens_stops_in_light += all_.lens_on && all_.projector_on ? 1 : 0;
    all_.lens_on = false;
    all_.lens_state.fault.reset();
    return true;
  }
  DriveReport report() const override {
    const std::lock_guard lock(all_.mutex);
    DriveReport report;
    if (!all_.lens_on || all_.edges == 0) return report;
    report.periods = all_.edges;
    report.newest_period_s = all_.first_edge_s + static_cast<double>(all_.edges - 1) * Stagehands::period_s;
    report.period_s = Stagehands::period_s;
    return report;
  }

 private:
  Stagehands& all_;
};

class FakeBoard final : public TriggerBoard {
 public:
  explicit FakeBoard(Stagehands& all) : all_(all) {}
  Status open() override { return {}; }
  void close() override {}
  DeviceId id() const override { return {"fake", "trigger board", "2", "here"}; }
  DeviceState state() const override {
    const std::lock_guard lock(all_.mutex);
    return all_.board_state;
  }
  Status identify() override { return {}; }
  Status load(const BoardTable& table) override {
    const std::lock_guard lock(all_.mutex);
    all_.table = table;
    all_.tables.push_back(table);
    return {};
  }
  Status arm() override {
    const std::lock_guard lock(all_.mutex);
    if (!all_.has_beat()) return Fault{"board.unsynced", "here", "there is no sync edge", ""};
    all_.board_armed = true;
    return {};
  }
  bool dark() noexcept override {
    const std::lock_guard lock(all_.mutex);
    all_.board_armed = false;
    all_.due.clear();
    all_.board_state.fault.reset();
    return true;
  }
  BoardReport report() const override {
    const std::lock_guard lock(all_.mutex);
    BoardReport report = all_.board_told;
    report.armed = all_.board_armed;
    return report;
  }

 private:
  Stagehands& all_;
};

class FakeProjector final : public ProjectorDevice {
 public:
  explicit FakeProjector(Stagehands& all) : all_(all) {}
  Status open() override { return {}; }
  void close() override {}
  DeviceId id() const override { return {"fake", "projector", "3", "here"}; }
  DeviceState state() const override {
    const std::lock_guard lock(all_.mutex);
    return all_.projector_state;
  }
  Status identify() override { return {}; }
  ProjectorAbilities abilities() const override {
    const std::lock_guard lock(all_.mutex);
    return {8, 4, all_.pacing, 0.0, 3};
  }
  Status arm(const Exposures& exposures) override {
    const std::lock_guard lock(all_.mutex);
    all_.exposures.push_back(exposures);
    return {};
  }
  Status start() override {
    const std::lock_guard lock(all_.mutex);
    all_.projector_on = true;
    all_.report = {};
    all_.in_period = 0;
    all_.queue.clear();
    return {};
  }
  Status post(std::vector<Picture> pictures) override {
    const std::lock_guard lock(all_.mutex);
    if (all_.queue.size() >= 3) return Fault{"projector.full", "projector", "three periods wait", "wait"};
    all_.queue.push_back(std::move(pictures));
    return {};
  }
  bool dark() noexcept override {
    std::this_thread::sleep_for(std::chrono::milliseconds(all_.projector_darkens_ms));
    const std::lock_guard lock(all_.mutex);
    all_.projector_on = false;
    all_.queue.clear();
    all_.projector_state.fault.reset();
    return true;
  }
  ProjectorReport report() const override {
    const std::lock_guard lock(all_.mutex);
    ProjectorReport report = all_.report;
    report.told_s = all_.now_s;
    return report;
  }

 private:
  Stagehands& all_;
};

inline RigDevices devices_of(Stagehands& all) {
  return {std::make_shared<FakeProjector>(all), std::make_shared<FakeLens>(all), std::make_shared<FakeBoard>(all)};
}

/// A picture whose codes all are `code`.
inline Picture picture(int code) {
  auto codes = std::make_shared<std::vector<std::uint8_t>>(32, static_cast<std::uint8_t>(code));
  return {codes, *codes};
}

}  // namespace focalstage::test
