#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace focalstage::wire_emulator {

struct OpticsOptions {
  std::string socket;  ///< a path, made anew
  std::uint32_t width_px = 64;
  std::uint32_t height_px = 48;
  std::uint32_t most_periods_ahead = 3;
};

/// How it may misbehave.
struct OpticsFaults {
  bool deaf = false;       ///< takes nothing from the socket
  bool mute = false;       ///< tells no counts
  bool no_answer = false;  ///< to blanks
  bool no_triggers = false;
  bool hang_up_at_frame = false;  ///< in the middle of the next one
};

/// What came to light.
struct Light {
  std::uint64_t period = 0;
  std::uint32_t exposure = 0;
  std::uint8_t code = 0;  ///< the picture's first byte
};

struct OpticsRecord {
  int connections = 0;
  int blanks = 0;
  int identified = 0;
  std::uint64_t run = 0;
  bool triggers = false;  ///< it is started, and neither stopped nor dark
  std::uint64_t shown = 0;
  std::uint64_t missed = 0;
  std::vector<Light> light;  ///< of all runs
  std::string broken;        ///< what the plugin said that it must not; empty: nothing
};

/// What stands at the other end of the plugin `wire`: a projector's optics, triggered by a clock of its own. Written
/// from devices/plugin/README.md.
class Optics {
 public:
  /// Null where the socket cannot be had.
  static std::unique_ptr<Optics> start(const OpticsOptions& options);
  virtual ~Optics() = default;

  virtual void misbehave(const OpticsFaults& faults) = 0;
  virtual OpticsRecord record() const = 0;
};

}  // namespace focalstage::wire_emulator
