#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace focalstage {

/// Bytes and numbers of Measurement Computing's USB-1208FS-Plus, as its public Linux driver sends them
/// (wjasper/Linux_Drivers, usb-1208FS-Plus.c). Integers are little-endian.

inline constexpr std::uint16_t mcc_vendor = 0x09db;
inline constexpr std::uint16_t mcc_usb1208fs_plus = 0x00e8;
inline constexpr std::uint8_t mcc_bulk_out = 0x02;
inline constexpr std::size_t mcc_packet_bytes = 64;
inline constexpr int mcc_top_code = 4095;

/// bRequest of the vendor requests that are sent, and of no others: what erases firmware (50h) or writes calibration
/// and user memory (30h, 31h) has no name here.
enum class MccRequest : std::uint8_t {
  direction = 0x00,   ///< DTRISTATE: value 1 makes the whole port `index` an input
  latch = 0x02,       ///< DLATCH: what the port `index` puts out
  output = 0x18,      ///< AOUT: value is the code, index the channel; in: both codes
  scan_start = 0x1a,  ///< AOUT_SCAN_START
  scan_stop = 0x1b,   ///< AOUT_SCAN_STOP
  clear_fifo = 0x1c,  ///< AOUT_CLR_FIFO
  blink = 0x41,       ///< BLINK_LED: one byte, how often
  status = 0x44,      ///< out: clears the error bits
  serial = 0x48,      ///< in: 8 characters
};

/// STATUS.
struct MccStatus {
  bool scan_running = false;  ///< bit 3
  bool underrun = false;      ///< bit 4

  bool operator==(const MccStatus&) const = default;
};
std::optional<MccStatus> read_mcc_status(std::span<const std::uint8_t> bytes);

/// The codes of both channels; none where the bytes are too few or beyond 12 bits.
std::optional<std::array<int, 2>> read_mcc_outputs(std::span<const std::uint8_t> bytes);

/// 8 printable characters; none else.
std::optional<std::string> read_mcc_serial(std::span<const std::uint8_t> bytes);

/// AOUT_SCAN_START's data: endless, both channels, stalls at an underrun.
std::array<std::uint8_t, 9> mcc_scan_start(std::uint32_t pacer);

/// 60 MHz / rate - 1, rounded; none where the rate is not in (0, 50 kHz] or the pacer does not fit.
std::optional<std::uint32_t> mcc_pacer(double scans_per_s);
double mcc_scans_per_s(std::uint32_t pacer);

/// 0..5 V over 4096 codes, rounded and clamped to 0..4095.
int mcc_code(double volts);
double mcc_volts(int code);

/// One scan of both channels on the bulk endpoint.
void append_mcc_scan(std::vector<std::uint8_t>& bytes, int code_0, int code_1);

}  // namespace focalstage
