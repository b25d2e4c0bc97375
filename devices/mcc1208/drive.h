#pragma once

#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <thread>

#include "devices/mcc1208/settings.h"
#include "devices/mcc1208/stream.h"
#include "devices/mcc1208/unit.h"
#include "devices/roles/lens_drive.h"
#include "devices/usb/usb_bulk_out.h"

namespace focalstage {

/// See mcc1208.h. One thread looks at the device's status; libusb's own thread refills the queue.
///
/// `stop` takes neither `calls_` nor any lock that is held while the device is asked something, but for that of another
/// stop. Whoever starts looks whether one came meanwhile (`stops_`), so that whichever comes last, no current flows.
class Mcc1208Drive final : public LensDrive {
 public:
  explicit Mcc1208Drive(const Mcc1208Settings& settings);
  ~Mcc1208Drive() override;

  Status open() override;
  void close() override;
  DeviceId id() const override;
  DeviceState state() const override;
  Status identify() override;

  DriveAbilities abilities() const override;
  Status start(const DrivePeriod& period) override;
  Result<std::uint64_t> refill(const DrivePeriod& period) override;
  Status steer(double period_s, double later_s) override;
  bool stop() noexcept override;
  DriveReport report() const override;

 private:
  /// One unit from its opening on; the queue ends before it.
  struct Session {
    std::unique_ptr<MccUnit> unit;
    std::unique_ptr<UsbBulkOut> queue;
  };
  using SessionPtr = std::shared_ptr<Session>;

  Status open_unit();
  void drop_session();
  Status launch(Session& session, const Mcc1208Wave& wave);
  Status halt(Session& session);
  void halt_and_tell(Session& session, std::optional<Fault> why, std::uint64_t stops);

  void watch(const std::stop_token& stop, Session& session);
  void look(Session& session);
  void look_at_run(Session& session, const MccStatus& status, std::uint64_t stops);
  void give_up(Session& session, const Fault& why, std::uint64_t stops);
  Fault reason(Session& session, const Fault& why);
  void heard();
  Fault not_ready() const;

  const Mcc1208Settings settings_;
  Mcc1208Stream stream_;
  std::mutex calls_;    ///< open, close, start, refill, identify: one after the other
  std::mutex halting_;  ///< one way to zero at a time

  mutable std::mutex mutex_;  ///< what follows; never held while the device is asked
  SessionPtr session_;
  DeviceId id_;
  DeviceState state_;
  std::uint64_t stops_ = 0;
  std::optional<Fault> trouble_;  ///< that the queue met
  std::condition_variable_any troubled_;
  int idle_looks_ = 0;  ///< in a row, at a scan that should run (watch thread only)

  std::jthread watcher_;
};

}  // namespace focalstage
