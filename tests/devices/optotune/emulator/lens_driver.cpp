#include "tests/devices/optotune/emulator/lens_driver.h"

#include <algorithm>
#include <utility>

namespace focalstage::optotune_emulator {

namespace {

unsigned mirrored(unsigned value, int bits) {
  unsigned turned = 0;
  for (int i = 0; i < bits; ++i) turned |= (value >> i & 1U) << (bits - 1 - i);
  return turned;
}

Bytes text(const std::string& letters) { return {letters.begin(), letters.end()}; }

void put(Bytes& bytes, int value) {
  bytes.push_back(static_cast<std::uint8_t>(value >> 8 & 0xff));
  bytes.push_back(static_cast<std::uint8_t>(value & 0xff));
}

int number(std::span<const std::uint8_t> data) { return static_cast<std::int16_t>(data[0] << 8 | data[1]); }

Bytes with_number(const std::string& letters, int value) {
  Bytes bytes = text(letters);
  put(bytes, value);
  return bytes;
}

Bytes sealed(Bytes payload) {
  const unsigned crc = checksum(payload);
  for (const unsigned byte : {crc & 0xff, crc >> 8, 0x0dU, 0x0aU}) payload.push_back(static_cast<std::uint8_t>(byte));
  return payload;
}

}  // namespace

std::uint16_t checksum(std::span<const std::uint8_t> bytes) {
  unsigned crc = 0;
  for (const std::uint8_t byte : bytes) {
    crc ^= mirrored(byte, 8) << 8;
    for (int bit = 0; bit < 8; ++bit) crc = ((crc & 0x8000) != 0 ? crc << 1 ^ 0x8005U : crc << 1) & 0xffff;
  }
  return static_cast<std::uint16_t>(mirrored(crc, 16));
}

void LensDriver::reset() {
  in_.clear();
  counts_ = 0;
  mode_ = 5;
  upper_ = 4095;
  lower_ = -4095;
}

std::vector<LensDriver::Known> LensDriver::known() const {
  const std::size_t limit = options_.wide_limits ? 4 : 2;
  return {{"MwDA", 0}, {"MwSA", 0}, {"MwQA", 0}, {"MwTA", 0},     {"MwCA", 0},     {"MwAA", 0}, {"MMA", 0}, {"CrMA", 2},
          {"CwMA", 2}, {"CrUA", 2}, {"CrLA", 2}, {"CwUA", limit}, {"CwLA", limit}, {"TCA", 0},  {"GAA", 0}, {"Sr", 0},
          {"IR", 8},   {"Aw", 2},   {"Ar", 2},   {"X", 0},        {"H", 0},        {"V", 0}};
}

Bytes LensDriver::take(std::span<const std::uint8_t> bytes, const Misbehaviour& how) {
  in_.insert(in_.end(), bytes.begin(), bytes.end());
  if (how.silent) {
    in_.clear();
    return {};
  }
  Bytes out;
  for (;;) {
    const std::size_t before = in_.size();
    Bytes one = next(how);
    if (in_.size() == before) return out;
    if (one.empty()) continue;
    if (how.stale) out.insert(out.end(), before_.begin(), before_.end());
    before_ = one;
    const bool once = how.damage_once && !std::exchange(damaged_once_, true);
    if ((how.damage || once) && one.size() > 4) one[one.size() - 4] ^= 1;
    if (how.half > 0) one.resize(std::min(one.size(), static_cast<std::size_t>(how.half)));
    out.insert(out.end(), one.begin(), one.end());
  }
}

// The next whole command's answer; takes nothing where none is whole.
Bytes LensDriver::next(const Misbehaviour& how) {
  const std::string start = "Start";
  const auto begins = [this](const std::string& name) {
    return in_.size() >= name.size() && std::equal(name.begin(), name.end(), in_.begin());
  };
  if (begins(start)) {
    in_.erase(in_.begin(), in_.begin() + 5);
    return text("Ready\r\n");
  }
  bool may_become = false;
  for (const Known& one : known()) {
    const std::size_t seen = std::min(in_.size(), one.name.size());
    may_become =
        may_become || std::equal(in_.begin(), in_.begin() + static_cast<std::ptrdiff_t>(seen), one.name.begin());
    if (!begins(one.name)) continue;
    const std::size_t length = one.name.size() + one.data + 2;
    if (in_.size() < length) return {};
    const Bytes packet(in_.begin(), in_.begin() + static_cast<std::ptrdiff_t>(length));
    in_.erase(in_.begin(), in_.begin() + static_cast<std::ptrdiff_t>(length));
    ++asked_[one.name];
    if (checksum(packet) != 0) return refusal(1, how.error_as_digit);
    if (how.error != 0 && (how.error_on.empty() || how.error_on == one.name)) {
      return refusal(how.error, how.error_as_digit);
    }
    return answer(one.name, std::span(packet).subspan(one.name.size(), one.data), how);
  }
  const std::size_t seen = std::min(in_.size(), start.size());
  may_become = may_become || std::equal(in_.begin(), in_.begin() + static_cast<std::ptrdiff_t>(seen), start.begin());
  if (in_.empty() || may_become) return {};
  in_.clear();
  return refusal(3, how.error_as_digit);
}

Bytes LensDriver::refusal(int error, bool digit) {
  return sealed({'E', static_cast<std::uint8_t>(digit ? '0' + error : error)});
}

Bytes LensDriver::answer(const std::string& name, std::span<const std::uint8_t> data, const Misbehaviour& how) {
  if (name == "Aw") {
    if (mode_ == 1) counts_ = std::clamp(number(data), lower_, upper_);
    return {};
  }
  if (name == "Ar") return sealed(with_number("A", counts_));
  if (name == "X") return sealed(text("X" + options_.lens_serial));
  if (name == "H") return sealed({'H', static_cast<std::uint8_t>(options_.firmware_type)});
  if (name == "V") return sealed({'V', 1, 12, 0, 240, 3, 32});
  if (name == "IR") return sealed({'I', 'R', 1, 2, 3, 4, 5, 6, 7, 8});
  if (name == "MMA") return sealed({'M', 'M', 'A', static_cast<std::uint8_t>(mode_)});
  if (name == "TCA") return sealed(with_number("TCA", static_cast<int>(celsius * 16.0)));
  if (name == "Sr") return sealed({'S', 0, 0, 0, static_cast<std::uint8_t>(celsius > 60.0 ? 0x20 : 0)});
  if (name == "GAA") return sealed(with_number("GAA", 512));
  if (name == "CwMA" && !how.keeps_limit) centi_ma_ = std::min(number(data), 29284);
  if (name == "CrMA" || name == "CwMA") return sealed(with_number("CMA", centi_ma_));
  if (name == "CwUA") upper_ = number(data);
  if (name == "CwLA") lower_ = number(data);
  if (name == "CrUA" || name == "CwUA") return sealed(with_number("CUA", upper_));
  if (name == "CrLA" || name == "CwLA") return sealed(with_number("CLA", lower_));
  return answer_mode(name[2]);
}

Bytes LensDriver::answer_mode(char letter) {
  const std::string letters = "DSTQCA";
  mode_ = static_cast<int>(letters.find(letter)) + 1;
  if (mode_ != 1) counts_ = 0;
  Bytes payload{'M', static_cast<std::uint8_t>(letter), 'A'};
  if (letter == 'C') {
    payload.push_back(0);
    put(payload, 2000);
    put(payload, -2000);
  }
  return sealed(payload);
}

}  // namespace focalstage::optotune_emulator
