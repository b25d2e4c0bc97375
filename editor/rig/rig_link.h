#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/scene/edit.h"
#include "core/scene/project.h"
#include "io/protocol/rig_values.h"

namespace focalstage {

/// The link to a rig, as the window shows it.
struct RigStatus {
  enum class Phase { none, connecting, connected, lost };

  Phase phase = Phase::none;
  std::string address;
  bool simulated = false;  ///< started by this editor
  RigDescription description;
  RigState state;
  std::optional<Fault> fault;  ///< of the last thing asked; gone with the next that works

  bool pushing = false;
  double push_share = -1.0;   ///< of the compile, then of the transfer; negative: nobody knows
  std::string push_step;      ///< "Compiling", "Sending"
  std::string pushed_sha256;  ///< of the last show that arrived whole

  bool live_wanted = false;         ///< the person asked for it
  bool live = false;                ///< edits stream to the rig
  std::uint64_t live_revision = 0;  ///< that the rig shows
  double edit_to_light_ms = -1.0;   ///< as the rig measured it last; negative: not yet
};

/// Makes the show to push: compiles it into a file and returns its path. `progress`: 0..1.
using MakeShow =
    std::function<Result<std::filesystem::path>(const std::function<void(double)>& progress, std::stop_token stop)>;

/// A revision of a project that live is to show.
struct LiveWish {
  std::uint64_t revision = 0;
  int frame = 0;
  std::shared_ptr<const Project> project;
  std::filesystem::path folder;
};

/// Talks to a runtime behind the window: nothing here blocks. What is asked happens in order; blackout passes all.
/// When the runtime goes away the link says so and tries again until told otherwise.
class RigLink {
 public:
  /// `state_folder`: where the simulated rig keeps its shows.
  RigLink(std::function<void()> wake, std::filesystem::path state_folder);
  ~RigLink();
  RigLink(const RigLink&) = delete;
  RigLink& operator=(const RigLink&) = delete;

  void connect(std::string address);
  /// Starts a simulated rig beside this program and connects to it; it ends with the link.
  void simulate();
  void disconnect();

  /// Compiles, sends, verifies and activates. Faults come in the status.
  void push(MakeShow make);
  void cancel_push();

  /// Edits stream to the rig from now on, or no more.
  void live(bool on);
  /// What live shows: the newest wins. `folder`: of the project, for its files.
  void show(LiveWish wish);

  void play();
  void hold();
  void go();
  void blackout();

  RigStatus status() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace focalstage
