#pragma once

#include <filesystem>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/scene/edit.h"
#include "core/scene/project.h"
#include "core/study/study.h"
#include "editor/pipeline/compile_show.h"

namespace focalstage {

/// Where a show has a target.
struct ShownTarget {
  std::string cue;
  int frame = 0;

  bool operator==(const ShownTarget&) const = default;
};

/// A condition as the rig takes it.
struct ReadyCondition {
  std::filesystem::path show;
  std::string sha256;                ///< of the file: what the rig calls it
  double interpupillary_mm = 0.0;    ///< of the viewer it was made for
  std::vector<ShownTarget> targets;  ///< in the study's order
};

/// What turns the project into a variant of it. Conventional: one slice at 0 D and everything in it; geometry, and with
/// it what each eye sees where, is untouched.
std::vector<Edit> variant_edits(const Project& project, ConditionVariant variant);

/// A cue at every frame that a target names and no cue has.
std::vector<Edit> cue_edits(const Project& project, const Study& study);

/// Makes the shows of all conditions: projects are compiled into `shows`, for an interpupillary distance of their own
/// or the one given; shows are taken as they are. `folder` is what the study's paths are relative to. `progress` is
/// told of each condition anew. Faults: "study.condition" where a show would be refused by every rig, "study.target"
/// where a show lacks a target's cue or frame, and those of projects and shows.
Result<std::vector<ReadyCondition>> make_conditions(const Study& study, const std::filesystem::path& folder,
                                                    const std::filesystem::path& shows,
                                                    const std::optional<double>& interpupillary_mm,
                                                    const FrameProgress& progress, const std::stop_token& stop);

}  // namespace focalstage
