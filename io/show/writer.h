#pragma once

#include <filesystem>
#include <memory>

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
  static Result<ShowWriter> start(const std::filesystem::path& path, const ShowHeader& header, bool resume, int threads);

  ShowWriter(ShowWriter&&) noexcept;
  ShowWriter& operator=(ShowWriter&&) noexcept;
  ~ShowWriter();

  bool has_frame(int frame) const;

  /// Compresses the images of one frame in parallel and appends them durably. In any order. "show.disk-full" etc.
  Status add_frame(int frame, const FrameImages& images);

  /// Assembles the show and removes the part. Every frame must be there.
  Status finish();

 private:
  struct State;
  explicit ShowWriter(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace focalstage
