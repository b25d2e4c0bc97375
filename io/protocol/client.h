#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <stop_token>
#include <string>

#include "core/base/result.h"
#include "io/protocol/rig_values.h"

namespace focalstage {

/// Where a runtime listens unless told otherwise.
inline constexpr const char* default_rig_address = "127.0.0.1:50371";

/// A connection to a runtime. Every call has a deadline. Takes the rig for itself with the first call that changes
/// something, and lets go at the end.
///
/// Faults: "rig.unreachable" (nobody answers in time), "rig.refused" (not in this state, not this show), "rig.differs"
/// (the show is made for another rig), "rig.held" (another editor holds it), "rig.damaged" (names the chunk),
/// "rig.disk-full"; "file.*" for the show to be pushed.
class RigClient {
 public:
  static Result<RigClient> connect(const std::string& host_port, std::chrono::milliseconds deadline);

  RigClient(RigClient&&) noexcept;
  RigClient& operator=(RigClient&&) noexcept;
  ~RigClient();

  /// The lens response at the harmonics of a sweep of `frequency_hz`.
  Result<RigDescription> describe(double frequency_hz = 60.0);

  /// Pushes in 1 MiB chunks, resuming where an earlier push of the same bytes stopped; optionally activates it.
  /// "rig.cancelled" within one chunk of a stop request; what arrived stays for the next push.
  Status push(const std::filesystem::path& show, bool activate, const std::function<void(double share)>& progress,
              std::stop_token stop = {});

  Status play(std::uint64_t sweeps = 0);  ///< then holds; 0: goes on until told otherwise
  Status hold();
  Status blackout();
  Status go();  ///< clears a latched fault or blackout
  Status cue(const std::string& name);
  Result<RigState> state();

  /// Calls `seen` with the state every `interval` until it returns false or the rig goes away.
  Status watch(std::chrono::milliseconds interval, const std::function<bool(const RigState&)>& seen);

 private:
  struct State;
  explicit RigClient(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace focalstage
