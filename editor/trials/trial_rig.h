#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <stop_token>
#include <string>

#include "core/base/result.h"
#include "editor/trials/conditions.h"
#include "io/protocol/client.h"

namespace focalstage {

/// What a trial asks of a rig. Faults have codes "rig.*"; after one, `connect` comes before anything else.
class TrialRig {
 public:
  virtual ~TrialRig() = default;

  /// Reaches the rig, anew after a fault. `lift`: somebody at the rig said that a latched darkness may end.
  virtual Status connect(bool lift) = 0;

  /// Makes the condition's show the rig's, in the dark.
  virtual Status prepare(const ReadyCondition& condition, const std::stop_token& stop) = 0;

  /// Shows one target, and nothing else, until `dark`.
  virtual Status show(const ShownTarget& target) = 0;

  /// No light, without latching it: after this somebody else's blackout can be told from ours.
  virtual Status dark() = 0;

  /// Whether it is as it was left: the light of `show`, or the dark. Keeps the rig ours.
  virtual Status check() = 0;

  /// "sim", or the hardware's.
  virtual std::string kind() const = 0;
};

/// The rig behind a runtime. Light is made by cue and hold, and ended by a blackout that is lifted at once: that leaves
/// the runtime `ready`, where nothing is lit and whoever presses blackout latches it.
class ProtocolTrialRig final : public TrialRig {
 public:
  explicit ProtocolTrialRig(std::string host_port) : host_port_(std::move(host_port)) {}

  Status connect(bool lift) override;
  Status prepare(const ReadyCondition& condition, const std::stop_token& stop) override;
  Status show(const ShownTarget& target) override;
  Status dark() override;
  Status check() override;
  std::string kind() const override { return kind_; }

 private:
  using Clock = std::chrono::steady_clock;

  Status stay_ours();

  std::string host_port_;
  std::string kind_;
  std::optional<RigClient> client_;
  std::string sha256_;                ///< of the show that is ours
  std::optional<ShownTarget> shown_;  ///< nothing: dark
  ShownTarget resting_;               ///< what a cue may name in the dark
  Clock::time_point last_held_{};
};

}  // namespace focalstage
