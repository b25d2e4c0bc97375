#pragma once

#include <cstdint>
#include <mutex>
#include <optional>

#include "core/base/result.h"
#include "devices/plugin/focalstage_projector.h"
#include "devices/roles/projector.h"

namespace focalstage {

/// What is known of a plugin projector's run: what it was given, what it says it showed. From any thread.
class ProjectorBooks {
 public:
  void set_abilities(const focalstage_projector_abilities& abilities);
  ProjectorAbilities abilities() const;

  void set_exposures(const Exposures& exposures);
  Exposures exposures() const;

  /// A run begins: counts told before it are worth nothing. `now_s`: the monotonic clock.
  void begin(double now_s);
  /// What was posted is forgotten, and no more is taken until `begin`.
  void end();

  /// Which run this is; 0: none.
  std::uint64_t run() const;

  /// The number of the period that is posted; "projector.full" where as many as it takes are waiting, "projector.dark"
  /// where it was not started.
  Result<std::uint64_t> post();

  /// One more picture is about to be the plugin's (before it is, so that none is shown that was not counted here); or
  /// it did not take it.
  void submitting(std::uint64_t run);
  void refused(std::uint64_t run);

  /// What the plugin told of this run at `now_ns`. A Fault "plugin.counts" where that cannot be: more shown than was
  /// given, a count that went back, a moment that is still to come.
  std::optional<Fault> told(std::uint64_t run, const focalstage_projector_counts& counts, std::int64_t now_ns);

  ProjectorReport report() const;

 private:
  mutable std::mutex mutex_;
  focalstage_projector_abilities abilities_{};
  Exposures exposures_;
  bool running_ = false;
  std::uint64_t run_ = 0;
  std::uint64_t posted_ = 0;     ///< periods
  std::uint64_t submitted_ = 0;  ///< pictures
  focalstage_projector_counts counts_{};
};

}  // namespace focalstage
