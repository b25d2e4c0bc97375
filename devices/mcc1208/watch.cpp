#include <chrono>

#include "devices/mcc1208/drive.h"
#include "devices/roles/clock.h"

namespace focalstage {

namespace {

// So many looks in a row at a scan that does not run are no coincidence with its beginning.
constexpr int most_idle_looks = 2;

}  // namespace

void Mcc1208Drive::watch(const std::stop_token& stop, Session& session) {
  while (!stop.stop_requested()) {
    std::optional<Fault> trouble;
    {
      std::unique_lock lock(mutex_);
      troubled_.wait_for(lock, stop, std::chrono::duration<double>(settings_.watch_s),
                         [this] { return trouble_.has_value(); });
      trouble.swap(trouble_);
      if (state_.phase == DevicePhase::lost) continue;
    }
    if (stop.stop_requested()) return;
    if (trouble) {
      give_up(session, reason(session, *trouble));
    } else {
      look(session);
    }
  }
}

void Mcc1208Drive::look(Session& session) {
  const auto [was, stops] = [this] {
    const std::lock_guard lock(mutex_);
    return std::pair(state_, stops_);
  }();
  const auto status = session.unit->status();
  if (!status) {
    const bool gone = status.fault().code == "usb.lost";
    if (gone || monotonic_s() - was.heard_s > settings_.silence_s) give_up(session, status.fault());
    return;
  }
  {
    const std::lock_guard lock(mutex_);
    state_.heard_s = monotonic_s();
    if (was.phase != DevicePhase::running || state_.phase != DevicePhase::running || stops != stops_) {
      idle_looks_ = 0;
      return;
    }
  }
  look_at_run(session, *status);
}

void Mcc1208Drive::look_at_run(Session& session, const MccStatus& status) {
  const std::string where = id().address;
  idle_looks_ = status.scan_running ? 0 : idle_looks_ + 1;
  if (status.underrun) {
    give_up(session, reason(session, {"usb.stall", where, "", ""}));
  } else if (idle_looks_ >= most_idle_looks) {
    give_up(session, {"drive.stalled", where, "the device ended its scan by itself", "start it again"});
  } else if (monotonic_s() - stream_.taken_s() > settings_.silence_s) {
    give_up(session, {"drive.stalled", where, "the device takes no more samples", "plug it in again"});
  }
}

// A refused transfer is an underrun where the device says so.
Fault Mcc1208Drive::reason(Session& session, const Fault& why) {
  if (why.code != "usb.stall") return why;
  const auto status = session.unit->status();
  if (!status || !status->underrun) return why;
  stream_.underrun();
  return {"drive.underrun", why.where, "the device had no samples left to play: the host came too late",
          "start it again; a busy host needs more queued_periods"};
}

void Mcc1208Drive::give_up(Session& session, const Fault& why) {
  idle_looks_ = 0;
  {
    const std::lock_guard lock(mutex_);
    ++stops_;
  }
  halt_and_tell(session, why);
  if (why.code != "usb.timeout") return;
  const std::lock_guard lock(mutex_);  // it may have heard the last word; it is lost all the same
  state_.phase = DevicePhase::lost;
  state_.fault = why;
}

}  // namespace focalstage
