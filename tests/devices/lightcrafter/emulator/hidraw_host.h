#pragma once

#include <memory>
#include <string>

#include "tests/devices/lightcrafter/emulator/board.h"

using UMockdevTestbed = struct _UMockdevTestbed;

namespace focalstage::lightcrafter_emulator {

/// Puts a Board on the (mocked) USB, as /dev/hidrawN. The process must run under `umockdev-wrapper`; emulators of other
/// devices may share its test bed.
class HidrawHost {
 public:
  virtual ~HidrawHost() = default;

  /// Takes its name from the bus, and the descriptor with it: who holds it open reads an error.
  virtual void unplug() = 0;
  /// On another node than before.
  virtual void plug() = 0;
  virtual std::string node() const = 0;

  /// Plugged in. `bed` and `board` must live longer.
  static std::unique_ptr<HidrawHost> start(UMockdevTestbed* bed, Board& board, const std::string& serial = "LCR4",
                                           int first_node = 0);
};

}  // namespace focalstage::lightcrafter_emulator
