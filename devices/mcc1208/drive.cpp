#include "devices/mcc1208/drive.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "devices/mcc1208/probe.h"
#include "devices/mcc1208/safe.h"
#include "devices/roles/clock.h"

namespace focalstage {

Mcc1208Drive::Mcc1208Drive(const Mcc1208Settings& settings) : settings_(settings) {}

Mcc1208Drive::~Mcc1208Drive() { close(); }

Status Mcc1208Drive::open() {
  const std::lock_guard calls(calls_);
  const DevicePhase phase = state().phase;
  if (phase == DevicePhase::ready || phase == DevicePhase::running) return {};
  drop_session();
  const Status opened = open_unit();
  const std::lock_guard lock(mutex_);
  if (opened) return opened;
  session_.reset();
  const std::string& code = opened.fault().code;
  const bool hopeless = code == "usb.permission" || code == "usb.which" || code == "mcc1208.settings";
  state_.phase = hopeless ? DevicePhase::refused : DevicePhase::lost;
  state_.fault = opened.fault();
  return opened;
}

Status Mcc1208Drive::open_unit() {
  if (const Status sensible = check_mcc1208(settings_); !sensible) return sensible;
  auto found = find_mcc1208(settings_.serial, settings_.answer_s);
  if (!found) return found.fault();
  const auto session = std::make_shared<Session>();
  session->unit = std::move(found->unit);
  UsbBulkCalls calls;
  calls.fill = [this](std::vector<std::uint8_t>& bytes) { stream_.fill(bytes); };
  calls.sent = [this](std::size_t) { stream_.taken(monotonic_s()); };
  calls.failed = [this](const Fault& fault) {
    const std::lock_guard lock(mutex_);
    trouble_ = fault;
    troubled_.notify_all();
  };
  session->queue = std::make_unique<UsbBulkOut>(session->unit->device(), mcc_bulk_out,
                                                std::clamp(settings_.queued_periods, 3, 32), std::move(calls));
  if (const Status stopped = session->unit->scan_stop(); !stopped) return stopped;
  if (const Status line = prepare_enable(*session->unit, settings_); !line) return line;
  if (const Status zero = bring_to_zero(*session->unit, settings_); !zero) return zero;
  {
    const std::lock_guard lock(mutex_);
    session_ = session;
    id_ = found->id;
    trouble_.reset();
    state_ = {DevicePhase::ready, std::nullopt, monotonic_s(), {}};
  }
  watcher_ = std::jthread([this, session](const std::stop_token& stop) { watch(stop, *session); });
  return {};
}

void Mcc1208Drive::close() {
  const std::lock_guard calls(calls_);
  stop();
  drop_session();
  const std::lock_guard lock(mutex_);
  state_ = {};
}

void Mcc1208Drive::drop_session() {
  watcher_.request_stop();
  if (watcher_.joinable()) watcher_.join();
  SessionPtr dropped;  // ends without the lock: its queue waits for its transfers
  const std::lock_guard lock(mutex_);
  dropped.swap(session_);
}

DeviceId Mcc1208Drive::id() const {
  const std::lock_guard lock(mutex_);
  if (!id_.driver.empty()) return id_;
  return {"mcc1208", "USB-1208FS-Plus", settings_.serial, ""};
}

DeviceState Mcc1208Drive::state() const {
  const std::lock_guard lock(mutex_);
  return state_;
}

Status Mcc1208Drive::identify() {
  constexpr int blinks = 10;
  const std::lock_guard calls(calls_);
  SessionPtr session;
  {
    const std::lock_guard lock(mutex_);
    if (state_.phase != DevicePhase::ready) return not_ready();
    session = session_;
  }
  return session->unit->blink(blinks);
}

DriveAbilities Mcc1208Drive::abilities() const {
  return {false, true, mcc1208_most_a(settings_), settings_.samples, true};
}

Status Mcc1208Drive::start(const DrivePeriod& period) {
  const std::lock_guard calls(calls_);
  const auto wave = mcc1208_wave(period, settings_);
  if (!wave) return wave.fault();
  SessionPtr session;
  std::uint64_t stops = 0;
  {
    const std::lock_guard lock(mutex_);
    if (state_.phase != DevicePhase::ready) return not_ready();
    session = session_;
    stops = stops_;
    trouble_.reset();
  }
  const Status launched = launch(*session, *wave);
  if (launched) {
    const std::lock_guard lock(mutex_);
    if (stops == stops_) {
      state_.phase = DevicePhase::running;
      state_.fault.reset();
      return {};
    }
  }
  const Fault why =
      launched ? Fault{"drive.stopped", id().address, "it was stopped while it started", ""} : launched.fault();
  halt_and_tell(*session, launched ? std::nullopt : std::optional(why), stops);
  return why;
}

Status Mcc1208Drive::launch(Session& session, const Mcc1208Wave& wave) {
  MccUnit& unit = *session.unit;
  if (const Status stopped = unit.scan_stop(); !stopped) return stopped;
  if (const Status cleared = unit.clear_fifo(); !cleared) return cleared;
  if (const Status cleared = unit.clear_errors(); !cleared) return cleared;
  if (const Status zero = unit.set_output(0, settings_.zero_code); !zero) return zero;
  if (const Status low = unit.set_output(1, 0); !low) return low;
  if (const Status enabled = set_enable(unit, settings_, true); !enabled) return enabled;
  stream_.begin(wave, mcc1208_lead_in(wave.first_code, mcc_scans_per_s(wave.pacer), settings_));
  if (const Status started = unit.scan_start(wave.pacer); !started) return started;
  stream_.started(monotonic_s());
  return session.queue->start();
}

Result<std::uint64_t> Mcc1208Drive::refill(const DrivePeriod& period) {
  const std::lock_guard calls(calls_);
  auto wave = mcc1208_wave(period, settings_);
  if (!wave) return wave.fault();
  {
    const std::lock_guard lock(mutex_);
    if (state_.phase != DevicePhase::running) {
      return Fault{"drive.off", id_.address, "it does not run", "start it with this period"};
    }
  }
  const auto from = stream_.replace(std::move(*wave));
  if (from) return *from;
  return Fault{"drive.unable", id().address, "a period of another length cannot follow without a gap",
               "stop it and start it with this period"};
}

Status Mcc1208Drive::steer(double period_s, double later_s) {
  const std::lock_guard calls(calls_);
  {
    const std::lock_guard lock(mutex_);
    if (state_.phase != DevicePhase::running) return Fault{"drive.off", id_.address, "it does not run", "start it"};
  }
  if (stream_.steer(period_s, later_s)) return {};
  return Fault{"drive.unable", id().address, "a period of that length is more than a hundredth off the one it plays",
               "stop it and start it with that period"};
}

bool Mcc1208Drive::stop() noexcept {
  try {
    SessionPtr session;
    bool lost = false;
    std::uint64_t stops = 0;
    {
      const std::lock_guard lock(mutex_);
      stops = ++stops_;
      session = session_;
      if (!session) return state_.phase == DevicePhase::off;
      lost = state_.phase == DevicePhase::lost;
    }
    if (lost) return halt(*session).ok();  // it may only have been silent
    halt_and_tell(*session, std::nullopt, stops);
    return state().phase != DevicePhase::lost;
  } catch (...) {
    return false;
  }
}

// The scan first: it ends within a frame of the bus, whatever is queued.
Status Mcc1208Drive::halt(Session& session) {
  const std::lock_guard halting(halting_);
  const Status stopped = session.unit->scan_stop();
  session.queue->stop();
  stream_.ended(monotonic_s());
  if (stopped) return bring_to_zero(*session.unit, settings_);
  if (stopped.fault().code != "usb.lost") {
    (void)session.unit->set_output(0, settings_.zero_code);
    (void)set_enable(*session.unit, settings_, false);
  }
  return stopped;
}

// Zero, and the state afterwards: lost where the device could not be told, with the reason for the stop if there is
// one. Who stopped it last, by the count of `stops`, has the last word of why.
void Mcc1208Drive::halt_and_tell(Session& session, std::optional<Fault> why, std::uint64_t stops) {
  const Status told = halt(session);
  const std::lock_guard lock(mutex_);
  if (session_.get() != &session) return;
  if (!told) {
    state_.phase = DevicePhase::lost;
    state_.fault = why ? *why : told.fault();
    return;
  }
  state_.phase = DevicePhase::ready;
  state_.heard_s = monotonic_s();
  if (stops_ == stops)
    state_.fault = std::move(why);  // told to stop, it has no more to say of why it stopped by itself
}

DriveReport Mcc1208Drive::report() const { return stream_.report(monotonic_s()); }

Fault Mcc1208Drive::not_ready() const {
  if (state_.phase == DevicePhase::running) return {"drive.running", id_.address, "it runs", "stop it first"};
  if (state_.fault) return *state_.fault;
  return {"drive.off", id_.address, "it is not open", "open it"};
}

}  // namespace focalstage
