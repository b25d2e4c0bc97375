#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace focalstage::optotune_emulator {

using Bytes = std::vector<std::uint8_t>;

struct Options {
  char firmware_type = 'E';
  std::string lens_serial = "ANAB0042";
  bool wide_limits = false;  ///< CwUA and CwLA have four bytes of data
};

/// What goes wrong. Each may be changed at any time.
struct Misbehaviour {
  bool silent = false;
  int error = 0;                          ///< 1..4: refuses each command so
  std::string error_on;                   ///< only of this command, "TCA"; empty: of each
  bool error_as_digit = false;            ///< '1' for 01
  int half = 0;                           ///< answers end after so many bytes; 0: whole
  bool damage = false;                    ///< a bit of each answer's checksum is wrong
  bool damage_once = false;               ///< only of the next
  bool stale = false;                     ///< the answer before comes once more, before the right one
  bool keeps_limit = false;               ///< CwMA changes nothing
  double delay_s = 0.0;                   ///< before each answer
  std::optional<std::size_t> hang_up_at;  ///< the line ends once so many bytes were answered
};

/// Optotune's Lens Driver 4 as hardware.md section 2 has it, without its line: bytes in, bytes out.
class LensDriver {
 public:
  explicit LensDriver(const Options& options) : options_(options) {}

  Bytes take(std::span<const std::uint8_t> bytes, const Misbehaviour& how);

  double celsius = 25.0;
  int counts() const { return counts_; }      ///< of the current that the coil is given in mode 1
  int centi_ma() const { return centi_ma_; }  ///< full scale, 0.01 mA
  int mode() const { return mode_; }
  void reset();
  const std::map<std::string, int>& asked() const { return asked_; }  ///< how often each command came

 private:
  struct Known {
    std::string name;
    std::size_t data;
  };
  std::vector<Known> known() const;
  Bytes next(const Misbehaviour& how);
  Bytes answer(const std::string& name, std::span<const std::uint8_t> data, const Misbehaviour& how);
  Bytes answer_mode(char letter);
  static Bytes refusal(int error, bool digit);

  Options options_;
  Bytes in_;
  int counts_ = 0;
  int centi_ma_ = 29284;
  int mode_ = 5;
  int upper_ = 4095;
  int lower_ = -4095;
  std::map<std::string, int> asked_;
  Bytes before_;
  bool damaged_once_ = false;
};

/// CRC-16/ARC by its table-free definition, bit by bit from the top: not the driver's.
std::uint16_t checksum(std::span<const std::uint8_t> bytes);

}  // namespace focalstage::optotune_emulator
