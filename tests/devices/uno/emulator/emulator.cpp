#include "tests/devices/uno/emulator/emulator.h"

#include <algorithm>
#include <utility>

namespace focalstage::uno_emulator {

namespace {

constexpr Cycle step = 8'000;

}  // namespace

UnoEmulator::UnoEmulator(const Options& options) : options_(options), chip_(options.firmware_elf) { port_.plug_in(); }

void UnoEmulator::run_until(Cycle at) {
  while (chip_.now() < at) {
    pump();
    chip_.run_until(std::min(at, chip_.now() + step));
  }
  pump();
}

void UnoEmulator::see_host() {
  const bool there = port_.host_is_there();
  if (there && !host_was_there_ && options_.resets_when_opened) {
    chip_.reset();
    booting_until_ = chip_.now() + static_cast<Cycle>(options_.boot_s * 16e6);
  }
  host_was_there_ = there;
  if (booting_until_ == 0 || chip_.now() < booting_until_) return;
  booting_until_ = 0;
  chip_.reset();
  chip_.take_bytes();
}

void UnoEmulator::pump() {
  see_host();
  const std::string told = port_.read();
  const std::string said = chip_.take_bytes();
  longest_silence_ = std::max(longest_silence_, chip_.now() - told_at_);
  if (!told.empty()) told_at_ = chip_.now();
  if (booting_until_ != 0) return;
  chip_.send_raw(line_.told(told));
  line_.say(said, chip_.now());
  std::string arrived = line_.arrived(chip_.now());
  if (!host_was_there_) return;
  const std::size_t most = line_.how().unplug_after.value_or(said_ + arrived.size());
  const bool breaks = said_ + arrived.size() > most;
  if (breaks) arrived.resize(most - std::min(most, said_));
  said_ += arrived.size();
  port_.write(arrived);
  if (breaks) unplug();
}

Cycle UnoEmulator::take_longest_silence() { return std::exchange(longest_silence_, 0); }

void UnoEmulator::misbehave(const Misbehaviour& how) {
  line_.misbehave(how);
  said_ = 0;
}

void UnoEmulator::unplug(bool keeps_power) {
  port_.unplug();
  line_.clear();
  host_was_there_ = false;
  booting_until_ = 0;
  keeps_power_ = keeps_power;
  if (!keeps_power) chip_.reset();
}

void UnoEmulator::plug_in() {
  if (port_.plugged_in()) return;
  port_.plug_in();
  if (!keeps_power_) chip_.reset();
  chip_.take_bytes();
}

}  // namespace focalstage::uno_emulator
