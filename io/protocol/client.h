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

class RigConnection;

/// A connection to a runtime. Every call has a deadline and may come from any thread: blackout goes through while a
/// push is under way. Takes the rig for itself with the first call that changes something, and lets go at the end.
///
/// A runtime that goes away is told by every call, and by `watch` within a second of its own interval
/// ("rig.unreachable"). Nothing has to be built anew for it: when the runtime is back, the next call reaches it.
///
/// Faults: "rig.unpaired", "rig.certificate" (docs/runtime.md), "rig.unauthorised" (this client may not),
/// "rig.unreachable" (nobody answers in time), "rig.refused" (not in this state, not this show), "rig.differs" (the
/// show is made for another rig), "rig.held" (another editor holds it), "rig.damaged" (names the chunk),
/// "rig.disk-full"; "file.*" for the show to be pushed.
class RigClient {
 public:
  static Result<RigClient> connect(const std::string& host_port, std::chrono::milliseconds deadline);

  RigClient(RigClient&&) noexcept;
  RigClient& operator=(RigClient&&) noexcept;
  ~RigClient();

  /// Whether the runtime is there, as far as is known without asking it. Never waits; where it is away, it is looked
  /// for from now on.
  bool reachable() const;

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
  Status next();  ///< to the cue after the one that is on
  Status back();
  Result<RigState> state();

  /// What is plugged in where the rig is.
  Result<DeviceListing> devices();
  /// Makes a device show itself; an empty serial is the only one of that driver.
  Status identify(const std::string& driver, const std::string& serial);

  /// Lets the rig measure itself: `seen` is told what it does and how much of all is done. `frequency_hz` 0: 60;
  /// `harmonics` 0: 4. It keeps what it found unless `dry_run`. "rig.no-light-sensor", "measure.*", "light.*"; a stop
  /// request leaves it dark: "rig.cancelled".
  struct SelfTestAsked {
    double frequency_hz = 0.0;
    int harmonics = 0;
    bool dry_run = false;
  };
  Result<RigMeasurement> self_test(const SelfTestAsked& asked,
                                   const std::function<void(const std::string& doing, double share)>& seen,
                                   std::stop_token stop = {});

  /// Calls `seen` with the state every `interval` until it returns false, `stop` is requested or the rig goes away.
  /// `seen` must not wait.
  Status watch(std::chrono::milliseconds interval, const std::function<bool(const RigState&)>& seen,
               std::stop_token stop = {});

  /// What a live link shares with this client: the channel and the lease.
  const std::shared_ptr<RigConnection>& connection() const { return connection_; }

 private:
  explicit RigClient(std::shared_ptr<RigConnection> connection);
  std::shared_ptr<RigConnection> connection_;
};

}  // namespace focalstage
