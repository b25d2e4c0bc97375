#pragma once

#include <filesystem>
#include <memory>
#include <stop_token>
#include <vector>

#include "core/base/result.h"
#include "core/compile/frame.h"
#include "io/show/show.h"

namespace focalstage {

/// Writes a show so that a kill loses nothing: finished frames go to the append-only `SHOW.h5.part/`, `finish`
/// assembles the show under a temporary name, flushes, fsyncs and renames it. The bytes depend on the header and the
/// frames alone: not on threads, order, resumes or the date.
class ShowWriter {
 public:
  /// Starts a show at `path`. With `resume`, takes over the frames of a part of the same header; another header's part,
  /// a damaged tail or none is started over without a word.
  static Result<ShowWriter> start(const std::filesystem::path& path, const ShowHeader& header, bool resume,
                                  int threads);

  ShowWriter(ShowWriter&&) noexcept;
  ShowWriter& operator=(ShowWriter&&) noexcept;
  ~ShowWriter();

  /// Of every projector, or of one.
  bool has_frame(int frame) const;
  bool has_frame(int frame, std::size_t projector) const;

  /// Compresses the images that one projector shows in a frame in parallel and appends them, with what compiling
  /// measured. In any order, from any thread. A process killed after it returns has lost nothing; a power cut, at most
  /// the last half second. Faults: "show.disk-full", "show.unwritable", "show.frame" (wrong size or number, or already
  /// there).
  Status add_frame(int frame, const FrameImages& images, const FrameMeasure& measure = {}, std::size_t projector = 0);

  /// What was measured of every frame there is, those of an earlier run included. Objects stand in the project's order,
  /// those not staged with zeros.
  const std::vector<FrameMeasure>& measures(std::size_t projector = 0) const;

  /// Assembles the show and removes the part. Every frame must be there ("show.missing-frame"). A stop leaves the part
  /// for a later resume ("show.cancelled").
  Status finish(std::stop_token stop = {});

 private:
  struct State;
  explicit ShowWriter(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace focalstage
