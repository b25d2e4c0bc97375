#include "tests/devices/mcc1208/emulator/device.h"

#include <algorithm>
#include <utility>

namespace focalstage::mcc1208_emulator {

namespace {

constexpr std::size_t packet = 64;
constexpr Answer refused() { return {Reply::stall, {}}; }

std::uint32_t u32(std::span<const std::uint8_t> bytes, std::size_t at) {
  return bytes[at] | std::uint32_t{bytes[at + 1]} << 8 | std::uint32_t{bytes[at + 2]} << 16 |
         std::uint32_t{bytes[at + 3]} << 24;
}

void put_u16(Bytes& bytes, int value) {
  bytes.push_back(static_cast<std::uint8_t>(value & 0xff));
  bytes.push_back(static_cast<std::uint8_t>(value >> 8));
}

}  // namespace

void Device::power_on() {
  codes_ = {};
  latch_ = {};
  input_ = {true, true};
  fifo_.clear();
  running_ = underrun_ = halted_ = false;
  outputs_.push_back({now_s_, std::nullopt, codes_});
}

Answer Device::control(const Setup& setup, std::span<const std::uint8_t> data, const Misbehaviour& how) {
  requests_.push_back({setup, Bytes(data.begin(), data.end())});
  if (how.silent) return {Reply::none, {}};
  if (std::find(how.stalled.begin(), how.stalled.end(), setup.request) != how.stalled.end()) return refused();
  Answer answered = answer(setup, data, how);
  if (answered.data.size() > setup.length) answered.data.resize(setup.length);
  return answered;
}

Answer Device::answer(const Setup& setup, std::span<const std::uint8_t> data, const Misbehaviour& how) {
  const bool in = setup.type == 0xc0;
  if (!in && setup.type != 0x40) return refused();
  switch (setup.request) {
    case 0x00:
    case 0x01:
    case 0x02:
      return answer_port(setup, in);
    case 0x18:
      return answer_output(setup, in);
    case 0x1a:
      return !in && start_scan(data) ? Answer{} : refused();
    case 0x1b:
      if (!in) running_ = false;
      return in ? refused() : Answer{};
    case 0x1c:
      if (!in) fifo_.clear();
      return in ? refused() : Answer{};
    case 0x41:
      return in || data.size() != 1 ? refused() : Answer{};
    case 0x44: {
      if (!in) {
        underrun_ = false;
        return {};
      }
      Answer status;
      put_u16(status.data, (running_ ? 1 << 3 : 0) | (underrun_ ? 1 << 4 : 0) | how.status_bits);
      return status;
    }
    case 0x48:
      return in ? Answer{Reply::ok, Bytes(options_.serial.begin(), options_.serial.end())} : refused();
    default:
      return refused();
  }
}

Answer Device::answer_port(const Setup& setup, bool in) {
  if (setup.index > 1) return refused();
  const std::size_t port = setup.index;
  if (in) {
    const std::uint8_t direction = input_[port] ? 1 : 0;
    return {Reply::ok, {setup.request == 0 ? direction : latch_[port]}};
  }
  if (setup.request == 1) return refused();
  if (setup.request == 0) input_[port] = setup.value != 0;
  if (setup.request == 2) latch_[port] = static_cast<std::uint8_t>(setup.value);
  return {};
}

Answer Device::answer_output(const Setup& setup, bool in) {
  if (in) {
    Answer codes;
    for (const int code : codes_) put_u16(codes.data, code);
    return codes;
  }
  if (running_ || setup.index > 1 || setup.value > 4095) return refused();
  codes_[setup.index] = setup.value;
  outputs_.push_back({now_s_, std::nullopt, codes_});
  return {};
}

bool Device::start_scan(std::span<const std::uint8_t> data) {
  if (data.size() != 9 || running_ || (data[8] & 3) == 0) return false;
  count_ = u32(data, 0);
  pacer_ = u32(data, 4);
  options_byte_ = data[8];
  if (scan_s() < 1.0 / 50e3) return false;
  running_ = true;
  underrun_ = false;
  first_scan_s_.reset();
  scans_ = 0;
  return true;
}

std::size_t Device::scan_bytes() const { return (options_byte_ & 3) == 3 ? 4 : 2; }

double Device::scan_s() const { return (pacer_ + 1.0) / 60e6 / (1.0 + 1e-6 * options_.crystal_ppm); }

void Device::take(const Packets& packets) {
  std::array<std::uint8_t, packet> bytes{};
  while (!halted_ && fifo_.size() + packet <= options_.fifo_bytes) {
    const std::size_t count = packets(bytes);
    if (count == 0) break;
    fifo_.insert(fifo_.end(), bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(count));
  }
  if (running_ && !first_scan_s_ && fifo_.size() >= scan_bytes()) first_scan_s_ = now_s_;
}

void Device::advance_to(double time_s, const Packets& packets) {
  for (;;) {
    take(packets);
    if (!running_ || !first_scan_s_) break;
    const double due_s = *first_scan_s_ + static_cast<double>(scans_) * scan_s();
    if (due_s > time_s) break;
    now_s_ = std::max(now_s_, due_s);
    if (!play_one()) break;
  }
  now_s_ = std::max(now_s_, time_s);
}

bool Device::play_one() {
  if (fifo_.size() < scan_bytes()) {
    underrun();
    return running_;
  }
  for (std::size_t channel = 0; channel < 2; ++channel) {
    if ((options_byte_ >> channel & 1) == 0) continue;
    codes_[channel] = (fifo_[0] | fifo_[1] << 8) & 0xfff;
    fifo_.erase(fifo_.begin(), fifo_.begin() + 2);
  }
  outputs_.push_back({now_s_, scans_, codes_});
  ++scans_;
  if (count_ != 0 && scans_ == count_) running_ = false;
  return running_;
}

void Device::underrun() {
  underrun_ = true;
  if ((options_byte_ & 0x80) != 0) {
    ++scans_;  // holds its outputs for one
    return;
  }
  running_ = false;
  halted_ = true;
}

std::optional<std::uint8_t> Device::pins(int port) const {
  const auto at = static_cast<std::size_t>(port);
  if (input_[at]) return std::nullopt;
  return latch_[at];
}

std::vector<Output> Device::outputs_since() { return std::exchange(outputs_, {}); }

}  // namespace focalstage::mcc1208_emulator
