#pragma once

#include <cstdint>
#include <deque>
#include <filesystem>
#include <string>

#include "core/compile/frame.h"

namespace focalstage {

/// Lays compiled frames where an editor on the same machine reads them instead of compiling them again:
/// DIR/live/N.codes, the last two of them. Whoever has one open keeps it.
class LiveFrames {
 public:
  /// Begins with an empty folder.
  explicit LiveFrames(const std::filesystem::path& folder);
  ~LiveFrames();

  /// The file; empty where it could not be written, which costs the editor a compile and nobody else anything.
  std::string write(const FrameImages& images);

 private:
  std::filesystem::path folder_;
  std::deque<std::filesystem::path> written_;
  std::uint64_t count_ = 0;
};

}  // namespace focalstage
