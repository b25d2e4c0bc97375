#include "devices/optotune/driver.h"

#include <chrono>
#include <cmath>
#include <utility>

#include "devices/optotune/probe.h"
#include "devices/roles/clock.h"

namespace focalstage {

namespace {

constexpr int halvings = 5;

}  // namespace

std::unique_ptr<OptotuneLens> make_optotune(const OptotuneSettings& settings) {
  return std::make_unique<OptotuneDriver>(settings);
}

OptotuneDriver::OptotuneDriver(const OptotuneSettings& settings) : settings_(settings) {}

OptotuneDriver::~OptotuneDriver() { close(); }

Status OptotuneDriver::open() {
  const std::lock_guard calls(calls_);
  const DevicePhase phase = state().phase;
  if (phase == DevicePhase::ready || phase == DevicePhase::running) return {};
  end_watch();
  const Status opened = open_line();
  if (opened) {
    watcher_ = std::jthread([this](const std::stop_token& stop) { watch(stop); });
    return opened;
  }
  const std::lock_guard line(line_mutex_);
  line_.reset();
  const std::lock_guard lock(mutex_);
  const std::string& code = opened.fault().code;
  const bool hopeless = code == "optotune.which" || code == "optotune.limit" || code == "optotune.stranger";
  state_.phase = hopeless ? DevicePhase::refused : DevicePhase::lost;
  state_.fault = opened.fault();
  return opened;
}

Status OptotuneDriver::open_line() {
  const auto found = find_optotune(settings_.serial, settings_.search);
  if (!found) return found.fault();
  const std::lock_guard held(line_mutex_);
  line_.reset();  // before the port is opened again
  auto port = SerialPort::open(found->address);
  if (!port) return port.fault();
  line_.emplace(std::move(*port), settings_.answer_s, settings_.refusal_s);
  OptotuneReport report;
  if (const Status set = set_up(*line_, report); !set) return set;
  const std::lock_guard lock(mutex_);
  id_ = *found;
  report_ = report;
  wanted_ = OptotuneMode::current;
  hot_ = false;
  state_ = {DevicePhase::ready, std::nullopt, monotonic_s(), {}};
  return {};
}

void OptotuneDriver::close() {
  const std::lock_guard calls(calls_);
  stop();
  end_watch();
  const std::lock_guard line(line_mutex_);
  line_.reset();
  const std::lock_guard lock(mutex_);
  state_ = {};
}

void OptotuneDriver::end_watch() {
  watcher_.request_stop();
  if (watcher_.joinable()) watcher_.join();
}

DeviceId OptotuneDriver::id() const {
  const std::lock_guard lock(mutex_);
  if (!id_.driver.empty()) return id_;
  return {"optotune", "Lens Driver 4", settings_.serial, ""};
}

DeviceState OptotuneDriver::state() const {
  const std::lock_guard lock(mutex_);
  return state_;
}

OptotuneReport OptotuneDriver::report() const {
  const std::lock_guard lock(mutex_);
  return report_;
}

// It has no lamp of its own: the lens moves, by a current that nobody need fear.
Status OptotuneDriver::identify() {
  constexpr double wiggle_a = 0.05;
  if (state().phase == DevicePhase::running) {
    return Fault{"optotune.running", id().address, "it gives out a current", "stop it first"};
  }
  for (const double amperes : {wiggle_a, -wiggle_a, wiggle_a, -wiggle_a}) {
    if (const Status set = set_current(amperes); !set) return set;
    sleep_until(monotonic_s() + 0.2);
  }
  if (!stop()) return state().fault.value_or(Fault{"serial.timeout", id().address, "it could not be stopped", ""});
  return {};
}

// With mutex_.
Status OptotuneDriver::ready_to_drive() const {
  if (state_.phase != DevicePhase::ready && state_.phase != DevicePhase::running) {
    return state_.fault.value_or(Fault{"optotune.off", id_.address, "it is not open", "open it"});
  }
  if (hot_) return Fault{"optotune.hot", id_.address, "the lens is still hot", "wait until it has cooled"};
  return {};
}

Status OptotuneDriver::set_current(double amperes) {
  if (!std::isfinite(amperes)) return Fault{"optotune.unable", id().address, "the current is no number", ""};
  const std::lock_guard held(line_mutex_);
  double most_a = 0.0;
  {
    const std::lock_guard lock(mutex_);
    if (const Status ready = ready_to_drive(); !ready) return ready;
    if (wanted_ != OptotuneMode::current) {
      return Fault{"optotune.mode", id_.address, "its analogue input gives the current", "stop it first"};
    }
    most_a = report_.most_a;
    if (std::abs(amperes) > most_a) ++report_.clamped;
  }
  const int counts = optotune_counts(amperes, most_a);
  if (const Status told = line_->tell(optotune_set_current(counts)); !told) return told;
  const std::lock_guard lock(mutex_);
  report_.asked_a = optotune_amperes(counts, most_a);
  state_.phase = counts == 0 ? DevicePhase::ready : DevicePhase::running;
  state_.fault.reset();
  return {};
}

Status OptotuneDriver::follow_input() {
  const std::lock_guard held(line_mutex_);
  {
    const std::lock_guard lock(mutex_);
    if (const Status ready = ready_to_drive(); !ready) return ready;
  }
  if (const Status zero = line_->tell(optotune_set_current(0)); !zero) return zero;
  if (const auto mode = line_->ask(*optotune_set_mode(OptotuneMode::analogue)); !mode) return mode.fault();
  const std::lock_guard lock(mutex_);
  wanted_ = OptotuneMode::analogue;
  report_.mode = wanted_;
  report_.asked_a = 0.0;
  state_.phase = DevicePhase::running;
  state_.fault.reset();
  return {};
}

bool OptotuneDriver::stop() noexcept {
  try {
    const DevicePhase phase = state().phase;
    if (phase == DevicePhase::off) return true;
    const std::unique_lock held(line_mutex_, std::chrono::duration<double>(2.5 * settings_.answer_s));
    if (!held.owns_lock() || !line_) return false;
    const Status told = to_zero();
    if (phase == DevicePhase::ready || phase == DevicePhase::running) note_zero(told, std::nullopt);
    return told.ok();  // one that is lost stays it, even if it was only silent
  } catch (...) {
    return false;
  }
}

// With the line. In current mode by halves; in analogue mode the mode's end is the end of the current.
Status OptotuneDriver::to_zero() {
  const auto [mode, asked_a, most_a] = [this] {
    const std::lock_guard lock(mutex_);
    return std::tuple(wanted_, report_.asked_a, report_.most_a);
  }();
  if (mode != OptotuneMode::current) {
    if (const auto set = line_->ask(*optotune_set_mode(OptotuneMode::current)); !set) return set.fault();
  }
  double left_a = mode == OptotuneMode::current ? asked_a : 0.0;
  for (int i = 0; i < halvings && left_a != 0.0; ++i) {
    left_a /= 2.0;
    if (const Status told = line_->tell(optotune_set_current(optotune_counts(left_a, most_a))); !told) return told;
    sleep_until(monotonic_s() + settings_.ramp_step_s);
  }
  if (const Status told = line_->tell(optotune_set_current(0)); !told) return told;
  const auto flows = line_->ask_number(optotune_ask_current());  // nothing said is no proof
  if (!flows) return flows.fault();
  if (*flows == 0) return {};
  return Fault{"optotune.current", id().address, "it says that a current flows though it was told none",
               "take the lens off its power"};
}

void OptotuneDriver::note_zero(const Status& told, std::optional<Fault> why) {
  const std::lock_guard lock(mutex_);
  if (!told) {
    state_.phase = DevicePhase::lost;
    state_.fault = why ? std::move(why) : std::optional(told.fault());
    return;
  }
  wanted_ = OptotuneMode::current;
  report_.mode = wanted_;
  report_.asked_a = 0.0;
  state_.phase = DevicePhase::ready;
  state_.fault = std::move(why);  // told to stop, it has no more to say of why it stopped by itself
}

}  // namespace focalstage
