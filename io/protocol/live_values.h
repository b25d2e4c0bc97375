#pragma once

#include <cstdint>
#include <string>
#include <variant>

#include "core/base/result.h"
#include "core/compile/frame.h"
#include "io/protocol/rig_values.h"

namespace focalstage {

/// The rig compiled this revision and shows it from a sweep boundary on, if it shows anything. A revision that a newer
/// one overtook is never heard of.
struct LiveCompiled {
  std::uint64_t revision = 0;
  int frame = 0;
  double compile_ms = 0.0;
  int images = 0;
  int width_px = 0;
  int height_px = 0;
  int channels = 0;
  std::string frame_file;  ///< on this machine; empty where frames are not shared

  bool operator==(const LiveCompiled&) const = default;
};

/// All light of that sweep was this revision's. May come before LiveCompiled.
struct LiveAppeared {
  std::uint64_t revision = 0;
  int frame = 0;
  std::uint64_t sweep = 0;        ///< as RigState counts
  double edit_to_light_ms = 0.0;  ///< from the rig's receipt to the start of that sweep

  bool operator==(const LiveAppeared&) const = default;
};

/// This revision is not shown; what plays stays.
struct LiveRefused {
  std::uint64_t revision = 0;
  Fault fault;

  bool operator==(const LiveRefused&) const = default;
};

/// The link is over: "rig.unreachable" where the runtime is gone, or what it said.
struct LiveEnded {
  Fault fault;

  bool operator==(const LiveEnded&) const = default;
};

using LiveAnswer = std::variant<LiveCompiled, LiveAppeared, LiveRefused, RigState, LiveEnded>;

/// The images that were compiled, from the file that the rig shares on one machine. "live.frame-gone" where newer ones
/// took its place meanwhile.
Result<FrameImages> read_live_frame(const LiveCompiled& compiled);

}  // namespace focalstage
