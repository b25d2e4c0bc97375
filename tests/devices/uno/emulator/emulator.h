#pragma once

#include <string>

#include "tests/devices/uno/emulator/chip.h"
#include "tests/devices/uno/emulator/misbehaviour.h"
#include "tests/devices/uno/emulator/pty_port.h"

namespace focalstage::uno_emulator {

struct Options {
  std::string firmware_elf;
  bool resets_when_opened = false;  ///< as a real Uno does, by DTR
  double boot_s = 1.6;              ///< how long its boot loader then takes, deaf
};

/// A trigger board: the chip, and its serial port as a pty. It has no time of its own: whoever owns it says how far it
/// goes, gives it edges (chip().edge_at, chip().sync_every) and reads its pins' changes (chip().trigger, ...), all in
/// cycles of the chip's own clock. One thread at a time.
class UnoEmulator {
 public:
  explicit UnoEmulator(const Options& options);

  Chip& chip() { return chip_; }
  const std::string& path() const { return port_.path(); }
  void set_link(const std::string& link) { port_.set_link(link); }

  /// To that cycle, with bytes carried to and fro every half millisecond; the same edges and bytes at the same cycles
  /// give the same pins.
  void run_until(Cycle at);
  /// Carries bytes once: for who runs the chip itself, in steps of a millisecond at most.
  void pump();

  void misbehave(const Misbehaviour& how);
  /// The port is gone. Its power too, and the chip then starts anew when it is plugged in; or it has that from
  /// elsewhere, and goes on.
  void unplug(bool keeps_power = false);
  /// Under another path.
  void plug_in();
  bool plugged_in() const { return port_.plugged_in(); }

  /// The longest that the host said nothing since this was asked last.
  Cycle take_longest_silence();

 private:
  void see_host();

  Options options_;
  Chip chip_;
  PtyPort port_;
  Line line_;
  std::size_t said_ = 0;  ///< bytes to a host, since the misbehaviour was set
  bool host_was_there_ = false;
  bool keeps_power_ = false;
  Cycle told_at_ = 0;
  Cycle longest_silence_ = 0;
  Cycle booting_until_ = 0;  ///< 0: it is not
};

}  // namespace focalstage::uno_emulator
