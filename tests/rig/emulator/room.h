#pragma once

#include <cstdio>
#include <deque>
#include <memory>
#include <optional>
#include <string>

#include "core/base/sides.h"
#include "devices/sim/sim_shutter.h"
#include "tests/devices/mcc1208/emulator/emulator.h"
#include "tests/devices/uno/emulator/emulator.h"
#include "tests/rig/emulator/lens_plant.h"
#include "tests/rig/emulator/optics.h"
#include "tests/rig/emulator/photodiodes.h"

namespace focalstage::rig_emulator {

struct RoomSettings {
  std::string firmware_elf;
  double board_clock_ppm = 0.0;  ///< by which the board's resonator is fast
  OpticsSettings optics;
  LensPlantSettings lens;
  PhotodiodesSettings photodiodes;
  double amperes_per_volt = 0.12;  ///< of the amplifier
  int zero_code = 2048;
  int enable_bit = 0;  ///< of DIO port A; low: no current
  std::string board_link;
  std::string report;  ///< JSON lines: what light came of it all
};

/// The emulated devices wired as docs/rig.md says, in one device time: the waveform generator's scans give the lenses
/// their current and the board its sync edges; the board's pins give the projector its triggers and move the shutters.
/// Knows nothing of shows: it writes down which picture was lit when, through which lens power and which shutters.
class Room {
 public:
  Room(const RoomSettings& settings, std::unique_ptr<mcc1208_emulator::Emulator> generator);
  ~Room();

  /// Device time goes on to `time_s`, a few milliseconds at most, which is `monotonic_s` for the host.
  void advance_to(double time_s, double monotonic_s);
  double time_s() const { return time_s_; }
  std::optional<std::uint64_t> host_looks() const { return generator_->host_looks(); }

  /// "lens", "board", "projector". False: there is no such device.
  bool unplug(const std::string& device);
  bool plug_in(const std::string& device);
  void lose_next_trigger() { optics_.lose_next_trigger(); }

  /// Now, as JSON: device time, lens power, and which shutters are told to be closed.
  std::string look() const;

 private:
  void hear(const mcc1208_emulator::Output& output);
  void set_current(double time_s, int code);
  void heed_pins();
  void end_exposures();
  double seconds(uno_emulator::Cycle cycle) const { return static_cast<double>(cycle) / board_hz_; }
  uno_emulator::Cycle cycles(double seconds) const { return static_cast<uno_emulator::Cycle>(seconds * board_hz_); }

  RoomSettings settings_;
  double board_hz_;
  double time_s_ = 0.0;
  std::unique_ptr<mcc1208_emulator::Emulator> generator_;
  uno_emulator::UnoEmulator board_;
  Optics optics_;
  LensPlant lens_;
  PerEye<SimShutter> shutter_;
  std::optional<Photodiodes> photodiodes_;
  PerEye<bool> closed_{true, true};
  int sync_code_ = 0;
  double edge_s_ = 0.0;
  std::uint64_t edges_ = 0;
  std::deque<Begun> lit_;
  std::FILE* report_;
};

}  // namespace focalstage::rig_emulator
