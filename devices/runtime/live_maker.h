#pragma once

#include <map>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/compile/compile.h"
#include "core/stage/stage.h"
#include "devices/player/player.h"
#include "devices/runtime/admission.h"
#include "devices/runtime/asset_store.h"
#include "devices/runtime/live_book.h"

namespace focalstage {

/// Makes of one frame of a project a show in memory, held against the rig as a pushed one is. Keeps between frames what
/// did not change: the engine, the meshes, and the memory of images that nobody shows any more.
class LiveMaker {
 public:
  LiveMaker(const AssetStore& assets, RigTerms rig) : store_(assets), rig_(std::move(rig)) {}

  /// Faults: those of the project's, its assets, compiling ("compile.cancelled") and `admit`.
  Result<std::shared_ptr<LoadedShow>> make(const LiveSnapshot& snapshot, const std::stop_token& stop);

 private:
  Status read_assets(const LiveSnapshot& snapshot);
  Result<CompiledFrame> compile(const LiveSnapshot& snapshot, const CompileSettings& settings,
                                const std::stop_token& stop);
  FrameImages recycled();

  const AssetStore& store_;
  RigTerms rig_;
  std::optional<CompileSettings> settings_;
  std::optional<Compiler> compiler_;
  std::map<std::string, std::string> files_;  ///< that `assets_` were read from
  Assets assets_;
  std::vector<std::shared_ptr<FrameImages>> given_out_;
};

}  // namespace focalstage
