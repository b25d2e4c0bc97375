#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "devices/runtime/desk_command.h"

namespace focalstage {

/// Longer packets, and more messages in one, are not looked at.
inline constexpr std::size_t most_osc_bytes = 1500;
inline constexpr int most_osc_messages = 16;

/// One OSC message: its address pattern and what of its arguments matters here.
struct OscMessage {
  std::string path;
  std::optional<std::string> text;  ///< the first argument, where it is a text
  bool released = false;            ///< the first argument is zero: of a button that is let go

  bool operator==(const OscMessage&) const = default;
};

/// The messages of a packet (OSC 1.0), those of bundles in their order whatever their time tags; none where any of it
/// is damaged.
std::vector<OscMessage> osc_messages(std::span<const std::byte> packet);

/// What a message asks of the rig: `prefix` with /play, /hold, /go, /next, /back, /blackout, or /cue and a text.
std::optional<DeskCommand> desk_command(const OscMessage& message, const std::string& prefix);

}  // namespace focalstage
