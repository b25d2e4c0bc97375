#include <chrono>

#include "devices/mcc1208/drive.h"
#include "devices/roles/clock.h"

namespace focalstage {

namespace {

// So many looks in a row at a scan that does not run are no coincidence with its beginning.
constexpr int most_idle_looks = 2;
// From saying that it is to end to its end: as long as a rig takes to put out its light.
constexpr double said_before_s = 0.03;

}  // namespace

void Mcc1208Drive::watch(const std::stop_token& stop, Session& session) {
  while (!stop.stop_requested()) {
    std::optional<Fault> trouble;
    std::uint64_t stops = 0;
    {
      std::unique_lock lock(mutex_);
      const bool said = state_.phase == DevicePhase::running && state_.fault;
      troubled_.wait_for(lock, stop, std::chrono::duration<double>(said ? said_before_s : settings_.watch_s),
                         [this] { return trouble_.has_value(); });
      trouble.swap(trouble_);
      stops = stops_;
      if (state_.phase == DevicePhase::lost) continue;
    }
    if (stop.stop_requested()) return;
    if (trouble) {
      give_up(session, reason(session, *trouble), stops);
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
    if (gone || monotonic_s() - was.heard_s > settings_.silence_s) give_up(session, status.fault(), stops);
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
  if (was.fault) {
    give_up(session, *was.fault, stops);  // said a look ago: who leads the light has heard it
  } else {
    look_at_run(session, *status, stops);
  }
}

void Mcc1208Drive::look_at_run(Session& session, const MccStatus& status, std::uint64_t stops) {
  const std::string where = id().address;
  idle_looks_ = status.scan_running ? 0 : idle_looks_ + 1;
  if (status.underrun) {
    give_up(session, reason(session, {"usb.stall", where, "", ""}), stops);
  } else if (idle_looks_ >= most_idle_looks) {
    give_up(session, {"drive.stalled", where, "the device ended its scan by itself", "start it again"}, stops);
  } else if (monotonic_s() - stream_.taken_s() > settings_.silence_s) {
    // It still plays what it has. Said first, so that light does not find its lenses at rest.
    const std::lock_guard lock(mutex_);
    if (stops_ != stops) return;
    state_.fault = Fault{"drive.stalled", where, "the device takes no more samples", "plug it in again"};
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

// Of a run that was told to stop meanwhile there is nothing to give up.
void Mcc1208Drive::give_up(Session& session, const Fault& why, std::uint64_t stops) {
  idle_looks_ = 0;
  {
    const std::lock_guard lock(mutex_);
    if (stops_ != stops) return;
    stops = ++stops_;
  }
  halt_and_tell(session, why, stops);
  if (why.code != "usb.timeout") return;
  const std::lock_guard lock(mutex_);  // it may have heard the last word; it is lost all the same
  state_.phase = DevicePhase::lost;
  state_.fault = why;
}

}  // namespace focalstage
