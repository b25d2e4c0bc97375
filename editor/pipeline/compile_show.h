#pragma once

#include <filesystem>
#include <optional>
#include <stop_token>
#include <vector>

#include "core/base/result.h"
#include "core/check/check.h"
#include "core/scene/finding.h"
#include "editor/pipeline/frame_maker.h"
#include "editor/pipeline/source.h"
#include "io/show/reader.h"
#include "io/show/show.h"

namespace focalstage {

struct CompileJob {
  std::filesystem::path show;
  std::optional<FrameRange> frames;  ///< none: all
  bool resume = false;
  EngineChoice engine;
};

struct CompileReport {
  int frames = 0;
  int resumed = 0;  ///< of those, taken over from an earlier run
  std::size_t projectors = 1;
  std::size_t images = 0;          ///< of a frame, of all projectors
  std::size_t slots = 0;           ///< exposures of a period, of all projectors
  double slowest_frame_ms = 0.0;   ///< to compile, of those that were
  PerEye<OptimalMeasure> optimal;  ///< over all frames
  std::vector<Finding> findings;
};

/// Compiles a project into a show file: stages, compiles and measures frame after frame while finished ones are
/// compressed and written. Findings do not prevent the show. Faults: "compile.cancelled" (what is finished stays for
/// `resume`), "frames.range", and those of the rooms it calls.
Result<CompileReport> compile_show(const Source& source, const CompileJob& job, const FrameProgress& progress,
                                   std::stop_token stop);

struct CheckReport {
  std::vector<Finding> findings;
  std::vector<ObjectConflict> conflicts;   ///< of objects that are lit, in the project's order
  std::vector<SurfaceContrast> contrasts;  ///< of surfaces that are lit, where black or the room's light is not nothing
};

/// The findings of a project without writing anything: every frame is compiled and measured, some are looked at.
Result<CheckReport> check_project(const Source& source, const EngineChoice& engine, const FrameProgress& progress,
                                  std::stop_token stop);

/// The findings of a show: what compiling measured stands in it, the rest is measured again.
Result<CheckReport> check_show(const Source& source, const ShowReader& show, const FrameProgress& progress,
                               std::stop_token stop);

}  // namespace focalstage
