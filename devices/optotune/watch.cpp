#include <chrono>

#include "devices/optotune/driver.h"
#include "devices/roles/clock.h"

namespace focalstage {

namespace {

constexpr double silence_s = 0.3;    // without a good answer for so long it is lost
constexpr double cooled_by_c = 1.0;  // below warm, before it may be driven again

}  // namespace

void OptotuneDriver::watch(const std::stop_token& stop) {
  double temperature_due_s = 0.0;
  while (!stop.stop_requested()) {
    const bool at_temperature = monotonic_s() >= temperature_due_s;
    if (at_temperature) temperature_due_s = monotonic_s() + settings_.temperature_s;
    look(at_temperature);
    std::unique_lock lock(mutex_);
    woken_.wait_for(lock, stop, std::chrono::duration<double>(settings_.watch_s), [] { return false; });
  }
}

void OptotuneDriver::look(bool at_temperature) {
  const std::lock_guard held(line_mutex_);
  if (state().phase == DevicePhase::lost || !line_) return;
  Status looked = look_at_mode();
  if (looked && at_temperature) looked = look_at_temperature();
  if (!looked) failed(looked.fault());
}

Status OptotuneDriver::look_at_mode() {
  const auto answer = line_->ask(optotune_ask_mode());
  if (!answer) return answer.fault();
  const auto mode = static_cast<OptotuneMode>((*answer)[3]);
  note_heard();
  const auto wanted = [this, mode] {
    const std::lock_guard lock(mutex_);
    report_.mode = mode;
    return wanted_;
  }();
  if (mode == wanted) return {};
  const Fault why{"optotune.mode", id().address, "it left its mode by itself: it was reset, or another program has it",
                  "see its power, and set it again"};
  const auto set = line_->ask(*optotune_set_mode(OptotuneMode::current));
  note_zero(set ? to_zero() : Status(set.fault()), why);
  return {};
}

Status OptotuneDriver::look_at_temperature() {
  const auto counts = line_->ask_number(optotune_ask_temperature());
  if (!counts) return counts.fault();
  const auto status = line_->ask(optotune_ask_status());
  if (!status) return status.fault();
  note_heard();
  const double celsius = optotune_celsius(*counts);
  bool too_hot = false;
  {
    const std::lock_guard lock(mutex_);
    report_.celsius = celsius;
    report_.status = optotune_status(*status).value_or(OptotuneStatus{});
    report_.warm = celsius >= settings_.warm_celsius;
    state_.temperatures = {{"lens", celsius}};
    too_hot = celsius >= settings_.hot_celsius;
    if (too_hot) hot_ = true;
    if (celsius < settings_.warm_celsius - cooled_by_c) hot_ = false;
  }
  if (!too_hot) return {};
  const Fault why{"optotune.hot", id().address, "the lens is at " + std::to_string(celsius) + " C",
                  "let it cool; give it less current or more air"};
  note_zero(to_zero(), why);
  return {};
}

// With the line. One answer that is missing or damaged may be chance.
void OptotuneDriver::failed(const Fault& why) {
  const bool gone = why.code == "serial.gone";
  if (!gone && monotonic_s() - state().heard_s < silence_s) return;
  (void)line_->tell(optotune_set_current(0));
  const std::lock_guard lock(mutex_);
  state_.phase = DevicePhase::lost;
  state_.fault = why;
}

void OptotuneDriver::note_heard() {
  const std::lock_guard lock(mutex_);
  state_.heard_s = monotonic_s();
}

}  // namespace focalstage
