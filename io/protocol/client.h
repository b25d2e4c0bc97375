#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <stop_token>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/scene/finding.h"
#include "core/scene/project.h"

namespace focalstage {

/// What a rig says of itself: enough to compile for it.
struct RigDescription {
  std::string name;
  std::string kind;  ///< "sim" or the hardware's
  std::vector<Projector> projectors;
  Glasses glasses;   ///< measured lens response per eye, shutter times, limits
};

/// Asked beside delivered for one exposure, worst over the sweeps watched.
struct SlotReport {
  int slot = 0;
  int image = 0;
  int eye = 0;
  double asked_power_d = 0.0;
  double delivered_power_d = 0.0;
  double asked_s = 0.0;
  double delivered_s = 0.0;
  bool right_image = false;
  bool own_shutter_open = false;
  bool other_shutter_closed = false;
  bool delivered = false;  ///< all of it within 0.02 D and 20 us
  std::uint64_t exposures = 0;
  std::uint64_t missed = 0;
};

struct RigState {
  std::string state;       ///< "empty", "ready", "playing", "holding", "dark"
  std::string show_sha256;
  std::uint64_t sweeps = 0;
  std::uint64_t missed_exposures = 0;
  double lens_phase = 0.0;
  double temperature_c = 0.0;
  std::string fault;       ///< latched; empty when none
  std::vector<SlotReport> slots;
};

/// A connection to a runtime. Every call has a deadline; faults: "rig.unreachable", "rig.refused", "rig.differs", ...
class RigClient {
 public:
  static Result<RigClient> connect(const std::string& host_port, std::chrono::milliseconds deadline);

  RigClient(RigClient&&) noexcept;
  RigClient& operator=(RigClient&&) noexcept;
  ~RigClient();

  Result<RigDescription> describe();

  /// Pushes in 1 MiB chunks, resuming where an earlier push of the same bytes stopped; optionally activates it.
  Status push(const std::filesystem::path& show, bool activate, const std::function<void(double share)>& progress,
              std::stop_token stop = {});

  Status play();
  Status hold();
  Status blackout();
  Status go();  ///< clears a latched fault or blackout
  Status cue(const std::string& name);
  Result<RigState> state();

 private:
  struct State;
  explicit RigClient(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace focalstage
