#include "devices/rig/device_hand.h"

#include <chrono>
#include <utility>

namespace focalstage {

namespace {
using std::chrono::milliseconds;
// How often a device that is not there is looked for.
constexpr milliseconds between_openings{500};
// How soon one that could not be told to go dark is told again.
constexpr milliseconds between_tries{20};
}  // namespace

DeviceHand::DeviceHand(std::string name, std::shared_ptr<Device> device, std::function<bool()> dark)
    : name_(std::move(name)),
      device_(std::move(device)),
      dark_(std::move(dark)),
      thread_([this](const std::stop_token& stop) { run(stop); }) {}

DeviceHand::~DeviceHand() {
  thread_.request_stop();
  thread_.join();
  (void)dark_();
  device_->close();
}

void DeviceHand::darken() {
  const std::lock_guard lock(mutex_);
  ++to_darken_;
  asked_.notify_all();
}

bool DeviceHand::settled() {
  const std::lock_guard lock(mutex_);
  return to_darken_ == darkened_;
}

Status DeviceHand::fit() const {
  const DeviceState state = device_->state();
  const bool answers = state.phase == DevicePhase::ready || state.phase == DevicePhase::running;
  if (answers && !state.fault) return {};
  const DeviceId id = device_->id();
  const std::string where = name_ + (id.address.empty() ? "" : " (" + id.address + ")");
  const std::string words = state.fault ? state.fault->message : "it has not answered yet";
  const std::string remedy =
      state.fault && !state.fault->remedy.empty() ? state.fault->remedy : "see that it is plugged in";
  return Fault{"rig.device", where, words, remedy + ", then say go"};
}

void DeviceHand::run(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  while (!stop.stop_requested()) {
    const std::uint64_t wanted = to_darken_;
    const DevicePhase phase = device_->state().phase;
    const bool there = phase == DevicePhase::ready || phase == DevicePhase::running;
    if (wanted != darkened_) {
      lock.unlock();
      const bool done = dark_();
      lock.lock();
      if (done || !there) {
        darkened_ = wanted;
      } else {
        asked_.wait_for(lock, stop, between_tries, [&] { return to_darken_ != wanted; });
      }
      continue;
    }
    if (phase == DevicePhase::off || phase == DevicePhase::lost) {
      lock.unlock();
      (void)device_->open();  // what went wrong is in its state
      lock.lock();
    }
    asked_.wait_for(lock, stop, between_openings, [&] { return to_darken_ != darkened_; });
  }
}

}  // namespace focalstage
