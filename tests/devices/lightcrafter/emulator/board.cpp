#include "tests/devices/lightcrafter/emulator/board.h"

#include <algorithm>
#include <utility>

namespace focalstage::lightcrafter_emulator {

namespace {

std::uint32_t number(std::span<const std::uint8_t> data, std::size_t at, std::size_t bytes) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < bytes; ++i) value |= static_cast<std::uint32_t>(data[at + i]) << (8 * i);
  return value;
}

}  // namespace

Answers Board::take(std::span<const std::uint8_t> report) {
  const std::lock_guard lock(mutex_);
  Answers answers;
  answers.delay_s = how_.delay_s;
  bytes_ += report.size();
  if (how_.disconnect_after_bytes && bytes_ > *how_.disconnect_after_bytes) {
    pending_.clear();
    missing_ = 0;
    answers.gone = true;
    return answers;
  }
  if (how_.deaf || report.size() != 64) return answers;
  if (missing_ == 0) {
    pending_.assign(report.begin(), report.end());
    const std::size_t length = number(report, 2, 2);
    missing_ = length > 60 ? length - 60 : 0;
  } else {
    pending_.insert(pending_.end(), report.begin(), report.end());
    missing_ -= std::min<std::size_t>(missing_, 64);
  }
  if (missing_ == 0) message(answers);
  if (how_.silent) answers.reports.clear();
  if (how_.short_read) {
    for (Bytes& bytes : answers.reports) bytes.resize(3);
  }
  return answers;
}

Bytes Board::answer(std::uint8_t flags, std::uint8_t sequence, const Bytes& data) const {
  std::uint8_t echoed = options_.echo_sequence ? sequence : std::uint8_t{0};
  if (how_.wrong_sequence) echoed = static_cast<std::uint8_t>(echoed + 77);
  Bytes bytes(64, 0);
  bytes[0] = flags;
  bytes[1] = echoed;
  bytes[2] = static_cast<std::uint8_t>(data.size());
  std::ranges::copy(data, bytes.begin() + 4);
  return bytes;
}

void Board::message(Answers& answers) {
  ++messages_;
  const std::uint8_t flags = pending_[0];
  const std::uint8_t sequence = pending_[1];
  const std::size_t length = number(pending_, 2, 2);
  const bool reading = (flags & 0x80) != 0;
  bool refused = length < 2 || length > 512 || (flags & 7) != 0 || how_.refuses_all;
  Bytes data;
  if (!refused) {
    const auto command = static_cast<std::uint16_t>(pending_[5] << 8 | pending_[4]);
    refused = how_.refuses == command;
    if (!refused && reading) {
      if (auto found = read(command)) {
        data = *found;
      } else {
        refused = true;
      }
    } else if (!refused) {
      history_.push_back(command);
      refused = write(command, std::span(pending_).subspan(6, length - 2)) == Verdict::refused;
    }
  }
  if (refused) ++refusals_;
  if ((flags & 0x40) == 0) return;
  if (how_.stale_first) {
    answers.reports.push_back(reading ? answer(0x40, 200, {})
                                      : answer(0x40, static_cast<std::uint8_t>(sequence - 9), {}));
  }
  const auto kind = static_cast<std::uint8_t>((reading ? 0xC0 : 0x40) | (refused ? 0x20 : 0x00));
  answers.reports.push_back(answer(kind, sequence, data));
}

Board::Verdict Board::write(std::uint16_t command, std::span<const std::uint8_t> data) {
  switch (command) {
    case 0x0200:
    case 0x0609:
    case 0x0B01:
    case 0x100A:
    case 0x1A00:
    case 0x1A05:
    case 0x1A07:
    case 0x1A1A:
    case 0x1A24:
      return write_running(command, data);
    case 0x1A32:
    case 0x1A33:
    case 0x1A34:
    case 0x1A3E:
    case 0x1A3F:
    case 0x1A1B:
    case 0x1A1D:
    case 0x1A1E:
    case 0x1A22:
    case 0x1A23:
    case 0x1A29:
    case 0x1A31:
    case 0x1A40:
      if (options_.strict && running_) return Verdict::refused;
      validated_ = false;
      first_start_ = true;
      return command >= 0x1A32 && command <= 0x1A3F ? write_mailbox(command, data) : write_setting(command, data);
    default:
      return Verdict::refused;
  }
}

Board::Verdict Board::write_running(std::uint16_t command, std::span<const std::uint8_t> data) {
  if (data.size() < (command == 0x0B01 ? 3U : 1U)) return Verdict::refused;
  if (how_.keeps_shining && (command == 0x1A24 || command == 0x1A07) && data[0] == 0) return Verdict::done;
  switch (command) {
    case 0x0200:
      awake_ = data[0] == 0;
      if (!awake_) running_ = false;
      return Verdict::done;
    case 0x0609:
      parked_ = data[0] == 1;
      return Verdict::done;
    case 0x100A:
      frozen_ = data[0] == 1;
      return Verdict::done;
    case 0x0B01:
      std::copy_n(data.begin(), 3, current_.begin());
      return Verdict::done;
    case 0x1A00:
      input_source_ = data[0];
      return Verdict::done;
    case 0x1A05:
      invert_pwm_ = data[0] == 1;
      return Verdict::done;
    case 0x1A07:
      led_enable_ = data[0] & 0x0F;
      return Verdict::done;
    case 0x1A1A:
      if (running_) return Verdict::refused;
      validating_ = options_.validation_polls + 1;
      return Verdict::done;
    default:
      break;
  }
  if (data[0] > 2) return Verdict::refused;
  if (data[0] < 2) {
    paused_ = data[0] == 1 && running_;
    running_ = false;
    return Verdict::done;
  }
  if (!pattern_mode_ || !awake_ || (options_.strict && !validated_)) return Verdict::refused;
  const bool heard = !(options_.start_twice && std::exchange(first_start_, false));
  running_ = heard && !how_.never_runs;
  aborted_ = false;
  busy_until_s_ = -1e9;
  return Verdict::done;
}

Board::Verdict Board::write_setting(std::uint16_t command, std::span<const std::uint8_t> data) {
  const auto has = [&](std::size_t bytes) { return data.size() >= bytes; };
  switch (command) {
    case 0x1A1B:
      if (!has(1) || data[0] > 1) return Verdict::refused;
      pattern_mode_ = data[0] == 1;
      return Verdict::done;
    case 0x1A1D:
      return has(3) && data[1] <= 0xD5 && data[2] <= 0xD5 ? Verdict::done : Verdict::refused;
    case 0x1A1E:
      return has(2) && data[1] <= 0xD5 ? Verdict::done : Verdict::refused;
    case 0x1A22:
      if (!has(1) || (data[0] != 0 && data[0] != 3)) return Verdict::refused;
      source_ = data[0];
      return Verdict::done;
    case 0x1A23:
      if (!has(1) || data[0] > 4) return Verdict::refused;
      trigger_mode_ = data[0];
      return Verdict::done;
    case 0x1A29:
      if (!has(8)) return Verdict::refused;
      exposure_us_ = number(data, 0, 4);
      period_us_ = number(data, 4, 4);
      return Verdict::done;
    case 0x1A31:
      if (!has(4) || data[0] > 127) return Verdict::refused;
      entries_ = data[0] + 1;
      repeat_ = data[1] == 1;
      return Verdict::done;
    default:
      if (!has(6) || number(data, 0, 2) > 1823) return Verdict::refused;
      variable_entries_ = static_cast<int>(number(data, 0, 2)) + 1;
      repeat_ = data[5] == 1;
      return Verdict::done;
  }
}

Board::Verdict Board::write_mailbox(std::uint16_t command, std::span<const std::uint8_t> data) {
  const auto entry_of = [](std::uint32_t word) {
    Entry entry;
    entry.trigger = static_cast<int>(word & 3U);
    entry.pattern = static_cast<int>(word >> 2 & 0x3FU);
    entry.bits = static_cast<int>(word >> 8 & 0xFU);
    entry.leds = static_cast<int>(word >> 12 & 7U);
    entry.invert = (word >> 16 & 1U) != 0;
    entry.black_after = (word >> 17 & 1U) != 0;
    return entry;
  };
  switch (command) {
    case 0x1A33:
      if (data.empty() || data[0] > 3) return Verdict::refused;
      mailbox_ = data[0];
      return Verdict::done;
    case 0x1A32:
      if (mailbox_ == 0 || data.empty() || data[0] > 127) return Verdict::refused;
      address_ = data[0];
      return Verdict::done;
    case 0x1A34:
      if (mailbox_ == 1) return Verdict::done;
      if (mailbox_ != 2 || data.size() % 3 != 0 || address_ + data.size() / 3 > 128) return Verdict::refused;
      for (std::size_t i = 0; i < data.size(); i += 3) fixed_[address_++] = entry_of(number(data, i, 3));
      return Verdict::done;
    case 0x1A3F:
      if (mailbox_ != 3 || data.size() < 2 || number(data, 0, 2) > 1823) return Verdict::refused;
      variable_address_ = number(data, 0, 2);
      return Verdict::done;
    case 0x1A3E: {
      if (mailbox_ != 3 || data.size() < 12 || variable_address_ > 1823) return Verdict::refused;
      Entry entry = entry_of(number(data, 0, 4));
      entry.exposure_us = number(data, 4, 4);
      entry.period_us = number(data, 8, 4);
      variable_[variable_address_] = entry;
      return Verdict::done;
    }
    default:
      return Verdict::refused;
  }
}

std::optional<Bytes> Board::read(std::uint16_t command) {
  const auto byte = [](bool value) { return static_cast<std::uint8_t>(value ? 1 : 0); };
  switch (command) {
    case 0x0200:
      return Bytes{byte(!awake_)};
    case 0x0205: {
      Bytes version(16, 0);
      version[2] = 3;
      version[3] = 4;
      return version;
    }
    case 0x071C: {
      Bytes signal(28, 0);
      for (const std::size_t at : {1U, 20U}) {
        signal[at] = static_cast<std::uint8_t>(options_.signal_width & 0xFF);
        signal[at + 1] = static_cast<std::uint8_t>(options_.signal_width >> 8);
        signal[at + 2] = static_cast<std::uint8_t>(options_.signal_height & 0xFF);
        signal[at + 3] = static_cast<std::uint8_t>(options_.signal_height >> 8);
      }
      return signal;
    }
    case 0x0B01:
      return Bytes(current_.begin(), current_.end());
    case 0x1A00:
      return Bytes{input_source_};
    case 0x1A07:
      return Bytes{led_enable_};
    case 0x1A0A:
      return Bytes{static_cast<std::uint8_t>((0x01 | (aborted_ ? 0x40 : 0)) ^ how_.hardware_bits)};
    case 0x1A0B:
      return Bytes{1};
    case 0x1A0C:
      return Bytes{static_cast<std::uint8_t>(byte(parked_) | byte(running_) << 1 | byte(frozen_) << 2)};
    case 0x1A1A:
      if (validating_ > 1 || (validating_ == 1 && how_.validates_for_ever)) {
        validating_ = std::max(1, validating_ - 1);
        return Bytes{0x80};
      }
      if (validating_ == 1) {
        validating_ = 0;
        validated_ = (check() & 3) == 0;
      }
      return Bytes{check()};
    case 0x1A1B:
      return Bytes{byte(pattern_mode_)};
    case 0x1A22:
      return Bytes{source_};
    case 0x1A23:
      return Bytes{trigger_mode_};
    case 0x1A24:
      return Bytes{static_cast<std::uint8_t>(running_ ? 2 : paused_ ? 1 : 0)};
    default:
      return std::nullopt;
  }
}

void Board::misbehave(const Misbehaviour& how) {
  const std::lock_guard lock(mutex_);
  how_ = how;
  bytes_ = 0;
}

void Board::stumble() {
  const std::lock_guard lock(mutex_);
  running_ = false;
}

void Board::power_cycle() {
  const std::lock_guard lock(mutex_);
  running_ = paused_ = validated_ = pattern_mode_ = aborted_ = false;
  awake_ = first_start_ = true;
  led_enable_ = 8;
  current_ = {0x97, 0x78, 0x7D};
  mailbox_ = trigger_mode_ = source_ = 0;
  pending_.clear();
  missing_ = 0;
}

bool Board::running() const {
  const std::lock_guard lock(mutex_);
  return running_;
}

std::uint64_t Board::messages() const {
  const std::lock_guard lock(mutex_);
  return messages_;
}

std::uint64_t Board::refusals() const {
  const std::lock_guard lock(mutex_);
  return refusals_;
}

std::vector<std::uint16_t> Board::history() const {
  const std::lock_guard lock(mutex_);
  return history_;
}

double Board::brightness() const {
  const std::lock_guard lock(mutex_);
  return (255 - current_[0]) / 255.0;
}

}  // namespace focalstage::lightcrafter_emulator
