#pragma once

#include <atomic>
#include <memory>
#include <optional>

#include "core/base/result.h"
#include "devices/lightcrafter/link.h"
#include "devices/lightcrafter/plan.h"
#include "devices/lightcrafter/settings.h"

namespace focalstage::lightcrafter {

struct BoardState {
  HardwareStatus hardware;
  MainStatus main;
  std::uint8_t led_enable = 0;

  /// No light can leave it: nothing runs, and no LED may be on.
  bool dark() const { return !main.running && led_enable == 0; }
};

/// What is wrong with a board that is meant to run, or to be dark.
std::optional<Fault> trouble_with(const BoardState& board, bool meant_to_run);

/// The commands of a LightCrafter 4500, in the orders that work. For one thread at a time; `hurry` cuts ordinary waits
/// short (link.h). Faults are those of the link, and "projector.hardware", "projector.validation", "projector.start",
/// "projector.no-video".
class Control {
 public:
  Control(std::unique_ptr<Reports> reports, const LightCrafterSettings& settings, const std::atomic<bool>& hurry);

  /// LEDs off, then the sequencer stopped; each is told whatever became of the other, with a deadline of its own. True:
  /// both said yes.
  bool dark();

  /// Dark, awake, in pattern mode (a stopped pattern mode shows nothing; video mode would), and without trouble.
  Status make_ready();

  /// Writes a table and has it validated; dark before and after.
  Status set_up(const PatternPlan& plan);

  /// Brightness, LEDs by the sequencer, and begins with the next vsync. Sends "start" twice where once does not do.
  Status start();

  Result<BoardState> look();
  Status check_signal();

  /// The lamp glows a little, manually, or goes off: the mirrors rest.
  Status lamp(bool on);
  /// Three times, for a second in all; a hurry ends it.
  Status blink();
  Status standby();

 private:
  Status write(Command command, std::initializer_list<std::uint8_t> payload);
  Status write_entries(const PatternPlan& plan);
  Status validate();

  LightCrafterSettings settings_;
  const std::atomic<bool>& hurry_;
  Link link_;
};

}  // namespace focalstage::lightcrafter
