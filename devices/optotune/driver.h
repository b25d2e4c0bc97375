#pragma once

#include <condition_variable>
#include <mutex>
#include <optional>
#include <stop_token>
#include <thread>

#include "devices/optotune/line.h"
#include "devices/optotune/optotune.h"

namespace focalstage {

/// See optotune.h. One thread looks whether the device is there and how warm the lens is.
class OptotuneDriver final : public OptotuneLens {
 public:
  explicit OptotuneDriver(const OptotuneSettings& settings);
  ~OptotuneDriver() override;

  Status open() override;
  void close() override;
  DeviceId id() const override;
  DeviceState state() const override;
  Status identify() override;

  Status set_current(double amperes) override;
  Status follow_input() override;
  bool stop() noexcept override;
  OptotuneReport report() const override;

 private:
  Status open_line();
  Status set_up(OptotuneLine& line, OptotuneReport& report);
  Status set_limits(OptotuneLine& line, OptotuneReport& report);
  Status ready_to_drive() const;
  Status to_zero();
  void end_watch();
  void watch(const std::stop_token& stop);
  void look(bool at_temperature);
  Status look_at_mode();
  Status look_at_temperature();
  void failed(const Fault& why);
  void note_heard();
  void note_zero(const Status& told, std::optional<Fault> why);

  const OptotuneSettings settings_;
  std::mutex calls_;  ///< open and close, one after the other

  std::timed_mutex line_mutex_;  ///< one question at a time: held for two answers' deadlines at most
  std::optional<OptotuneLine> line_;

  mutable std::mutex mutex_;  ///< what follows; never held while the device is asked
  DeviceId id_;
  DeviceState state_;
  OptotuneReport report_;
  OptotuneMode wanted_ = OptotuneMode::current;
  bool hot_ = false;
  std::condition_variable_any woken_;

  std::jthread watcher_;
};

}  // namespace focalstage
